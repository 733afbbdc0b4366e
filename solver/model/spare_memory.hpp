// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace scarp {

/// Lets the system have what has been freed, before much is asked for again: the pieces that many small vectors leave
/// would come on top of it.
inline void return_spare_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace scarp

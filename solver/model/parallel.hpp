// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace scarp {

/// Calls f(i) for i in [0, count) on up to `threads` threads. Each call must write only what belongs to i;
/// then the result has the same bits for any number of threads.
template <class F>
void parallel_for(std::size_t count, int threads, F&& f) {
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1)
  for (std::size_t i = 0; i < count; ++i) f(i);
}

/// Fixed blocks for reductions: the sum over a block is serial, and blocks are added in order, whatever the
/// number of threads.
inline constexpr std::size_t kReductionBlock = 4096;

}  // namespace scarp

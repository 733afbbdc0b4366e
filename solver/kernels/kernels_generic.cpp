// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kernels for processors other than x86-64, two lanes wide: NEON on 64-bit ARM.
#if !defined(__x86_64__)
#define SCARP_KERNELS scarp::kernels::generic
#define SCARP_LANES 2
#include "solver/kernels/sweeps.hpp"
#endif

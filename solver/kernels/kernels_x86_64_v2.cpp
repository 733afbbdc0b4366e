// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kernels for x86-64-v2; CMakeLists.txt gives this file alone the instruction set.
#if defined(__x86_64__)
#define SCARP_KERNELS scarp::kernels::x86_64_v2
#define SCARP_LANES 2
#include "solver/kernels/sweeps.hpp"
#endif

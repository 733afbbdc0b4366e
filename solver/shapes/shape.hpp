// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contract of a shape function family on one axis of n unit cells, s = cell + xi in [0, n]. Families of more
// axes are products.
//
//   window      the functions that do not vanish on a cell are cell, ..., cell + width - 1 of cells + width - 1
//   unity       sum_f N_f(s) = 1, so that sum_f dN_f/ds = 0
//   linear      sum_f N_f(s) place(f) = s, with place(f) the abscissa of function f
//   walls       only functions with place(f) <= 0 have a value at s = 0, only those with place(f) >= n at s = n:
//               held at zero, they hold the wall. Particles of some size see it as far as they reach
//
// tests/unit/shapes/shape_test.cpp holds every family against it, also next to the walls.
#pragma once

#include <concepts>

namespace scarp {

template <class S>
concept Shape = requires(double xi, int cell, int cells, double half, double (&values)[S::width],
                         double (&slopes)[S::width]) {
  /// N and dN/ds of the window. `half` is half the particle's edge in cells, for families that need it.
  S::weigh(xi, cell, cells, half, values, slopes);
  { S::place(cell, cells) } -> std::same_as<double>;
  /// Whether N depends on the size of the particle, at most half a cell to each side.
  { S::has_size } -> std::convertible_to<bool>;
};

}  // namespace scarp

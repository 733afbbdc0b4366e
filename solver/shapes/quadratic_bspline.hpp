// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "solver/shapes/shape.hpp"

namespace scarp {

/// Quadratic B-splines on the open knots 0, 0, 0, 1, 2, ..., n - 1, n, n, n (Steffen, Kirby, Berzins 2008): smooth
/// slopes inside, and at each wall one function that alone has a value there, so that holding it holds the wall.
struct QuadraticBspline {
  static constexpr int width = 3;
  static constexpr bool has_size = false;

  /// Cox-de Boor on the knots around the cell; spans beyond a wall are empty.
  static void weigh(double xi, int cell, int cells, double, double (&N)[width], double (&dN)[width]) {
    const double before = cell > 0 ? 1 : 0, after = cell + 1 < cells ? 1 : 0;
    const double per_left = 1 / (1 + before), per_right = 1 / (1 + after), rest = 1 - xi;
    N[0] = rest * rest * per_left;
    N[1] = (xi + before) * rest * per_left + (rest + after) * xi * per_right;
    N[2] = xi * xi * per_right;
    dN[0] = -2 * rest * per_left;
    dN[2] = 2 * xi * per_right;
    dN[1] = -(dN[0] + dN[2]);
  }
  /// Greville's: the mean of the function's inner knots.
  static double place(int function, int cells) {
    return 0.5 * (std::clamp(function - 1, 0, cells) + std::clamp(function, 0, cells));
  }
};

static_assert(Shape<QuadraticBspline>);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/shapes/shape.hpp"

namespace scarp {

/// Hat functions, one per node. Their slopes jump between cells: a particle that crosses feels it in its force.
struct LinearShape {
  static constexpr int width = 2;
  static constexpr bool has_size = false;

  static void weigh(double xi, int, int, double, double (&N)[width], double (&dN)[width]) {
    N[0] = 1 - xi;
    N[1] = xi;
    dN[0] = -1;
    dN[1] = 1;
  }
  static double place(int function, int) { return function; }
};

static_assert(Shape<LinearShape>);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "solver/shapes/shape.hpp"

namespace scarp {

/// Hat functions averaged over the particle's edge, which stays as it was (uniform GIMP; Bardenhagen and Kober
/// 2004). One node beyond each wall: function f belongs to node f - 1. The average of a particle that reaches over
/// a wall, with its centre up to `half` beyond, is still complete.
struct Gimp {
  static constexpr int width = 4;
  static constexpr bool has_size = true;

  static void weigh(double xi, int, int, double half, double (&N)[width], double (&dN)[width]) {
    for (int k = 0; k < width; ++k) {
      const double r = xi + 1 - k, distance = std::abs(r), side = r < 0 ? 1 : -1;
      if (distance < half) {
        N[k] = 1 - (r * r + half * half) / (2 * half);
        dN[k] = -r / half;
      } else if (distance <= 1 - half) {
        N[k] = 1 - distance;
        dN[k] = side;
      } else if (distance < 1 + half) {
        const double rest = 1 + half - distance;
        N[k] = rest * rest / (4 * half);
        dN[k] = side * rest / (2 * half);
      } else {
        N[k] = dN[k] = 0;
      }
    }
  }
  static double place(int function, int) { return function - 1; }
};

static_assert(Shape<Gimp>);

}  // namespace scarp

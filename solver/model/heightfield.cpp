// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/model/heightfield.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {

double height_at(const Heightfield& field, double x, double y) {
  const double u = (x - field.x0) / field.cell;
  const double v = (y - field.y0) / field.cell;
  if (!(u >= 0 && v >= 0 && u <= field.columns - 1 && v <= field.rows - 1)) return NAN;
  const int i = std::min(static_cast<int>(u), std::max(field.columns - 2, 0));
  const int j = std::min(static_cast<int>(v), std::max(field.rows - 2, 0));
  const int i1 = std::min(i + 1, field.columns - 1), j1 = std::min(j + 1, field.rows - 1);
  const double a = u - i, b = v - j;
  return (1 - b) * ((1 - a) * field.at(i, j) + a * field.at(i1, j)) +
         b * ((1 - a) * field.at(i, j1) + a * field.at(i1, j1));
}

}  // namespace scarp

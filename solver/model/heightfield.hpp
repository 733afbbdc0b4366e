// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/site.hpp"

namespace scarp {

/// A surface z(x, y) on a regular raster (DEM). Row 0 is the south, column 0 the west; values are at cell
/// centres; NaN means "no data".
struct Heightfield {
  int columns = 0;
  int rows = 0;
  double cell = 0;        ///< m
  double x0 = 0;          ///< x of the centre of column 0, m, minus site.origin
  double y0 = 0;          ///< y of the centre of row 0
  std::vector<double> z;  ///< columns * rows, row-major
  SiteFrame site;

  double at(int column, int row) const { return z[static_cast<std::size_t>(row) * columns + column]; }
  double& at(int column, int row) { return z[static_cast<std::size_t>(row) * columns + column]; }
};

/// Bilinear height at (x, y); NaN outside the hull of the cell centres or beside a no-data value.
double height_at(const Heightfield& field, double x, double y);

}  // namespace scarp

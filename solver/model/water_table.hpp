// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "solver/model/heightfield.hpp"
#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// The level to which the ground and what stands before it is full of water.
struct WaterTableOptions {
  std::optional<double> elevation;
  std::vector<Vec2> line;
  std::optional<InputFile> surface;
  double density = 1000;

  template <class V>
  void describe(V&& v) {
    v("elevation", elevation, Spec{.text = "a level table", .unit = "m", .role = Role::elevation});
    v("line", line,
      Spec{.text = "2D: corners [x, y] of the table, x rising; level beyond the first and the last",
           .unit = "m",
           .role = Role::position});
    v("surface", surface, Spec{.text = "3D: a raster of its elevations (GeoTIFF or ESRI ASCII grid)"});
    v("density", density, Spec{.text = "density of the water", .unit = "kg/m3", .above = 0});
  }
};

/// The same in a model: u = unit_weight * depth below the table, at any place and time; none above it.
struct WaterTable {
  double unit_weight = 0;  ///< N/m3
  std::vector<Vec2> line;  ///< (x, elevation), x rising; one point: a level table
  Heightfield surface;     ///< local; where it has columns it takes the place of the line
};

}  // namespace scarp

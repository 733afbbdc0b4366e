// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps of what two surfaces have to do with each other: seen from above, to scale, in metres of the site.
#pragma once

#include <string>
#include <vector>

#include "solver/model/heightfield.hpp"
#include "solver/model/image.hpp"

namespace scarp {

/// Differences in colours from blue (below 0) by white to red, the same length on either side of 0: the 98th percentile
/// of their sizes, rounded outwards. From white to red alone where none is below. Cells within their level of detection
/// are hatched grey, cells without data white.
struct DifferenceMap {
  const Heightfield* difference = nullptr;          ///< m
  const Heightfield* level_of_detection = nullptr;  ///< m, same cells; nullptr: everything counts
  const Heightfield* ground = nullptr;              ///< heights for the shading, same cells; may be nullptr
  std::string title;
  std::string label;    ///< of the colours, without the unit
  std::string remarks;  ///< below the map
};
/// @throws Error ("render") for a raster without data
Picture draw_difference_map(const DifferenceMap& map);

/// Where two footprints meet: 1 both, 2 simulated only, 3 observed only, else the shaded ground.
struct FootprintMap {
  const Heightfield* cells = nullptr;
  const Heightfield* ground = nullptr;  ///< same cells; may be nullptr
  std::string title, remarks;
  std::string simulated = "simulated", observed = "observed";  ///< what the two are called
};
Picture draw_footprint_map(const FootprintMap& map);

/// Displacements in plan as arrows over shaded ground, all drawn to one scale, which the key shows: so that the 95th
/// percentile is as long as two places are apart. Places whose vector is NaN are crosses.
struct VectorMap {
  const Heightfield* ground = nullptr;    ///< says what the map covers; NaN where nothing is known
  std::vector<Vec2> at;                   ///< m, in the frame of the ground
  std::vector<Vec2> observed, simulated;  ///< m; `simulated` may be empty
  std::string title, remarks;
  std::string simulated_name = "simulated", observed_name = "observed";
};
/// @throws Error ("render") without ground
Picture draw_vector_map(const VectorMap& map);

}  // namespace scarp

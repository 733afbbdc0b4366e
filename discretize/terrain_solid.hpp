// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "discretize/columns.hpp"
#include "discretize/plan_polygon.hpp"
#include "discretize/plane_geometry_cgal.hpp"
#include "solver/model/body_options.hpp"
#include "solver/model/model.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

/// The ground below a scanned surface, ready to be filled: TIN on top, a plane, the sunken TIN or another TIN below, a
/// vertical skirt on the border of the TIN or on the outline.
struct TerrainSolid {
  std::string scan;
  Tin tin;
  Tin base_tin;  ///< for Closing::surface
  std::optional<PlanPolygon> outline;
  Closing close = Closing::plane;
  double depth = 0;           ///< m, for Closing::depth
  double base_elevation = 0;  ///< m, local, for Closing::plane
  Condition base = Condition::fixed;
  bool hold_skirt = false;
  double plan_area = 0;  ///< m2, of the part that has thickness
  double volume = 0;     ///< m3, exact
  Box3 bounds;           ///< exact

  /// Below a place of the surface; not for Closing::surface.
  double base_below(double top) const { return close == Closing::plane ? base_elevation : top - depth; }
};

/// @param base  the scan whose surface is the base, for Closing::surface; else null
/// @throws Error ("discretize") naming the body if depth, base elevation or base scan is missing, if a scan spans no
/// area in plan, or if nothing of it lies inside the outline and above the base.
TerrainSolid close_terrain(const ScanVolume& options, const PointCloud& scan, const PointCloud* base,
                           const std::string& body, int threads);

/// Sub-cells whose centre lies in base <= z < surface; `top` of the result is the exact TIN over each column. Between
/// two surfaces, columns where the base is not below the top are outside the plan.
Columns fill(const TerrainSolid& solid, const SubLattice& grid, int threads);

/// Elevation of the TIN over each (x, y) of a grid in plan, NaN where there is none; x is the fastest index.
std::vector<double> sample_tin(const Tin& tin, const Axis& x, const Axis& y, int threads);

/// Elevation of the base there, below the surface's `top`; NaN where there is none.
std::vector<double> sample_base(const TerrainSolid& solid, const std::vector<double>& top, const Axis& x, const Axis& y,
                                int threads);

}  // namespace scarp

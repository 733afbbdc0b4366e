// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Methods "dod" and "footprint": two rasters, what they say of each other, and the report of it.
#pragma once

#include <optional>
#include <vector>

#include "solver/model/compare_options.hpp"
#include "tools/compare/comparison.hpp"
#include "tools/compare/dod.hpp"
#include "tools/compare/footprint.hpp"
#include "tools/compare/runout.hpp"
#include "tools/compare/sections.hpp"

namespace scarp {

/// Two surfaces on the same cells, in one local frame.
struct SurfacePair {
  Heightfield simulated, observed;      ///< heights, m; for method footprint: thickness, m
  std::vector<double> sigma_simulated;  ///< m, per cell; empty if not known
  std::optional<Heightfield> before;    ///< the ground before, on the same cells
  std::optional<Heightfield> stable_mask;
  std::string simulated_gridding, observed_gridding;  ///< in words: how each came onto the cells
  std::vector<std::string> warnings;                  ///< of how the surfaces were made
};

struct SurfaceComparison {
  Comparison comparison;  ///< report, and the rasters difference, level_of_detection, footprint as far as there are
  std::optional<DodResult> dod;
  std::optional<FootprintResult> footprint;
  std::optional<Section> section;
  std::optional<PlanPath> path;       ///< along which run-out was measured
  std::optional<Heightfield> ground;  ///< observed heights or the ground before, for a picture's shading
};

/// DEM of difference with volumes; with `before` also the footprints of both (where a surface differs from it by more
/// than the threshold) and their run-out; with options.section also the section. Positions in the options are local.
/// @throws Error as dem_of_difference and the others
SurfaceComparison compare_surfaces(const SurfacePair& pair, const CompareOptions& options);

/// Overlap and run-out of two rasters of thickness; `before` is the terrain.
SurfaceComparison compare_thickness(const SurfacePair& pair, const CompareOptions& options);

/// The reports as tables of numbers with units and conventions.
std::vector<MeasureGroup> groups_of(const DodReport& report, const Vec3& origin);
MeasureGroup group_of(const FootprintReport& report);
MeasureGroup group_of(const RunoutReport& report, const std::string& name, const std::string& path, const Vec3& origin);

}  // namespace scarp

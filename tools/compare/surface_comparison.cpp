// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/surface_comparison.hpp"

#include <cmath>

#include "solver/model/error.hpp"
#include "tools/compare/statistics.hpp"

namespace scarp {
namespace {

/// What moved: |surface - before|.
Heightfield change_of(const Heightfield& surface, const Heightfield& before) {
  require_same_grid(surface, before);
  Heightfield change = surface;
  for (std::size_t i = 0; i < change.z.size(); ++i) change.z[i] = std::abs(change.z[i] - before.z[i]);
  return change;
}

/// Values that are no heights: the origin's height has no part in them.
NamedRaster named(const std::string& name, Heightfield raster) {
  raster.site.origin[2] = 0;
  return {name, std::move(raster)};
}

Heightfield as_raster(const Heightfield& like, const std::vector<Overlap>& cells) {
  Heightfield raster = like;
  for (std::size_t i = 0; i < cells.size(); ++i) raster.z[i] = static_cast<double>(cells[i]);
  return raster;
}

/// Centre of the highest ground of the observed footprint.
std::optional<Vec2> highest(const FootprintResult& footprint, const Heightfield& terrain) {
  const RasterGrid grid = grid_of(terrain);
  std::optional<std::size_t> top;
  for (std::size_t i = 0; i < terrain.z.size(); ++i) {
    const Overlap cell = footprint.cells[i];
    if ((cell != Overlap::both && cell != Overlap::observed_only) || std::isnan(terrain.z[i])) continue;
    if (!top || terrain.z[i] > terrain.z[*top]) top = i;
  }
  if (!top) return std::nullopt;
  const auto columns = static_cast<std::size_t>(grid.columns);
  return Vec2{grid.x(static_cast<int>(*top % columns)), grid.y(static_cast<int>(*top / columns))};
}

/// Footprints of two rasters of thickness, and the run-out of each where there is one and a path.
void add_footprint(const Heightfield& simulated, const Heightfield& observed, const Heightfield* terrain,
                   const CompareOptions& options, SurfaceComparison& result) {
  const double threshold = options.footprint.threshold;
  ComparisonReport& report = result.comparison.report;
  result.footprint = compare_footprints(simulated, threshold, observed, threshold);
  report.groups.push_back(group_of(result.footprint->report));
  result.comparison.rasters.push_back(named("footprint", as_raster(simulated, result.footprint->cells)));
  std::string path = "the given path";
  if (!options.footprint.path.empty()) {
    result.path.emplace(options.footprint.path);
  } else if (const auto start = terrain ? highest(*result.footprint, *terrain) : std::nullopt) {
    result.path = steepest_line(*terrain, *start);
    path = "the line of steepest descent from the highest ground of the observed footprint";
  } else {
    report.warnings.push_back("Run-out was not measured: it takes a path, or the ground and an observed footprint.");
    return;
  }
  const auto measure = [&](const Heightfield& thickness, std::size_t cells, const std::string& name) {
    if (cells == 0) {
      report.warnings.push_back("The " + name + " footprint is empty; its run-out was not measured.");
      return;
    }
    report.groups.push_back(
        group_of(runout_along(thickness, terrain, *result.path, threshold, options.footprint.width_limit),
                 "runout_" + name, path, simulated.site.origin));
  };
  const FootprintReport& overlap = result.footprint->report;
  measure(simulated, overlap.both + overlap.simulated_only, "simulated");
  measure(observed, overlap.both + overlap.observed_only, "observed");
}

/// Of 8 around a cell, fewer along the border.
double neighbours_without_holes(const RasterGrid& grid) {
  const double c = grid.columns, r = grid.rows;
  return 2 * (r * (c - 1) + c * (r - 1) + 2 * (r - 1) * (c - 1)) / (r * c);
}

}  // namespace

SurfaceComparison compare_surfaces(const SurfacePair& pair, const CompareOptions& options) {
  SurfaceComparison result;
  ComparisonReport& report = result.comparison.report;
  report = start_report(options);
  report.warnings = pair.warnings;
  result.dod = dem_of_difference({pair.simulated, pair.observed, pair.sigma_simulated,
                                  pair.stable_mask ? &*pair.stable_mask : nullptr, options.registration_error},
                                 options.dod);
  const DodReport& dod = result.dod->report;
  report.groups.push_back({"gridding",
                           "How each surface came onto the cells; null cells are never compared.",
                           {{"simulated", pair.simulated_gridding}, {"observed", pair.observed_gridding}}});
  for (MeasureGroup& group : groups_of(dod, pair.simulated.site.origin)) report.groups.push_back(std::move(group));
  result.comparison.rasters.push_back(named("difference", result.dod->difference));
  result.comparison.rasters.push_back(named("level_of_detection", result.dod->level_of_detection));
  if (dod.average_neighbours < 7.0 / 8 * neighbours_without_holes(dod.grid))  // as CloudCompare warns
    report.warnings.push_back("The difference is full of holes: of the 8 cells around a compared one " +
                              shortest(std::round(10 * dod.average_neighbours) / 10) +
                              " are compared too. Larger cells, a triangulation or fill_distance would close them.");
  if (dod.sigma_simulated == 0 && dod.sigma_observed == 0 && dod.shared_sigma == 0)
    report.warnings.push_back(
        "No uncertainty of the heights is known: every difference counts as significant. Give the uncertainties or "
        "stable ground.");
  if (pair.before)
    add_footprint(change_of(pair.simulated, *pair.before), change_of(pair.observed, *pair.before), &*pair.before,
                  options, result);
  if (!options.section.empty())
    result.section = cut_section(pair.simulated, pair.observed, PlanPath(options.section), 0.5 * pair.simulated.cell);
  result.ground = pair.observed;
  return result;
}

SurfaceComparison compare_thickness(const SurfacePair& pair, const CompareOptions& options) {
  SurfaceComparison result;
  result.comparison.report = start_report(options);
  result.comparison.report.warnings = pair.warnings;
  result.comparison.report.groups.push_back(
      {"gridding",
       "How each raster of thickness came onto the cells; cells without data have no thickness.",
       {{"simulated", pair.simulated_gridding}, {"observed", pair.observed_gridding}}});
  add_footprint(pair.simulated, pair.observed, pair.before ? &*pair.before : nullptr, options, result);
  result.ground = pair.before;
  return result;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/surface_pair.hpp"

#include <cmath>

#include "discretize/terrain_solid.hpp"
#include "ingest/localize.hpp"
#include "ingest/read_cloud.hpp"
#include "ingest/read_raster.hpp"
#include "solver/model/error.hpp"
#include "solver/store/frame_store.hpp"
#include "tools/compare/common_frame.hpp"
#include "tools/compare/free_surface.hpp"
#include "tools/pipeline/info.hpp"

namespace scarp {
namespace {

void move_to(SurfaceSource& source, const Vec3& origin) {
  if (auto* cloud = std::get_if<PointCloud>(&source)) {
    cloud->positions = moved(std::move(cloud->positions), cloud->site.origin, origin);
    cloud->site.origin = origin;
  } else if (auto* raster = std::get_if<Heightfield>(&source)) {
    const Vec3 shift = raster->site.origin - origin;
    raster->x0 += shift[0];
    raster->y0 += shift[1];
    if (shift[2] != 0)
      for (double& z : raster->z) z += shift[2];
    raster->site.origin = origin;
  } else {
    Frame& frame = std::get<Frame>(source);
    frame.positions = moved(std::move(frame.positions), frame.site.origin, origin);
    frame.site.origin = origin;
  }
}

void move_to(std::vector<Vec2>& corners, const Vec3& origin) {
  for (Vec2& p : corners) p = {p[0] - origin[0], p[1] - origin[1]};
}

const std::vector<Vec3>& positions_of(const SurfaceSource& source) {
  if (const auto* frame = std::get_if<Frame>(&source)) return frame->positions;
  return std::get<PointCloud>(source).positions;
}

/// All cells that a source could fill.
RasterGrid extent_of(const SurfaceSource& source, double cell) {
  if (const auto* raster = std::get_if<Heightfield>(&source)) return grid_of(*raster);
  return covering_grid(positions_of(source), cell);
}

/// The grid of a given cell over a raster's outer edges, or over points.
RasterGrid grid_with_cell(const SurfaceSource& source, double cell) {
  const auto* raster = std::get_if<Heightfield>(&source);
  if (!raster) return covering_grid(positions_of(source), cell);
  if (raster->cell == cell) return grid_of(*raster);
  const double in = 0.5 * raster->cell * (1 - 1e-9);
  const RasterGrid own = grid_of(*raster);
  return covering_grid({{own.x0 - in, own.y0 - in, 0}, {own.x(own.columns - 1) + in, own.y(own.rows - 1) + in, 0}},
                       cell);
}

RasterGrid choose_grid(const SurfaceSources& sources, double cell) {
  const bool by_observed = cell > 0 || std::holds_alternative<Heightfield>(sources.observed);
  const SurfaceSource& lead = by_observed ? sources.observed : sources.simulated;
  if (cell == 0) {
    const auto* raster = std::get_if<Heightfield>(&lead);
    if (!raster)
      throw Error("compare", "no raster says how large the cells of the comparison are", "0 m",
                  "a cell size (dod.cell, --cell)");
    cell = raster->cell;
  }
  const SurfaceSource& other = by_observed ? sources.simulated : sources.observed;
  return overlap(grid_with_cell(lead, cell), extent_of(other, cell));
}

/// A source on the cells, how it came there, and the standard deviation of its heights where it knows.
struct Gridded {
  Heightfield field;
  std::string words;
  std::vector<double> sigma;
  double spacing = 0;  ///< of a frame's particles, m
  std::vector<std::string> warnings = {};
};

Heightfield triangulated(const PointCloud& cloud, const RasterGrid& grid, double longest_edge, int threads) {
  Heightfield field = empty_raster(grid, cloud.site);
  const Tin tin = triangulate(cloud.positions, longest_edge);
  field.z = sample_tin(tin, Axis::nodes(grid.x0, grid.cell, grid.columns - 1),
                       Axis::nodes(grid.y0, grid.cell, grid.rows - 1), threads);
  return field;
}

Gridded from_points(const PointCloud& cloud, const RasterGrid& grid, const DodOptions& options, int threads) {
  const std::string policy(name_of(options.policy));
  if (options.policy == CellPolicy::tin)
    return {triangulated(cloud, grid, options.longest_edge, threads), "points, triangulated", {}};
  return {grid_points(cloud.positions, cloud.site, grid, options.policy, nullptr),
          "points, " + policy + " of those in each cell",
          {}};
}

Gridded from_frame(const Frame& frame, const RasterGrid& grid, const DodOptions& options, int threads) {
  const FreeSurface surface = free_surface(frame, threads);
  Gridded gridded;
  if (surface.cloud.normals.empty()) {
    gridded = from_points(surface.cloud, grid, options, threads);
    gridded.words = surface.words + ", " + gridded.words;
  } else {
    SurfaceRaster raster = surface_raster(surface, grid, options.policy, threads);
    gridded = {std::move(raster.field), surface.words, std::move(raster.sigma), surface.spacing};
  }
  gridded.warnings = surface.warnings;
  return gridded;
}

Gridded on_grid(const SurfaceSource& source, const RasterGrid& grid, const DodOptions& options, int threads) {
  Gridded gridded;
  if (const auto* raster = std::get_if<Heightfield>(&source)) {
    Resampling done;
    gridded.field = resample(*raster, grid, &done);
    gridded.words = "raster, " + done.method;
    if (done.method != "exact")
      gridded.words += ", grids shifted by (" + shortest(done.shift_x) + ", " + shortest(done.shift_y) + ") m";
  } else if (const auto* cloud = std::get_if<PointCloud>(&source)) {
    gridded = from_points(*cloud, grid, options, threads);
  } else {
    gridded = from_frame(std::get<Frame>(source), grid, options, threads);
  }
  // The origin and CRS of the pair are the observed side's.
  const std::size_t filled = fill_empty(gridded.field, options.fill_distance);
  // What was filled is known no better than a spacing.
  for (std::size_t i = 0; i < gridded.sigma.size(); ++i)
    if (std::isnan(gridded.sigma[i]) && !std::isnan(gridded.field.z[i])) gridded.sigma[i] = gridded.spacing;
  if (filled > 0) gridded.words += "; " + std::to_string(filled) + " empty cells filled from their surroundings";
  return gridded;
}

}  // namespace

SurfaceSource read_surface_source(const std::filesystem::path& path, HeightUnit height_unit) {
  if (path.extension() == ".hdf") return read_frame(path);
  if (holds_raster(path)) {
    if (height_unit != HeightUnit::metre)
      throw Error("compare", path.string() + ": heights of a raster", std::string(name_of(height_unit)), "metres");
    Heightfield raster = read_raster(path);
    PointCloud outline = raster_to_cloud(raster);
    if (outline.empty()) throw Error("compare", path.string() + " holds no data", "0 cells", "at least 1");
    require_projected_metres(outline, path.string());
    return raster;
  }
  PointCloud cloud = read_cloud(path);
  if (cloud.empty()) throw Error("compare", path.string() + " holds no points", "0 points", "at least 1");
  require_projected_metres(cloud, path.string());
  heights_to_metres(cloud, height_unit, path.string());
  return cloud;
}

const SiteFrame& site_of(const SurfaceSource& source) {
  return std::visit([](const auto& s) -> const SiteFrame& { return s.site; }, source);
}

SurfacePair make_surface_pair(SurfaceSources sources, CompareOptions& options, int threads) {
  const Vec3 origin = common_origin(site_of(sources.simulated), site_of(sources.observed));
  for (SurfaceSource* source : {&sources.simulated, &sources.observed}) move_to(*source, origin);
  if (sources.before) move_to(*sources.before, origin);
  if (sources.stable_mask) {
    if (!std::holds_alternative<Heightfield>(*sources.stable_mask))
      throw Error("compare", "the mask of stable ground", "no raster", "a raster");
    // Its values are no heights.
    Heightfield& mask = std::get<Heightfield>(*sources.stable_mask);
    mask.site.origin[2] = origin[2];
    move_to(*sources.stable_mask, origin);
  }
  for (std::vector<Vec2>* corners : {&options.dod.stable.polygon, &options.footprint.path, &options.section})
    move_to(*corners, origin);
  const RasterGrid grid = choose_grid(sources, options.dod.cell);
  Gridded simulated = on_grid(sources.simulated, grid, options.dod, threads);
  Gridded observed = on_grid(sources.observed, grid, options.dod, threads);
  SurfacePair pair{std::move(simulated.field),
                   std::move(observed.field),
                   std::move(simulated.sigma),
                   {},
                   {},
                   simulated.words,
                   observed.words,
                   std::move(simulated.warnings)};
  for (std::string& warning : observed.warnings) pair.warnings.push_back(std::move(warning));
  if (sources.before) pair.before = on_grid(*sources.before, grid, options.dod, threads).field;
  if (sources.stable_mask) pair.stable_mask = resample(std::get<Heightfield>(*sources.stable_mask), grid, nullptr);
  return pair;
}

}  // namespace scarp

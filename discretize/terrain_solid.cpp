// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/terrain_solid.hpp"

#include <cmath>

#include "discretize/plan_integral.hpp"
#include "discretize/raster_triangles.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

void check(const ScanVolume& options, const PointCloud& scan, const std::string& body) {
  const std::string who = "body '" + body + "': ";
  if (options.close == Closing::plane && !options.base_elevation)
    throw Error("discretize", who + "close = \"plane\" needs a base_elevation", "none", "an elevation in m");
  if (options.close == Closing::depth && !options.depth)
    throw Error("discretize", who + "close = \"depth\" needs a depth", "none", "a depth above 0 m");
  if (options.close == Closing::depth && !(*options.depth > 0 && std::isfinite(*options.depth)))
    throw Error("discretize", who + "depth", shortest(*options.depth) + " m", "above 0 m");
  if (options.base_elevation && !std::isfinite(*options.base_elevation))
    throw Error("discretize", who + "base_elevation", shortest(*options.base_elevation), "a finite elevation");
  if (scan.size() >= std::size_t{0xffffffff})
    throw Error("discretize", who + "points of scan '" + options.scan + "'", std::to_string(scan.size()),
                "below 2^32: thin the scan first");
  for (std::size_t i = 0; i < scan.size(); ++i)
    if (!is_finite(scan.positions[i]))
      throw Error("discretize", who + "point " + std::to_string(i) + " of scan '" + options.scan + "'",
                  "a coordinate that is not finite", "finite coordinates");
}

}  // namespace

TerrainSolid close_terrain(const ScanVolume& options, const PointCloud& scan, const std::string& body, int threads) {
  check(options, scan, body);
  TerrainSolid solid;
  solid.scan = options.scan;
  solid.close = options.close;
  solid.depth = options.depth.value_or(0);
  solid.base_elevation = options.base_elevation.value_or(0);
  solid.base = options.base;
  solid.hold_skirt = options.hold_skirt;
  if (!options.outline.empty()) solid.outline.emplace(options.outline, "body '" + body + "': outline");
  solid.tin = triangulate(scan.positions, options.longest_edge);
  if (solid.tin.triangles.empty())
    throw Error("discretize", "body '" + body + "': scan '" + options.scan + "' spans no surface in plan",
                std::to_string(scan.size()) + " points, longest_edge " + shortest(options.longest_edge) + " m",
                "three points that are not on one line, and a longest_edge that keeps triangles");

  const bool plane = options.close == Closing::plane;
  const PlanIntegral integral =
      integrate_tin(solid.tin, solid.outline, plane ? options.base_elevation : std::nullopt, threads);
  solid.plan_area = integral.area;
  solid.volume = plane ? integral.volume : integral.area * solid.depth;
  solid.bounds = integral.bounds;
  if (!(solid.volume > 0))
    throw Error("discretize", "body '" + body + "': nothing of scan '" + options.scan + "' encloses a volume",
                std::to_string(solid.tin.triangles.size()) + " triangles, none inside the outline and above the base",
                "an outline over the scan and a base_elevation below its surface");
  solid.bounds.min[2] = plane ? solid.base_elevation : solid.bounds.min[2] - solid.depth;
  return solid;
}

std::vector<double> sample_tin(const Tin& tin, const Axis& x, const Axis& y, int threads) {
  std::vector<double> z(static_cast<std::size_t>(x.count) * y.count, NAN);
  const int bands = std::max(1, std::min(threads, y.count));
  parallel_for(bands, threads, [&](std::size_t b) {
    const auto row = [&](std::size_t n) { return static_cast<std::int32_t>(n * y.count / bands); };
    for (std::size_t t = 0; t < tin.triangles.size(); ++t)
      raster_triangle(tin.corners(t), x, y, row(b), row(b + 1), [&](std::int32_t i, std::int32_t j, double height) {
        z[static_cast<std::size_t>(j) * x.count + i] = height;
      });
  });
  return z;
}

Columns fill(const TerrainSolid& solid, const SubLattice& grid, int threads) {
  std::vector<double> top = sample_tin(solid.tin, grid.x, grid.y, threads);
  if (solid.outline)
    parallel_for(top.size(), threads, [&](std::size_t c) {
      const auto i = static_cast<std::int32_t>(c % grid.x.count), j = static_cast<std::int32_t>(c / grid.x.count);
      if (!std::isnan(top[c]) && !solid.outline->contains(grid.x.at(i), grid.y.at(j))) top[c] = NAN;
    });
  Columns columns = collect_columns(grid, threads, [&](std::int32_t i, std::int32_t j, auto&& push) {
    const double surface = top[grid.column(i, j)];
    if (std::isnan(surface)) return;
    push(Span{grid.up.first_at_or_above(solid.base_below(surface)), grid.up.first_at_or_above(surface)});
  });
  columns.top = std::move(top);
  return columns;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/terrain_solid.hpp"

#include <cmath>

#include "discretize/plan_integral.hpp"
#include "discretize/raster_triangles.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

void check_points(const std::string& name, const PointCloud& scan, const std::string& who) {
  if (scan.size() >= std::size_t{0xffffffff})
    throw Error("discretize", who + "points of scan '" + name + "'", std::to_string(scan.size()),
                "below 2^32: thin the scan first");
  for (std::size_t i = 0; i < scan.size(); ++i)
    if (!is_finite(scan.positions[i]))
      throw Error("discretize", who + "point " + std::to_string(i) + " of scan '" + name + "'",
                  "a coordinate that is not finite", "finite coordinates");
}

void check(const ScanVolume& options, const PointCloud* base, const std::string& who) {
  if (options.close == Closing::plane && !options.base_elevation)
    throw Error("discretize", who + "close = \"plane\" needs a base_elevation", "none", "an elevation in m");
  if (options.close == Closing::depth && !options.depth)
    throw Error("discretize", who + "close = \"depth\" needs a depth", "none", "a depth above 0 m");
  if (options.close == Closing::depth && !(*options.depth > 0 && std::isfinite(*options.depth)))
    throw Error("discretize", who + "depth", shortest(*options.depth) + " m", "above 0 m");
  if (options.base_elevation && !std::isfinite(*options.base_elevation))
    throw Error("discretize", who + "base_elevation", shortest(*options.base_elevation), "a finite elevation");
  if (options.close == Closing::surface && !(options.base_scan && base))
    throw Error("discretize", who + "close = \"surface\" needs a base_scan", "none", "the name of a scan");
}

Tin surface_of(const std::string& name, const PointCloud& scan, double longest_edge, const std::string& who) {
  check_points(name, scan, who);
  Tin tin = triangulate(scan.positions, longest_edge);
  if (tin.triangles.empty())
    throw Error("discretize", who + "scan '" + name + "' spans no surface in plan",
                std::to_string(scan.size()) + " points, longest_edge " + shortest(longest_edge) + " m",
                "three points that are not on one line, and a longest_edge that keeps triangles");
  return tin;
}

PlanIntegral integrate(const TerrainSolid& solid, int threads) {
  if (solid.close == Closing::surface) return integrate_between(solid.tin, solid.base_tin, solid.outline, threads);
  const bool plane = solid.close == Closing::plane;
  PlanIntegral integral =
      integrate_tin(solid.tin, solid.outline, plane ? std::optional(solid.base_elevation) : std::nullopt, threads);
  if (!plane) integral.volume = integral.area * solid.depth;
  integral.bounds.min[2] = plane ? solid.base_elevation : integral.bounds.min[2] - solid.depth;
  return integral;
}

}  // namespace

TerrainSolid close_terrain(const ScanVolume& options, const PointCloud& scan, const PointCloud* base,
                           const std::string& body, int threads) {
  const std::string who = "body '" + body + "': ";
  check(options, base, who);
  TerrainSolid solid;
  solid.scan = options.scan;
  solid.close = options.close;
  solid.depth = options.depth.value_or(0);
  solid.base_elevation = options.base_elevation.value_or(0);
  solid.base = options.base;
  solid.hold_skirt = options.hold_skirt;
  if (!options.outline.empty()) solid.outline.emplace(options.outline, "body '" + body + "': outline");
  solid.tin = surface_of(options.scan, scan, options.longest_edge, who);
  if (solid.close == Closing::surface) solid.base_tin = surface_of(*options.base_scan, *base, 0, who);

  const PlanIntegral integral = integrate(solid, threads);
  solid.plan_area = integral.area;
  solid.volume = integral.volume;
  solid.bounds = integral.bounds;
  if (!(solid.volume > 0))
    throw Error("discretize", who + "nothing of scan '" + options.scan + "' encloses a volume",
                std::to_string(solid.tin.triangles.size()) + " triangles, none inside the outline and above the base",
                "an outline over the scan, and a base below its surface");
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

std::vector<double> sample_base(const TerrainSolid& solid, const std::vector<double>& top, const Axis& x, const Axis& y,
                                int threads) {
  if (solid.close == Closing::surface) return sample_tin(solid.base_tin, x, y, threads);
  std::vector<double> base = top;
  for (double& z : base)
    if (!std::isnan(z)) z = solid.base_below(z);
  return base;
}

Columns fill(const TerrainSolid& solid, const SubLattice& grid, int threads) {
  std::vector<double> top = sample_tin(solid.tin, grid.x, grid.y, threads);
  if (solid.outline)
    parallel_for(top.size(), threads, [&](std::size_t c) {
      const auto i = static_cast<std::int32_t>(c % grid.x.count), j = static_cast<std::int32_t>(c / grid.x.count);
      if (!std::isnan(top[c]) && !solid.outline->contains(grid.x.at(i), grid.y.at(j))) top[c] = NAN;
    });
  const std::vector<double> base = sample_base(solid, top, grid.x, grid.y, threads);
  if (solid.close == Closing::surface)
    for (std::size_t c = 0; c < top.size(); ++c)
      if (!(base[c] < top[c])) top[c] = NAN;
  Columns columns = collect_columns(grid, threads, [&](std::int32_t i, std::int32_t j, auto&& push) {
    const std::size_t c = grid.column(i, j);
    if (std::isnan(top[c])) return;
    push(Span{grid.up.first_at_or_above(base[c]), grid.up.first_at_or_above(top[c])});
  });
  columns.top = std::move(top);
  return columns;
}

}  // namespace scarp

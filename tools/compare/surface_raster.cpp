// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The free surface of a frame as heights.
#include <algorithm>
#include <cmath>

#include "ingest/neighbours/neighbours.hpp"
#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "tools/compare/free_surface.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kReach = 1.5;     ///< of a tangent plane, spacings
constexpr double kNearest = 1.25;  ///< to the nearest surface point, spacings: half a diagonal and half a spacing
constexpr double kSheet = 2;       ///< spacings below the highest tangent plane where another sheet begins
constexpr double kSteepest = 0.3;  ///< vertical part of a normal; tangent planes are taken no steeper

/// Surface points by their place in plan.
class Tangents {
 public:
  explicit Tangents(const FreeSurface& surface)
      : surface_(surface), spacing_(surface.spacing), plan_(in_plan(surface.cloud.positions)) {
    uncertainty_ = &find_scalar(surface.cloud, "uncertainty")->values;
  }

  struct Height {
    double z = kNaN, sigma = kNaN;
  };

  Height at(double x, double y, std::vector<Neighbour>& found) const {
    plan_.within({x, y, 0}, kReach * spacing_, found);
    if (found.empty() || found.front().squared_distance > kNearest * kNearest * spacing_ * spacing_) return {};
    double top = -INFINITY;
    for (const Neighbour& n : found) top = std::max(top, plane(n.index, x, y));
    double sum = 0, sigma = 0, weights = 0;
    for (const Neighbour& n : found) {
      const double z = plane(n.index, x, y), q = std::sqrt(n.squared_distance) / (kReach * spacing_);
      if (z < top - kSheet * spacing_) continue;
      const double weight = std::pow(1 - std::min(q, 1.0), 4) * (4 * q + 1) + 1e-12;
      sum += weight * (z - top);
      sigma += weight * (*uncertainty_)[n.index];
      weights += weight;
    }
    return {top + sum / weights, sigma / weights};
  }

 private:
  static std::vector<Vec3> in_plan(std::vector<Vec3> positions) {
    for (Vec3& p : positions) p[2] = 0;
    return positions;
  }
  double plane(std::size_t i, double x, double y) const {
    const Vec3 &p = surface_.cloud.positions[i], &n = surface_.cloud.normals[i];
    const double up = std::max(kSteepest, n[2]);
    return p[2] - (n[0] * (x - p[0]) + n[1] * (y - p[1])) / up;
  }
  const FreeSurface& surface_;
  double spacing_;
  Neighbours plan_;
  const std::vector<double>* uncertainty_;
};

}  // namespace

SurfaceRaster surface_raster(const FreeSurface& surface, const RasterGrid& grid, CellPolicy policy, int threads) {
  if (surface.plane_strain)
    throw Error("compare", "a raster of heights of a frame in plane strain", "one plane of particles",
                "a frame of three dimensions");
  if (surface.cloud.normals.empty()) throw Error("compare", "a surface of particle centres has no tangent planes");
  SurfaceRaster raster{empty_raster(grid, surface.cloud.site), std::vector<double>(grid.cells(), kNaN)};
  const Tangents tangents(surface);
  const int across =
      policy == CellPolicy::tin ? 1 : std::max(1, static_cast<int>(std::ceil(grid.cell / surface.spacing - 1e-9)));
  parallel_for(static_cast<std::size_t>(grid.rows), threads, [&](std::size_t row) {
    std::vector<Neighbour> found;
    std::vector<double> heights;
    for (int column = 0; column < grid.columns; ++column) {
      heights.clear();
      double sigma = 0;
      for (int k = 0; k < across * across; ++k) {
        const double x = grid.x(column) + ((k % across + 0.5) / across - 0.5) * grid.cell;
        const double y = grid.y(static_cast<int>(row)) + ((k / across + 0.5) / across - 0.5) * grid.cell;
        const Tangents::Height height = tangents.at(x, y, found);
        if (std::isnan(height.z)) continue;
        heights.push_back(height.z);
        sigma += height.sigma;
      }
      if (2 * heights.size() < static_cast<std::size_t>(across * across)) continue;
      const std::size_t cell = row * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
      raster.sigma[cell] = sigma / static_cast<double>(heights.size());
      raster.field.z[cell] = height_of_cell(heights, policy);
    }
  });
  return raster;
}

}  // namespace scarp

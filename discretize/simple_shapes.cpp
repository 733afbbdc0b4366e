// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/simple_shapes.hpp"

#include <cmath>
#include <numbers>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

BallSolid close_ball(const BallShape& shape, int dimension, const std::string& body) {
  if (!(shape.radius > 0 && std::isfinite(shape.radius)))
    throw Error("discretize", "body '" + body + "': radius", shortest(shape.radius) + " m", "above 0 m");
  BallSolid ball{shape.centre, shape.radius, 0, {}};
  const double r = shape.radius;
  if (dimension == 2) ball.centre[2] = 0;
  ball.volume = dimension == 2 ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const Vec3 reach{r, r, dimension == 2 ? 0 : r};
  ball.bounds.extend(ball.centre - reach);
  ball.bounds.extend(ball.centre + reach);
  if (!is_finite(ball.bounds.min) || !is_finite(ball.bounds.max))
    throw Error("discretize", "body '" + body + "': centre", "a coordinate that is not finite", "finite coordinates");
  return ball;
}

}  // namespace

void need_dimension(int dimension, int needed, const char* volume, const std::string& body) {
  if (dimension != needed)
    throw Error("discretize", "body '" + body + "': a " + volume + " is a volume in " + std::to_string(needed) + "D",
                "dimension = " + std::to_string(dimension), "dimension = " + std::to_string(needed));
}

BoxSolid close_box(const BoxVolume& options, int dimension, const std::string& body) {
  BoxSolid box{1, {}};
  Vec3 low = options.box.min, high = options.box.max;
  if (dimension == 2) low[2] = high[2] = 0;
  for (int axis = 0; axis < dimension; ++axis) {
    const double edge = high[axis] - low[axis];
    if (!(edge > 0 && std::isfinite(edge)))
      throw Error("discretize", "body '" + body + "': edge of the box along " + "xyz"[axis], shortest(edge) + " m",
                  "above 0 m");
    box.volume *= edge;
  }
  box.bounds.extend(low);
  box.bounds.extend(high);
  return box;
}

BallSolid close_disk(const DiskVolume& options, int dimension, const std::string& body) {
  need_dimension(dimension, 2, "disk", body);
  return close_ball(options.disk, dimension, body);
}

BallSolid close_sphere(const SphereVolume& options, int dimension, const std::string& body) {
  need_dimension(dimension, 3, "sphere", body);
  return close_ball(options.sphere, dimension, body);
}

PolygonSolid close_polygon(const PolygonVolume& options, int dimension, const std::string& body) {
  need_dimension(dimension, 2, "polygon", body);
  PolygonSolid solid{PlanPolygon(options.polygon, "body '" + body + "': polygon"), 0, {}};
  solid.volume = solid.polygon.area();
  solid.bounds.extend({solid.polygon.min()[0], solid.polygon.min()[1], 0});
  solid.bounds.extend({solid.polygon.max()[0], solid.polygon.max()[1], 0});
  return solid;
}

Columns fill(const BoxSolid& solid, const SubLattice& grid, int threads) {
  const int up = grid.flat() ? 1 : 2;
  const Vec3 &low = solid.bounds.min, &high = solid.bounds.max;
  return collect_columns(grid, threads, [&](std::int32_t i, std::int32_t j, auto&& push) {
    const double x = grid.x.at(i), y = grid.y.at(j);
    if (!(low[0] <= x && x < high[0]) || (!grid.flat() && !(low[1] <= y && y < high[1]))) return;
    push(Span{grid.up.first_at_or_above(low[up]), grid.up.first_at_or_above(high[up])});
  });
}

Columns fill(const BallSolid& solid, const SubLattice& grid, int threads) {
  const double r2 = solid.radius * solid.radius;
  const double centre = solid.centre[grid.flat() ? 1 : 2];
  return collect_columns(grid, threads, [&](std::int32_t i, std::int32_t j, auto&& push) {
    const double dx = grid.x.at(i) - solid.centre[0], dy = grid.flat() ? 0 : grid.y.at(j) - solid.centre[1];
    const double left = r2 - dx * dx - dy * dy;
    if (!(left > 0)) return;
    const double chord = std::sqrt(left);
    Span span{grid.up.first_at_or_above(centre - chord), grid.up.first_at_or_above(centre + chord)};
    // The root is rounded; the rule is the square's, which is symmetric about the centre.
    const auto inside = [&](std::int32_t k) {
      const double dz = grid.up.at(k) - centre;
      return k >= 0 && k < grid.up.count && dz * dz < left;
    };
    while (inside(span.begin - 1)) --span.begin;
    while (span.begin < span.end && !inside(span.begin)) ++span.begin;
    while (inside(span.end)) ++span.end;
    push(span);
  });
}

Columns fill(const PolygonSolid& solid, const SubLattice& grid, int threads) {
  return collect_columns(grid, threads, [&](std::int32_t i, std::int32_t, auto&& push) {
    std::vector<double> heights;
    solid.polygon.crossings(grid.x.at(i), heights);
    for (std::size_t n = 0; n + 1 < heights.size(); n += 2)
      push(Span{grid.up.first_at_or_above(heights[n]), grid.up.first_at_or_above(heights[n + 1])});
  });
}

}  // namespace scarp

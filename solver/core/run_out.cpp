// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/run_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>

#include "solver/materials/tensor.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

struct Point {
  Vec3 X, x;
  double V0, mass;
  double volume;  ///< as it is now

  Point(const Particles& P, std::size_t p)
      : X(P.reference_position[p]),
        x(P.position[p]),
        V0(P.reference_volume[p]),
        mass(P.mass[p]),
        volume(V0 * determinant(P.deformation_gradient[p])) {}
};

/// The moved points are not kept: whoever wants them goes over all once more.
struct Scene {
  const ParticleStates& states;
  const Domain& domain;
  double threshold;

  int up() const { return domain.dimension - 1; }
  bool flat() const { return domain.dimension == 2; }
  /// The horizontal part.
  Vec3 plan(Vec3 v) const {
    v[up()] = 0;
    return v;
  }
  template <class F>
  void each_moved(F&& f) const {
    states.each_block([&](const Particles& block) { each_moved(block, f); });
  }
  template <class F>
  void each_moved(const Particles& P, F&& f) const {
    for (std::size_t p = 0; p < P.size(); ++p)
      if (norm(P.position[p] - P.reference_position[p]) >= threshold) f(Point(P, p));
  }
};

struct Range {
  double least = INFINITY, most = -INFINITY;
  void add(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
};

using PlanCell = std::array<std::int64_t, 2>;

PlanCell plan_cell(const Scene& scene, const Vec3& x) {
  const auto index = [&](int a) {
    return static_cast<std::int64_t>(std::floor((x[a] - scene.domain.min[a]) / scene.domain.cell));
  };
  return {index(0), scene.flat() ? 0 : index(1)};
}

struct Column {
  bool before = false, after = false;
  double volume = 0;
};
using Columns = std::map<PlanCell, Column>;  // ordered, so that sums have one order

void measure_footprints(RunOut& r, const Scene& scene, const Columns& columns) {
  const double area = scene.flat() ? scene.domain.cell : scene.domain.cell * scene.domain.cell;
  double volume = 0;
  for (const auto& [cell, column] : columns) {
    r.footprint_before += column.before * area;
    r.footprint_after += column.after * area;
    r.footprint_overlap += (column.before && column.after) * area;
    r.deposit_thickness_largest = std::max(r.deposit_thickness_largest, column.volume / area);
    volume += column.volume;
  }
  r.deposit_thickness_mean = volume / r.footprint_after;
}

/// The first look: volumes, centres, footprints. The highest point before, if any has moved.
std::optional<Point> measure_moved(RunOut& r, const Scene& scene) {
  std::optional<Point> highest;
  Columns columns;
  double mass = 0, all = 0;
  const int up = scene.up();
  const auto add = [&](const Point& point) {
    r.moved_volume += point.V0;
    mass += point.mass;
    r.centre_before = r.centre_before + point.mass * point.X;
    r.centre_after = r.centre_after + point.mass * point.x;
    columns[plan_cell(scene, point.X)].before = true;
    Column& now = columns[plan_cell(scene, point.x)];
    now.after = true;
    now.volume += point.volume;
    if (!highest || point.X[up] > highest->X[up]) highest = point;
  };
  scene.states.each_block([&](const Particles& block) {
    for (const double V : block.reference_volume) all += V;
    scene.each_moved(block, add);
  });
  if (!highest) return highest;
  r.moved_share = r.moved_volume / all;
  r.centre_before = (1 / mass) * r.centre_before;
  r.centre_after = (1 / mass) * r.centre_after;
  measure_footprints(r, scene, columns);
  return highest;
}

/// The unit vector along which the moved mass went, or as asked; zero and why.
void find_direction(RunOut& r, const Scene& scene, const RunOutOptions& options) {
  const Vec3 path = r.centre_after - r.centre_before;
  const Vec3 along = scene.plan(options.direction ? *options.direction : path);
  // Less than a hundredth of the whole is no direction but noise.
  const double least = options.direction ? 0 : 0.01 * std::max(norm(path), 0.1 * r.threshold);
  if (!(norm(along) > least)) {
    r.why_no_direction = options.direction ? "the direction asked for has no horizontal part"
                                           : "the moved mass has no mean horizontal motion";
    return;
  }
  r.direction = (1 / norm(along)) * along;
}

double half_spacing(const Scene& scene, const Point& point) {
  return 0.5 * std::pow(point.V0, 1.0 / scene.domain.dimension);
}

/// The second look, along the direction.
struct Reach {
  Range before, after, sides;
  Point crest_front, crest_rear;  ///< of the moved points within half a spacing of the highest before
  Point front;                    ///< the foremost after
};

Reach find_reach(const RunOut& r, const Scene& scene, const Point& highest) {
  Reach reach{{}, {}, {}, highest, highest, highest};
  const Vec3 across = cross({0, 0, 1}, r.direction);
  const double crest = highest.X[scene.up()] - half_spacing(scene, highest);
  scene.each_moved([&](const Point& point) {
    const double before = dot(point.X, r.direction), after = dot(point.x, r.direction);
    if (after > reach.after.most) reach.front = point;
    reach.before.add(before);
    reach.after.add(after);
    reach.sides.add(dot(point.x, across));
    if (point.X[scene.up()] < crest) return;
    if (before > dot(reach.crest_front.X, r.direction)) reach.crest_front = point;
    if (before < dot(reach.crest_rear.X, r.direction)) reach.crest_rear = point;
  });
  return reach;
}

void measure_along(RunOut& r, const Scene& scene, const Reach& reach) {
  r.run_out = reach.after.most - reach.before.most;
  r.deposit_length = reach.after.most - reach.after.least;
  if (scene.flat())
    r.deposit_width = Extent::none("plane strain");
  else
    r.deposit_width = reach.sides.most - reach.sides.least;
}

/// The third look: of the moved points within half a spacing of the foremost after, the lowest.
Point find_toe(const RunOut& r, const Scene& scene, const Reach& reach) {
  Point toe = reach.front;
  const double front = reach.after.most - half_spacing(scene, reach.front);
  scene.each_moved([&](const Point& point) {
    if (dot(point.x, r.direction) >= front && point.x[scene.up()] < toe.x[scene.up()]) toe = point;
  });
  return toe;
}

void measure_heights(RunOut& r, const Scene& scene, const Reach& reach) {
  const int up = scene.up();
  r.crest_drop = reach.crest_front.X[up] - reach.crest_front.x[up];
  r.crest_retreat = dot(reach.crest_front.X, r.direction) - reach.before.least;
  const Vec3 path = find_toe(r, scene, reach).x - reach.crest_rear.X;
  r.travel_angle = std::atan2(-path[up], dot(path, r.direction)) * 180 / std::numbers::pi;
}

void refuse_heights(RunOut& r, const std::string& why) {
  for (Extent* measure : {&r.crest_drop, &r.crest_retreat, &r.travel_angle}) *measure = Extent::none(why);
}

void refuse_along(RunOut& r, const std::string& why) {
  for (Extent* measure : {&r.run_out, &r.deposit_length, &r.deposit_width}) *measure = Extent::none(why);
  refuse_heights(r, why);
}

bool is_vertical(const Vec3& gravity, int up) {
  return gravity[up] < 0 && -gravity[up] >= std::cos(std::numbers::pi / 180) * norm(gravity);
}

}  // namespace

RunOut measure_run_out(const ParticleStates& states, const Domain& domain, const Vec3& gravity,
                       const RunOutOptions& options) {
  RunOut r;
  r.threshold = options.threshold.value_or(domain.cell);
  const Scene scene{states, domain, r.threshold};
  const std::optional<Point> highest = measure_moved(r, scene);
  if (!highest) {
    r.why_nothing = "nothing moved by " + shortest(r.threshold) + " m";
    refuse_along(r, r.why_nothing);
    return r;
  }
  find_direction(r, scene, options);
  if (!r.why_no_direction.empty()) {
    refuse_along(r, r.why_no_direction);
    return r;
  }
  const Reach reach = find_reach(r, scene, *highest);
  measure_along(r, scene, reach);
  if (is_vertical(gravity, scene.up()))
    measure_heights(r, scene, reach);
  else
    refuse_heights(r, "gravity is not vertical");
  return r;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/run_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "solver/materials/tensor.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

struct Scene {
  const Particles& particles;
  const Domain& domain;
  std::vector<std::size_t> moved;

  int up() const { return domain.dimension - 1; }
  bool flat() const { return domain.dimension == 2; }
  /// The horizontal part.
  Vec3 plan(Vec3 v) const {
    v[up()] = 0;
    return v;
  }
};

/// Least and largest of `value(p)` over the moved points.
template <class F>
std::pair<double, double> range(const Scene& scene, F&& value) {
  double least = INFINITY, most = -INFINITY;
  for (const std::size_t p : scene.moved) {
    const double v = value(p);
    least = std::min(least, v);
    most = std::max(most, v);
  }
  return {least, most};
}

using PlanCell = std::array<std::int64_t, 2>;

PlanCell plan_cell(const Scene& scene, const Vec3& x) {
  const auto index = [&](int a) {
    return static_cast<std::int64_t>(std::floor((x[a] - scene.domain.min[a]) / scene.domain.cell));
  };
  return {index(0), scene.flat() ? 0 : index(1)};
}

void measure_footprints(RunOut& r, const Scene& scene) {
  struct Column {
    bool before = false, after = false;
    double volume = 0;
  };
  std::map<PlanCell, Column> columns;  // ordered, so that sums have one order
  const Particles& P = scene.particles;
  for (const std::size_t p : scene.moved) {
    columns[plan_cell(scene, P.reference_position[p])].before = true;
    Column& now = columns[plan_cell(scene, P.position[p])];
    now.after = true;
    now.volume += P.reference_volume[p] * determinant(P.deformation_gradient[p]);
  }
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

void measure_along(RunOut& r, const Scene& scene) {
  const Particles& P = scene.particles;
  const auto before = range(scene, [&](std::size_t p) { return dot(P.reference_position[p], r.direction); });
  const auto after = range(scene, [&](std::size_t p) { return dot(P.position[p], r.direction); });
  r.run_out = after.second - before.second;
  r.deposit_length = after.second - after.first;
  if (scene.flat()) {
    r.deposit_width = Extent::none("plane strain");
    return;
  }
  const Vec3 across = cross({0, 0, 1}, r.direction);
  const auto sides = range(scene, [&](std::size_t p) { return dot(P.position[p], across); });
  r.deposit_width = sides.second - sides.first;
}

double half_spacing(const Scene& scene, std::size_t p) {
  return 0.5 * std::pow(scene.particles.reference_volume[p], 1.0 / scene.domain.dimension);
}

/// Of the moved points within half a spacing of the highest before: the foremost and the rearmost along.
struct Crest {
  std::size_t front = 0, rear = 0;
};
Crest find_crest(const RunOut& r, const Scene& scene) {
  const Particles& P = scene.particles;
  const int up = scene.up();
  std::size_t highest = scene.moved.front();
  for (const std::size_t p : scene.moved)
    if (P.reference_position[p][up] > P.reference_position[highest][up]) highest = p;
  const double top = P.reference_position[highest][up];
  const double half = half_spacing(scene, highest);
  Crest crest{highest, highest};
  const auto along = [&](std::size_t p) { return dot(P.reference_position[p], r.direction); };
  for (const std::size_t p : scene.moved) {
    if (P.reference_position[p][up] < top - half) continue;
    if (along(p) > along(crest.front)) crest.front = p;
    if (along(p) < along(crest.rear)) crest.rear = p;
  }
  return crest;
}

/// Of the moved points within half a spacing of the foremost after, the lowest.
std::size_t find_toe(const RunOut& r, const Scene& scene) {
  const Particles& P = scene.particles;
  const int up = scene.up();
  const auto along = [&](std::size_t p) { return dot(P.position[p], r.direction); };
  std::size_t toe = scene.moved.front();
  for (const std::size_t p : scene.moved)
    if (along(p) > along(toe)) toe = p;
  const double front = along(toe) - half_spacing(scene, toe);
  for (const std::size_t p : scene.moved)
    if (along(p) >= front && P.position[p][up] < P.position[toe][up]) toe = p;
  return toe;
}

void measure_heights(RunOut& r, const Scene& scene) {
  const Particles& P = scene.particles;
  const int up = scene.up();
  const Crest crest = find_crest(r, scene);
  r.crest_drop = P.reference_position[crest.front][up] - P.position[crest.front][up];
  const auto before = range(scene, [&](std::size_t p) { return dot(P.reference_position[p], r.direction); });
  r.crest_retreat = dot(P.reference_position[crest.front], r.direction) - before.first;
  const Vec3 path = P.position[find_toe(r, scene)] - P.reference_position[crest.rear];
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

void measure_moved(RunOut& r, const Scene& scene) {
  const Particles& P = scene.particles;
  double mass = 0, all = 0;
  for (const double V : P.reference_volume) all += V;
  for (const std::size_t p : scene.moved) {
    r.moved_volume += P.reference_volume[p];
    mass += P.mass[p];
    r.centre_before = r.centre_before + P.mass[p] * P.reference_position[p];
    r.centre_after = r.centre_after + P.mass[p] * P.position[p];
  }
  r.moved_share = r.moved_volume / all;
  r.centre_before = (1 / mass) * r.centre_before;
  r.centre_after = (1 / mass) * r.centre_after;
}

}  // namespace

RunOut measure_run_out(const Particles& particles, const Domain& domain, const Vec3& gravity,
                       const RunOutOptions& options) {
  RunOut r;
  r.threshold = options.threshold.value_or(domain.cell);
  Scene scene{particles, domain, {}};
  for (std::size_t p = 0; p < particles.size(); ++p)
    if (norm(particles.position[p] - particles.reference_position[p]) >= r.threshold) scene.moved.push_back(p);
  if (scene.moved.empty()) {
    r.why_nothing = "nothing moved by " + shortest(r.threshold) + " m";
    refuse_along(r, r.why_nothing);
    return r;
  }
  measure_moved(r, scene);
  measure_footprints(r, scene);
  find_direction(r, scene, options);
  if (!r.why_no_direction.empty()) {
    refuse_along(r, r.why_no_direction);
    return r;
  }
  measure_along(r, scene);
  if (is_vertical(gravity, scene.up()))
    measure_heights(r, scene);
  else
    refuse_heights(r, "gravity is not vertical");
  return r;
}

}  // namespace scarp

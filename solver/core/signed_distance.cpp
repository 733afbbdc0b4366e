// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/signed_distance.hpp"

#include <cmath>

namespace scarp {
namespace {

/// Cosine between the normals of a sheet and the way that it faces.
constexpr double kSheet = 0.17;

Vec3 unit(const Vec3& a) {
  const double length = norm(a);
  return length > 0 ? (1 / length) * a : Vec3{0, 1, 0};
}

}  // namespace

SignedDistance::SignedDistance(const TriangleMesh& surface, double radius, bool flat)
    : tree_(surface), radius_(radius), flat_(flat) {
  for (const Vec3& v : surface.vertices) bounds_.extend(v);
  rounding_ = 1e-12 * norm(bounds_.max - bounds_.min);
}

SignedDistance::Foot SignedDistance::foot_of(const Vec3& x, const ClosestPoint& closest) const {
  const double distance = std::sqrt(closest.squared_distance), side = tree_.side(x, closest) < 0 ? -1 : 1;
  const Vec3 normal =
      distance > rounding_ ? (side / distance) * in_space(x - closest.point) : unit(in_space(tree_.normal(closest)));
  return {side * distance, normal, tree_.face_normal(closest.triangle)};
}

std::optional<SignedDistance::Foot> SignedDistance::at(const Vec3& x, double max_distance) const {
  if (is_ball()) {
    const Vec3 d = x - centre(), n = unit(d);
    const double distance = norm(d) - radius_;
    return std::abs(distance) <= max_distance ? std::optional(Foot{distance, n, n}) : std::nullopt;
  }
  const std::optional<ClosestPoint> closest = tree_.closest(x, max_distance);
  return closest ? std::optional(foot_of(x, *closest)) : std::nullopt;
}

std::optional<SignedDistance::Foot> SignedDistance::at_sheet(const Vec3& x, const Vec3& facing) const {
  if (is_ball()) {
    const Vec3 d = x - centre();
    if (dot(d, facing) > 0) return at(x, INFINITY);
    return Foot{dot(d, facing) - radius_, facing, facing};
  }
  const std::optional<ClosestPoint> closest = tree_.closest_facing(x, INFINITY, facing, kSheet);
  if (!closest) return std::nullopt;
  Foot foot = foot_of(x, *closest);
  // Pseudo-normals of a rim know of faces beyond the sheet: the side is that of the sheet's own face there.
  const std::optional<Vec3> across = tree_.normal_across(*closest);
  const bool rim = !across || !(dot(*across, facing) > kSheet);
  const double above = dot(x - closest->point, foot.face);
  if (rim || closest->feature > Feature::edge_20) {
    const double distance = std::abs(foot.distance);
    if (above < 0 && !(above <= -0.9 * distance)) return std::nullopt;
    foot.distance = above < 0 ? -distance : distance;
    if (distance > rounding_) foot.normal = (1 / foot.distance) * in_space(x - closest->point);
  }
  return foot;
}

std::optional<Vec3> SignedDistance::entered(const Vec3& from, const Vec3& to) const {
  if (!is_ball()) {
    const std::optional<std::uint32_t> triangle = tree_.first_entered(from, to);
    return triangle ? std::optional(tree_.face_normal(*triangle)) : std::nullopt;
  }
  // |from + s way - centre| = R, the smaller s.
  const Vec3 d = from - centre(), way = to - from;
  const double a = dot(way, way), b = dot(d, way), c = dot(d, d) - radius_ * radius_, root = b * b - a * c;
  if (c < 0 || b >= 0 || root < 0 || -b - std::sqrt(root) > a) return std::nullopt;
  return unit(d + ((-b - std::sqrt(root)) / a) * way);
}

}  // namespace scarp

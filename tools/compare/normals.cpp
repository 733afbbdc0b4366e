// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/normals.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include "solver/materials/symmetric_eigen.hpp"

namespace scarp {
namespace {

/// Ascending eigenvalues of a covariance, with the vector of the least.
struct Shape {
  Vec3 values;
  Vec3 flat;
};

Shape shape_of(const Sym6& covariance) {
  const SymmetricEigen eigen = symmetric_eigen(covariance);
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return eigen.values[a] < eigen.values[b]; });
  const auto [l0, l1, l2] = order;
  return {{std::max(0.0, eigen.values[l0]), std::max(0.0, eigen.values[l1]), eigen.values[l2]},
          {eigen.vectors[l0], eigen.vectors[3 + l0], eigen.vectors[6 + l0]}};
}

/// Sum of squared deviations from the mean of the offsets shorter than the radius; false for fewer than three.
bool scatter(const std::vector<Vec3>& offsets, double squared_radius, bool closed, Sym6& sum) {
  const auto inside = [&](const Vec3& d) {
    const double squared = dot(d, d);
    return closed ? squared <= squared_radius : squared < squared_radius;
  };
  Vec3 total{0, 0, 0};
  std::size_t count = 0;
  for (const Vec3& d : offsets)
    if (inside(d)) {
      total = total + d;
      ++count;
    }
  if (count < 3) return false;
  const Vec3 mean = (1 / static_cast<double>(count)) * total;
  sum = {0, 0, 0, 0, 0, 0};
  for (const Vec3& d : offsets)
    if (inside(d)) {
      const Vec3 e = d - mean;
      sum[0] += e[0] * e[0];
      sum[1] += e[1] * e[1];
      sum[2] += e[2] * e[2];
      sum[3] += e[0] * e[1];
      sum[4] += e[1] * e[2];
      sum[5] += e[0] * e[2];
    }
  return true;
}

/// How much a neighbourhood is like a plane; at most 0: not at all.
double flatness(const Vec3& l, ScaleChoice choice) {
  constexpr double kLine = 1e-12;  // squared width over squared length
  if (!(l[1] > kLine * l[2])) return 0;
  if (choice == ScaleChoice::planarity) return (l[1] - l[0]) / l[2];
  // s0 + s1 + s2 = 1, so that 2 s2 + 4 s1 - 2 = 2 (s1 - s0).
  return 2 * (l[1] * l[1] - l[0] * l[0]) / (l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
}

}  // namespace

NormalSearch::NormalSearch(const PointTree& tree, NormalRules rules) : tree_(tree), rules_(std::move(rules)) {
  if (rules_.choice == ScaleChoice::dimensionality)
    std::sort(rules_.radii.begin(), rules_.radii.end(), std::greater<>());
  for (double radius : rules_.radii) largest_ = std::max(largest_, radius);
}

Normal NormalSearch::at(const Vec3& point, std::vector<Vec3>& scratch) const {
  scratch.clear();
  const double widest = largest_ * largest_;
  tree_.visit([&](const PointTree::Box& box) { return may_touch_ball(box, point, largest_); },
              [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                  const Vec3 d = tree_.points()[i] - point;
                  if (dot(d, d) <= widest) scratch.push_back(d);
                }
              });
  Normal best;
  double flattest = 0;
  for (double radius : rules_.radii) {
    Sym6 covariance;
    if (!scatter(scratch, radius * radius, rules_.closed_ball, covariance)) continue;
    const Shape shape = shape_of(covariance);
    const double flat = flatness(shape.values, rules_.choice);
    if (!(flat > flattest)) continue;
    flattest = flat;
    best = {oriented(shape.flat, point, rules_.side, rules_.viewpoint), radius};
  }
  return best;
}

std::optional<Vec3> plane_normal(const std::vector<Vec3>& points) {
  Sym6 covariance;
  if (!scatter(points, INFINITY, true, covariance)) return std::nullopt;
  const Shape shape = shape_of(covariance);
  if (!(flatness(shape.values, ScaleChoice::planarity) > 0)) return std::nullopt;
  return shape.flat;
}

Vec3 oriented(const Vec3& direction, const Vec3& at, NormalSide side, const Vec3& viewpoint) {
  Vec3 wanted{0, 0, 0};
  switch (side) {
    case NormalSide::up:
      wanted[2] = 1;
      break;
    case NormalSide::down:
      wanted[2] = -1;
      break;
    case NormalSide::east:
      wanted[0] = 1;
      break;
    case NormalSide::west:
      wanted[0] = -1;
      break;
    case NormalSide::north:
      wanted[1] = 1;
      break;
    case NormalSide::south:
      wanted[1] = -1;
      break;
    case NormalSide::towards:
      wanted = viewpoint - at;
      break;
    case NormalSide::away:
      wanted = at - viewpoint;
      break;
    case NormalSide::none:
      break;
  }
  return dot(direction, wanted) < 0 ? -1.0 * direction : direction;
}

}  // namespace scarp

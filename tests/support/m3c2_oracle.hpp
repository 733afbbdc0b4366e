// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// M3C2 as it is written down, without a tree: every core point looks at every point.
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp::test {

/// The normal of all points within the radius, z up, by Eigen's iterative solver; NaN for fewer than three.
inline Vec3 slow_normal(const std::vector<Vec3>& points, const Vec3& at, double radius, double* planarity) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> near;
  for (const Vec3& p : points) {
    const Vec3 d = p - at;
    if (dot(d, d) < radius * radius) near.emplace_back(d[0], d[1], d[2]);
  }
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  *planarity = nan;
  if (near.size() < 3) return {nan, nan, nan};
  for (const auto& d : near) sum += d;
  const Eigen::Vector3d mean = sum / static_cast<double>(near.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& d : near) covariance += (d - mean) * (d - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  *planarity = (solver.eigenvalues()[1] - solver.eigenvalues()[0]) / solver.eigenvalues()[2];
  Eigen::Vector3d n = solver.eigenvectors().col(0);
  if (n[2] < 0) n = -n;
  return {n[0], n[1], n[2]};
}

/// Positions along n of the points in a closed cylinder.
inline std::vector<double> slow_cylinder(const std::vector<Vec3>& points, const Vec3& core, const Vec3& n,
                                         double radius, double half_length) {
  std::vector<double> positions;
  for (const Vec3& p : points) {
    const Vec3 d = p - core;
    const double t = dot(d, n);
    const Vec3 across = d - t * n;
    if (std::abs(t) <= half_length && norm(across) <= radius) positions.push_back(t);
  }
  return positions;
}

/// The same as py4dgeo's union of segments.
inline std::vector<double> slow_segments(const std::vector<Vec3>& points, const Vec3& core, const Vec3& n,
                                         double radius, double half_length) {
  const int count = half_length > radius ? static_cast<int>(std::ceil(half_length / radius)) : 1;
  const double length = half_length > radius ? half_length : radius;
  std::vector<double> positions;
  for (const Vec3& p : points) {
    bool inside = false;
    for (int i = 0; i < count; ++i) {
      const Vec3 centre = core + (static_cast<double>(2 * i + 1 - count) / count * length) * n;
      const Vec3 d = p - centre;
      const double t = dot(d, n);
      inside = inside || (std::abs(t) < length / count && dot(d, d) - t * t <= radius * radius);
    }
    if (inside) positions.push_back(dot(p - core, n));
  }
  return positions;
}

}  // namespace scarp::test

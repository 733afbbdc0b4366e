// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/local_surface.hpp"

#include <cmath>

#include "tools/compare/normals.hpp"

namespace scarp {
namespace {

using Row = std::array<double, 6>;

Row monomials(double u, double v) { return {1, u, v, u * u, u * v, v * v}; }

/// Solves the normal equations A x = b in place by Cholesky's factors; false where A is singular.
bool solve(std::array<Row, 6>& A, Row& b) {
  for (std::size_t i = 0; i < 6; ++i) {
    const double before = A[i][i];
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = A[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= A[i][k] * A[j][k];
      if (i != j)
        A[i][j] = sum / A[j][j];
      else if (sum > 1e-12 * before)
        A[i][i] = std::sqrt(sum);
      else
        return false;
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= A[i][k] * b[k];
    b[i] /= A[i][i];
  }
  for (std::size_t i = 6; i-- > 0;) {
    for (std::size_t k = i + 1; k < 6; ++k) b[i] -= A[k][i] * b[k];
    b[i] /= A[i][i];
  }
  return true;
}

}  // namespace

std::optional<LocalSurface> LocalSurface::fit(const std::vector<Vec3>& points, bool quadric) {
  if (points.size() < 3) return std::nullopt;
  Vec3 sum{0, 0, 0};
  for (const Vec3& p : points) sum = sum + (p - points[0]);
  LocalSurface surface;
  surface.origin_ = points[0] + (1 / static_cast<double>(points.size())) * sum;
  double squared = 0;
  std::vector<Vec3> offsets;
  offsets.reserve(points.size());
  for (const Vec3& p : points) {
    offsets.push_back(p - surface.origin_);
    squared = std::max(squared, dot(offsets.back(), offsets.back()));
  }
  const std::optional<Vec3> normal = plane_normal(offsets);
  if (!normal) return std::nullopt;
  surface.normal_ = oriented(*normal, {0, 0, 0}, NormalSide::up, {0, 0, 0});
  surface.size_ = std::sqrt(squared);
  const Vec3& n = surface.normal_;
  const Vec3 other = std::abs(n[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = cross(other, n);
  surface.u_ = (1 / norm(u)) * u;
  surface.v_ = cross(n, surface.u_);
  if (quadric && !surface.fit_heights(points)) return std::nullopt;
  return surface;
}

bool LocalSurface::fit_heights(const std::vector<Vec3>& points) {
  if (points.size() < 6) return false;
  std::array<Row, 6> A{};
  Row b{};
  for (const Vec3& p : points) {
    const Vec3 q = local(p);
    const Row row = monomials(q[0], q[1]);
    for (std::size_t i = 0; i < 6; ++i) {
      b[i] += row[i] * q[2];
      for (std::size_t j = 0; j <= i; ++j) A[i][j] += row[i] * row[j];
    }
  }
  if (!solve(A, b)) return false;
  heights_ = b;
  return true;
}

Vec3 LocalSurface::local(const Vec3& p) const {
  const Vec3 d = (1 / size_) * (p - origin_);
  return {dot(d, u_), dot(d, v_), dot(d, normal_)};
}

double LocalSurface::distance(const Vec3& p) const {
  const Vec3 q = local(p);
  const Row row = monomials(q[0], q[1]);
  const auto& c = heights_;
  double w = 0;
  for (std::size_t i = 0; i < 6; ++i) w += c[i] * row[i];
  const double slope_u = c[1] + 2 * c[3] * q[0] + c[4] * q[1], slope_v = c[2] + c[4] * q[0] + 2 * c[5] * q[1];
  return size_ * (q[2] - w) / std::sqrt(1 + slope_u * slope_u + slope_v * slope_v);
}

LocalSurface::Foot LocalSurface::foot(const Vec3& p) const {
  const Vec3 q = local(p);
  const Row row = monomials(q[0], q[1]);
  const auto& c = heights_;
  double w = 0;
  for (std::size_t i = 0; i < 6; ++i) w += c[i] * row[i];
  const double slope_u = c[1] + 2 * c[3] * q[0] + c[4] * q[1], slope_v = c[2] + c[4] * q[0] + 2 * c[5] * q[1];
  const Vec3 n = normal_ - slope_u * u_ - slope_v * v_;
  return {p + size_ * (w - q[2]) * normal_, (1 / norm(n)) * n, 2 * (c[3] + c[5]) / size_};
}

}  // namespace scarp

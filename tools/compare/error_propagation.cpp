// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/error_propagation.hpp"

#include <cmath>
#include <numbers>

#include "solver/materials/tensor.hpp"

namespace scarp {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// 95 % of a chi-squared variable of three degrees of freedom are below it.
constexpr double kChiSquared3 = 7.814727903251179;

Mat3 operator+(Mat3 a, const Mat3& b) {
  for (std::size_t i = 0; i < 9; ++i) a[i] += b[i];
  return a;
}

Mat3 operator*(double s, Mat3 a) {
  for (double& v : a) v *= s;
  return a;
}

Mat3 outer(const Vec3& a) {
  return {a[0] * a[0], a[0] * a[1], a[0] * a[2], a[1] * a[0], a[1] * a[1],
          a[1] * a[2], a[2] * a[0], a[2] * a[1], a[2] * a[2]};
}

Vec3 times(const Mat3& A, const Vec3& v) {
  return {A[0] * v[0] + A[1] * v[1] + A[2] * v[2], A[3] * v[0] + A[4] * v[1] + A[5] * v[2],
          A[6] * v[0] + A[7] * v[1] + A[8] * v[2]};
}

/// Of a symmetric matrix; the unit matrix for a singular one, as py4dgeo weighs points without errors.
Mat3 inverse_or_unit(const Mat3& A) {
  const double d = determinant(A);
  return d == 0 ? kIdentity : (1 / d) * transpose(cofactor(A));
}

}  // namespace

AlignmentCovariance rigid_alignment(double sigma_translation, double sigma_rotation) {
  AlignmentCovariance C{};
  const auto at = [&](int row, int column) -> double& { return C[static_cast<std::size_t>(12 * row + column)]; };
  // A = 1 + [w]x: a rotation about axis k enters two entries of A, with opposite signs.
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3, plus = 3 * j + i, minus = 3 * i + j;
    const double v = sigma_rotation * sigma_rotation;
    at(plus, plus) = at(minus, minus) = v;
    at(plus, minus) = at(minus, plus) = -v;
    at(9 + k, 9 + k) = sigma_translation * sigma_translation;
  }
  return C;
}

Mat3 point_covariance(const ScannerOptions& options, const Vec3& scanner, const Vec3& point, PropagationRule rule) {
  const Vec3 d = point - scanner;
  const double r = norm(d), plan = std::hypot(d[0], d[1]), sigma = options.sigma_range;
  const double along = rule == PropagationRule::py4dgeo ? sigma * sigma + 1e-6 * sigma * r * r
                                                        : sigma * sigma + std::pow(options.range_scale * r, 2);
  if (r == 0) return along * kIdentity;  // seen from nowhere, in no direction
  const Vec3 ahead = (1 / r) * d, left = plan > 0 ? Vec3{-d[1] / plan, d[0] / plan, 0} : Vec3{0, 1, 0};
  const Vec3 up = cross(ahead, left);
  return along * outer(ahead) + std::pow(plan * kDegree * options.sigma_azimuth, 2) * outer(left) +
         std::pow(r * kDegree * options.sigma_elevation, 2) * outer(up);
}

Mat3 alignment_covariance(const AlignmentCovariance& C, const Vec3& d) {
  // Coordinate i of the moved point is a_i1 d_1 + a_i2 d_2 + a_i3 d_3 + t_i.
  const auto place = [](int i, int k) { return static_cast<std::size_t>(k < 3 ? 3 * i + k : 9 + i); };
  const double weight[4]{d[0], d[1], d[2], 1};
  Mat3 moved{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 4; ++l)
          moved[static_cast<std::size_t>(3 * i + j)] += weight[k] * weight[l] * C[12 * place(i, k) + place(j, l)];
  return moved;
}

PropagatedMean propagate(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& members,
                         const SurveyErrors& errors, bool observed) {
  const SideErrors& side = observed ? errors.observed : errors.simulated;
  const bool published = errors.rule == PropagationRule::py4dgeo, scanned = !side.scanner.positions.empty();
  const auto n = static_cast<double>(members.size());
  const Vec3 first = points[members[0]];  // sums of differences keep digits
  PropagatedMean result;
  Mat3 weights{};
  Vec3 weighted{0, 0, 0}, plain{0, 0, 0};
  for (std::uint32_t i : members) {
    const Vec3 d = points[i] - first;
    plain = plain + d;
    if (observed && published)
      result.aligned = result.aligned + (1 / n) * alignment_covariance(errors.alignment, points[i] - errors.centre);
    if (!scanned) continue;
    const Vec3& scanner = side.scanner.positions[side.scanner_of.empty() ? 0 : side.scanner_of[i]];
    const Mat3 C = point_covariance(side.scanner, scanner, points[i], errors.rule);
    result.measured = result.measured + C;
    if (!published) continue;
    const Mat3 W = inverse_or_unit(C);
    weights = weights + W;
    weighted = weighted + times(W, d);
  }
  result.measured = (published ? 1 / n : 1 / (n * n)) * result.measured + (side.floor * side.floor) * kIdentity;
  result.mean = first + (published && scanned ? times(inverse_or_unit(weights), weighted) : (1 / n) * plain);
  if (observed && !published) result.aligned = alignment_covariance(errors.alignment, result.mean - errors.centre);
  return result;
}

double variance_along(const Mat3& C, const Vec3& n) { return dot(n, times(C, n)); }

double propagated_detection(const Mat3& covariance, const Vec3& normal, double registration_error,
                            PropagationRule rule) {
  if (rule == PropagationRule::mean) return 1.96 * (std::sqrt(variance_along(covariance, normal)) + registration_error);
  const double d = determinant(covariance);
  if (!(d > 0)) return NAN;
  return std::sqrt(kChiSquared3 / variance_along((1 / d) * transpose(cofactor(covariance)), normal));
}

}  // namespace scarp

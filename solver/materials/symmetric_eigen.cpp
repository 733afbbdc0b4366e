// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/symmetric_eigen.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {
namespace {

/// The rotation that diagonalises [pp pq; pq qq]: pp - t pq and qq + t pq are the eigenvalues, (c, -s) and (s, c) the
/// vectors; |angle| <= 45 deg.
struct Rotation {
  double t, c, s;
};
inline Rotation diagonalise(double pp, double qq, double pq) {
  if (pq == 0) return {0, 1, 0};
  const double difference = qq - pp;
  const double radius = std::sqrt(difference * difference + 4 * pq * pq);
  const double t = 2 * pq / (difference + std::copysign(radius, difference));
  const double c = 1 / std::sqrt(1 + t * t);
  return {t, c, t * c};
}

/// The root of x^3 - 3 x - 2 r = 0 in [sqrt(3), 2], 2 cos(acos(r) / 3), for r in [0, 1]: the cubic with the
/// root's values and slopes at both ends is within 1e-3; a step of Halley's cubes that, one of Newton's squares it.
inline double isolated_root(double r) {
  constexpr double x0 = 1.7320508075688772, d0 = 1.0 / 3, x1 = 2, d1 = 2.0 / 9;
  double x = x0 + r * (d0 + r * (3 * (x1 - x0) - 2 * d0 - d1 + r * (2 * (x0 - x1) + d0 + d1)));
  const double f = x * (x * x - 3) - 2 * r, slope = 3 * (x * x - 1);
  x -= f * slope / (slope * slope - 3 * f * x);
  return x - (x * (x * x - 3) - 2 * r) / (3 * (x * x - 1));
}

inline Vec3 times(const Sym6& B, const Vec3& v) {
  return {B[0] * v[0] + B[3] * v[1] + B[5] * v[2], B[3] * v[0] + B[1] * v[1] + B[4] * v[2],
          B[5] * v[0] + B[4] * v[1] + B[2] * v[2]};
}

/// The null vector of the symmetric M of rank two: the row of its adjugate that cancels least, made a unit vector.
inline Vec3 null_vector(const Sym6& M) {
  const double xx = M[1] * M[2] - M[4] * M[4], yy = M[0] * M[2] - M[5] * M[5], zz = M[0] * M[1] - M[3] * M[3];
  const double xy = M[5] * M[4] - M[3] * M[2], yz = M[3] * M[5] - M[0] * M[4], xz = M[3] * M[4] - M[1] * M[5];
  Vec3 n{xx, xy, xz};
  double largest = std::abs(xx);
  if (std::abs(yy) > largest) {
    largest = std::abs(yy);
    n = {xy, yy, yz};
  }
  if (std::abs(zz) > largest) n = {xz, yz, zz};
  return (1 / norm(n)) * n;
}

SymmetricEigen plane_eigen(const Sym6& A) {
  const Rotation q = diagonalise(A[0], A[1], A[3]);
  return {{A[0] - q.t * A[3], A[1] + q.t * A[3], A[2]}, {q.c, q.s, 0, -q.s, q.c, 0, 0, 0, 1}};
}

}  // namespace

SymmetricEigen symmetric_eigen(const Sym6& A) {
  if (A[4] == 0 && A[5] == 0) return plane_eigen(A);
  const double mean = (A[0] + A[1] + A[2]) / 3;
  const double x = A[0] - mean, y = A[1] - mean, z = A[2] - mean;
  // B = (A - mean I) / p has the roots 2 cos(...) of x^3 - 3 x - det B = 0.
  const double p = std::sqrt((x * x + y * y + z * z + 2 * (A[3] * A[3] + A[4] * A[4] + A[5] * A[5])) / 6);
  const double per_p = 1 / p;
  const Sym6 B{x * per_p, y * per_p, z * per_p, A[3] * per_p, A[4] * per_p, A[5] * per_p};
  const double half_determinant = 0.5 * (B[0] * (B[1] * B[2] - B[4] * B[4]) - B[3] * (B[3] * B[2] - B[4] * B[5]) +
                                         B[5] * (B[3] * B[4] - B[1] * B[5]));
  const double root = std::copysign(isolated_root(std::min(1.0, std::abs(half_determinant))), half_determinant);
  const Vec3 n = null_vector({B[0] - root, B[1] - root, B[2] - root, B[3], B[4], B[5]});
  // u, w across n without a branch (Duff et al. 2017).
  const double sign = std::copysign(1.0, n[2]);
  const double a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
  const Vec3 u{1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]};
  const Vec3 w{b, sign + n[1] * n[1] * a, -n[1]};
  const Vec3 Bu = times(B, u), Bw = times(B, w);
  const double uu = dot(u, Bu), ww = dot(w, Bw), uw = dot(u, Bw);
  const Rotation q = diagonalise(uu, ww, uw);
  const Vec3 m = q.c * u - q.s * w, l = q.s * u + q.c * w;
  return {{mean + p * root, mean + p * (uu - q.t * uw), mean + p * (ww + q.t * uw)},
          {n[0], m[0], l[0], n[1], m[1], l[1], n[2], m[2], l[2]}};
}

}  // namespace scarp

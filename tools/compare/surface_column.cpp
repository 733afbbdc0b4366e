// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/surface_column.hpp"

#include <algorithm>
#include <numbers>

#include "solver/materials/tensor.hpp"

namespace scarp {
namespace {

constexpr double kDepth = 2;    ///< of the column below the particle, spacings
constexpr double kAbove = 2.5;  ///< what floats higher belongs to something else
constexpr double kEdge = 0.95;  ///< coverage from which a column counts as full
constexpr double kThin = 0.75;  ///< of the coverage; less of it at the foot of the column: the layer ends above
constexpr double kAlone = 0.4;  ///< coverage below which there is no surface
constexpr double kBent = 6;     ///< condition of F up to which neighbours are still those of the lattice

/// From offsets around a particle to the lattice, in spacings, and back.
struct Lattice {
  double spacing;
  Mat3 F = kIdentity, inverse = kIdentity;
  double stretch = 1;  ///< no offset is longer than this times its length on the lattice

  Lattice(const MaterialPoints& points, std::size_t i) : spacing(points.spacing(i)) {
    if (points.gradient.empty()) return;
    const Mat3& G = points.gradient[i];
    const double J = determinant(G);
    if (!(J > 0)) return;
    const Mat3 cof = cofactor(G);
    Mat3 G_inverse = transpose(cof);
    for (double& v : G_inverse) v /= J;
    // Frobenius norms: their product is 3 for a rotation.
    if (!(std::sqrt(square_norm(G) * square_norm(G_inverse)) <= kBent)) return;
    F = G;
    inverse = G_inverse;
    stretch = std::sqrt(square_norm(G));
    spacing = std::cbrt(points.volume[i] / J);
  }

  static Vec3 times(const Mat3& A, const Vec3& v) {
    return {A[0] * v[0] + A[1] * v[1] + A[2] * v[2], A[3] * v[0] + A[4] * v[1] + A[5] * v[2],
            A[6] * v[0] + A[7] * v[1] + A[8] * v[2]};
  }
  Vec3 on_lattice(const Vec3& offset) const { return (1 / spacing) * times(inverse, offset); }
  Vec3 in_space(const Vec3& q) const { return spacing * times(F, q); }
  /// Normals go with the cofactor: N ~ F^T n.
  Vec3 normal(const Vec3& n) const {
    const Vec3 N = times(transpose(F), n);
    return (1 / norm(N)) * N;
  }
};

/// Directions across N, and a place between -1/2 and 1/2 along each that fills the square evenly as `point` counts up
/// (Roberts' sequence, the plane's golden ratio).
struct Axis {
  Vec3 N, u, v, foot;

  Axis(const Vec3& direction, std::size_t point) : N(direction) {
    const Vec3 other = std::abs(N[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    u = cross(other, N);
    u = (1 / norm(u)) * u;
    v = cross(N, u);
    const auto spread = [&](double ratio) { return std::fmod(ratio * static_cast<double>(point), 1.0) - 0.5; };
    foot = spread(0.7548776662466927) * u + spread(0.5698402909980532) * v;
  }
};

/// Wendland's C2 function of the distance over the support, with unit integral over the plane.
double kernel(double squared) {
  const double q = std::sqrt(squared) / kSurfaceReach;
  if (q >= 1) return 0;
  const double r = 1 - q;
  return 7 / (std::numbers::pi * kSurfaceReach * kSurfaceReach) * r * r * r * r * (4 * q + 1);
}

/// Rises from 0 a spacing below the foot of the column to 1 a spacing above it, twice continuously differentiable.
double above_foot(double z) {
  const double t = std::clamp(0.5 * (z + kDepth + 1), 0.0, 1.0);
  return t * t * t * (10 + t * (6 * t - 15));
}

/// The quadratic B-spline.
double spline(double z) {
  const double q = std::abs(z);
  return q < 0.5 ? 0.75 - q * q : q < 1.5 ? 0.5 * (1.5 - q) * (1.5 - q) : 0;
}

/// A hat: layers a spacing apart add up to 1, a single one counts in full.
double hat(double z) { return std::max(0.0, 1 - std::abs(z)); }

/// What stands in a column, by depth.
struct Filling {
  double thickness = 0;         ///< T
  double near = 0, moment = 0;  ///< of what is no deeper than the column, and its moment about the particle
  double own = 0;               ///< coverage at the particle's depth
  double next = 0, smooth = 0;  ///< and a spacing deeper, by hat and spline
  double deep = 0;              ///< and at the foot

  void add(double volume_over_area, double z) {
    thickness += volume_over_area * above_foot(z);
    if (z > -kDepth - 0.5) {
      near += volume_over_area;
      moment += volume_over_area * z;
    }
    own += volume_over_area * hat(z);
    next += volume_over_area * hat(z + 1);
    smooth += volume_over_area * spline(z + 1);
    deep += volume_over_area * spline(z + kDepth);
  }
};

}  // namespace

std::optional<SurfacePiece> SurfaceColumns::at(std::size_t point, const Vec3& normal) const {
  const Lattice lattice(points_, point);
  const Axis axis(lattice.normal(normal), point);
  const Vec3& centre = points_.positions[point];
  const double reach = std::hypot(kSurfaceReach + 0.75, kDepth + 1) * lattice.spacing * lattice.stretch;
  Filling filling;
  tree_.visit([&](const PointTree::Box& box) { return may_touch_ball(box, centre, reach); },
              [&](std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k) {
                  const Vec3 q = lattice.on_lattice(tree_.points()[k] - centre) - axis.foot;
                  const double z = dot(q, axis.N);
                  if (z > kAbove || z < -kDepth - 1) continue;
                  const double w = kernel(std::max(0.0, dot(q, q) - z * z));
                  if (w > 0) filling.add(w * points_.volume[tree_.indices()[k]] / points_.volume[point], z);
                }
              });
  SurfacePiece piece;
  piece.normal = normal;
  piece.coverage = std::max({filling.own, filling.next, filling.smooth});
  if (piece.coverage < kAlone) return std::nullopt;
  const double share = piece.coverage < kEdge ? piece.coverage : 1;
  const bool thin = filling.deep < kThin * share;
  piece.height = thin ? filling.moment / filling.near + 0.5 * filling.near / share : filling.thickness / share - kDepth;
  piece.position = centre + lattice.in_space(axis.foot + piece.height * axis.N);
  return piece;
}

Vec3 SurfaceColumns::outwards(std::size_t point) const {
  const Vec3& centre = points_.positions[point];
  const double reach = kSurfaceReach * points_.spacing(point);
  Vec3 sum{0, 0, 0};
  double whole = 0;
  tree_.visit([&](const PointTree::Box& box) { return may_touch_ball(box, centre, reach); },
              [&](std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k) {
                  const Vec3 d = tree_.points()[k] - centre;
                  const double q = norm(d) / reach;
                  if (q >= 1 || q == 0) continue;
                  // The slope of (1 - q)^4 (4 q + 1) is -20 q (1 - q)^3.
                  const double weight = points_.volume[tree_.indices()[k]] * (1 - q) * (1 - q) * (1 - q);
                  sum = sum - weight * d;
                  whole += weight * q * reach;
                }
              });
  return whole > 0 ? (1 / whole) * sum : Vec3{0, 0, 0};
}

}  // namespace scarp

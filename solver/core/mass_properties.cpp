// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/mass_properties.hpp"

#include <cmath>
#include <numbers>

#include "solver/materials/symmetric_eigen.hpp"

namespace scarp {
namespace {

using std::numbers::pi;

/// f(point, area vector share) of a rule that is exact for cubics on each triangle.
template <class F>
void integrate(const TriangleMesh& surface, const Vec3& origin, F&& f) {
  constexpr double middle = -27.0 / 48, outer = 25.0 / 48;
  for (const auto& t : surface.triangles) {
    const Vec3 a = surface.vertices[t[0]] - origin, b = surface.vertices[t[1]] - origin,
               c = surface.vertices[t[2]] - origin, area = 0.5 * cross(b - a, c - a);
    const Vec3 sum = a + b + c;
    f((1.0 / 3) * sum, middle * area);
    for (const Vec3& corner : {a, b, c}) f(0.2 * sum + 0.4 * corner, outer * area);
  }
}

MassProperties ball(const Vec3& centre, double R, double density, int dimension) {
  MassProperties result;
  result.mass = density * (dimension == 2 ? pi * R * R : 4.0 / 3 * pi * R * R * R);
  result.centre = centre;
  const double moment = (dimension == 2 ? 0.5 : 0.4) * result.mass * R * R;
  result.moments = {moment, moment, moment};
  return result;
}

}  // namespace

MassProperties mass_properties(const TriangleMesh& surface, double radius, double density, int dimension) {
  Box3 bounds;
  for (const Vec3& v : surface.vertices) bounds.extend(v);
  const Vec3 origin = 0.5 * (bounds.min + bounds.max);
  if (radius > 0) return ball(origin, radius, density, dimension);
  // Fields without a part along z leave out the ends of a prism.
  double volume = 0, xy = 0, yz = 0, zx = 0;
  Vec3 first{0, 0, 0}, second{0, 0, 0};
  integrate(surface, origin, [&](const Vec3& x, const Vec3& n) {
    volume += x[0] * n[0];
    for (int a = 0; a < 3; ++a) {
      first[a] += 0.5 * x[a] * x[a] * n[a];
      second[a] += x[a] * x[a] * x[a] / 3 * n[a];
    }
    xy += 0.5 * x[0] * x[0] * x[1] * n[0];
    yz += 0.5 * x[1] * x[1] * x[2] * n[1];
    zx += 0.5 * x[0] * x[0] * x[2] * n[0];
  });
  const double scale = dimension == 2 ? density / (bounds.max[2] - bounds.min[2]) : density;
  MassProperties result;
  result.mass = scale * volume;
  Vec3 arm = (1 / volume) * first;
  if (dimension == 2) arm[2] = second[2] = 0;
  result.centre = origin + arm;
  if (dimension == 2) result.centre[2] = 0;
  const double m = result.mass;
  const Vec3 square{scale * second[0] - m * arm[0] * arm[0], scale * second[1] - m * arm[1] * arm[1],
                    scale * second[2] - m * arm[2] * arm[2]};
  if (dimension == 2) {
    result.moments.fill(square[0] + square[1]);
    return result;
  }
  const SymmetricEigen eigen = symmetric_eigen({square[1] + square[2], square[2] + square[0], square[0] + square[1],
                                                m * arm[0] * arm[1] - scale * xy, m * arm[1] * arm[2] - scale * yz,
                                                m * arm[2] * arm[0] - scale * zx});
  result.moments = eigen.values;
  const Mat3& V = eigen.vectors;
  const Vec3 u{V[0], V[3], V[6]}, v{V[1], V[4], V[7]}, w = cross(u, v);
  result.axes = {u[0], v[0], w[0], u[1], v[1], w[1], u[2], v[2], w[2]};
  return result;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A ContactSurface as the nodes move it: y = Y + sum phi_I(Y) U_I, F = I + sum U_I (x) grad0 phi_I, where U_I sums up
// dt v_I of the momenta mapped last. It is these that forces on nodes do work on (d/dt sum m_p v_p^2 / 2 = sum v_I
// f_I): with the places of particles instead, which v~_I moves, a rebound of disks loses 3 % of its energy.
#pragma once

#include <algorithm>

#include "solver/core/contact_surface.hpp"

namespace scarp {

/// Direction of F^-T N, the normal of a surface after the deformation F (Nanson), by cofactors: no division by det F.
inline Vec3 current_normal(const Mat3& F, const Vec3& N) {
  const Vec3 a{F[0], F[1], F[2]}, b{F[3], F[4], F[5]}, c{F[6], F[7], F[8]};
  const Vec3 n{dot(cross(b, c), N), dot(cross(c, a), N), dot(cross(a, b), N)};
  const double length = norm(n);
  return length > 0 ? (1 / length) * n : N;
}

/// F - I at a place of a linear cell, by differences along one axis after the other of its corners' displacements.
template <int D>
inline Mat3 displacement_gradient(Vec3 (&u)[1 << D], const Vec3& xi, double per_edge) {
  Vec3 along[D][1 << (D - 1)];
  for (int a = 0, left = 1 << (D - 1); a < D; ++a, left /= 2)
    for (int k = 0; k < left; ++k) {
      for (int b = 0; b < a; ++b) along[b][k] = along[b][2 * k] + xi[a] * (along[b][2 * k + 1] - along[b][2 * k]);
      along[a][k] = u[2 * k + 1] - u[2 * k];
      u[k] = u[2 * k] + xi[a] * along[a][k];
    }
  Mat3 gradient{};
  for (int i = 0; i < D; ++i)
    for (int a = 0; a < D; ++a) gradient[3 * i + a] = per_edge * along[a][0][i];
  return gradient;
}

template <int D, bool normals, class Displacement>
void locate_points_in(const ContactSurface& surface, const std::uint32_t* points, std::size_t count, Displacement&& U,
                      std::vector<Vec3>& y, std::vector<Vec3>* n) {
  constexpr std::size_t corners = 1 << D;
  const double per_edge = 1 / surface.cell_edge;
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint32_t i = points[j];
    Vec3 u[corners], place = surface.Y[i];
    for (std::size_t k = 0; k < corners; ++k) {
      u[k] = U(surface.nodes[i * corners + k]);
      place = place + surface.weights[i * corners + k] * u[k];
    }
    y[i] = place;
    if constexpr (normals) {
      Mat3 F = displacement_gradient<D>(u, surface.xi[i], per_edge);
      for (int a = 0; a < 3; ++a) F[4 * a] += 1;
      (*n)[i] = current_normal(F, surface.N[i]);
    }
  }
}

/// Place of some points, and their normals unless `n` is null; other entries stay.
/// @param U  U(node), m
template <class Displacement>
void locate_points(const ContactSurface& surface, const std::uint32_t* points, std::size_t count, Displacement&& U,
                   std::vector<Vec3>& y, std::vector<Vec3>* n) {
  const auto locate = surface.corners == 4
                          ? (n ? &locate_points_in<2, true, Displacement> : &locate_points_in<2, false, Displacement>)
                          : (n ? &locate_points_in<3, true, Displacement> : &locate_points_in<3, false, Displacement>);
  locate(surface, points, count, std::forward<Displacement>(U), y, n);
}

/// U of the surface's nodes.
template <class Displacement>
void anchor_points(const ContactSurface& surface, Displacement&& U, std::vector<Vec3>& anchor) {
  anchor.resize(surface.distinct.size());
  for (std::size_t i = 0; i < anchor.size(); ++i) anchor[i] = U(surface.distinct[i]);
}

/// The largest change since, m.
template <class Displacement>
double shift_of_points(const ContactSurface& surface, Displacement&& U, const std::vector<Vec3>& anchor) {
  double square = 0;
  for (std::size_t i = 0; i < anchor.size(); ++i) {
    const Vec3 d = U(surface.distinct[i]) - anchor[i];
    square = std::max(square, dot(d, d));
  }
  return std::sqrt(square);
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The affine particle-in-cell transfer (APIC; Jiang, Schroeder, Selle, Teran, Stomakhin 2015; Jiang, Schroeder, Teran
// 2017): a particle is a small affine velocity field, v_p + C_p (x - x_p).
//
//   (1)  (m v)_I = sum_p phi_Ip m_p [v_p + C_p (x_I - x_p)]
//   (3)  v_p <- sum_I phi_Ip v~_I                                                    as PIC
//        C_p <- [sum_I phi_Ip (v~_I - v_p) x (x_I - x_p)] D_p^-1,   D_p = sum_I phi_Ip (x_I - x_p) x (x_I - x_p)
//
// (v_p, C_p) is the affine field nearest to v~_I under the particle's weights, so that the map to the particles can
// only lose energy, namely what is not affine, and the map back, a mean, what differs between particles.
//
// D_p: shape functions are products that reproduce linear fields, so that D_p is diagonal, each entry of one axis
// alone. It is h^2/4 for quadratic B-splines off the walls, xi (1 - xi) h^2 for linear functions, where C_p is
// sum v~_I x grad phi_Ip, and h^2/8 at least for GIMP with two particles per axis. It is found per particle in all
// families. It vanishes at the nodes of linear functions and at the walls of B-splines. Then C_p would still be finite
// for a smooth v~, but v~_I of a node so light, dt f_I / m_I, has no bound without the weight phi_Ip:
// updated-Lagrangian bodies take h^2/8 where an entry of D_p is smaller, which makes C_p smaller, and never larger.
//
// C_p is kept from step to step, not C_p D_p as in the papers: where D_p varies, C_p D_p / D_p of the next place grows
// without bound as a particle comes to a node. The price: angular momentum, sum of x_p x m v_p and m C_p D_p's skew
// part, is kept to rounding only where D_p does not vary (B-splines off walls); elsewhere it changes by the change of
// D_p, once per step.
//
// Total-Lagrangian bodies: X for x, in the reference configuration, where nothing varies. C_p is per reference length.
//
// At the start C_p is that of the given velocities as the nodes see them, S+ v_p.
#pragma once

#include "solver/core/total_body.hpp"
#include "solver/core/updated_grid.hpp"
#include "solver/model/particles.hpp"

namespace scarp {

/// What the affine parts of particles add to sums over their centres.
struct AffineMotion {
  double kinetic = 0;              ///< sum of m tr(C D C^T) / 2, J
  Vec3 angular_momentum{0, 0, 0};  ///< sum of m times the skew part of F D C^T, kg m2/s
};

/// C_p of the particles' velocities as they stand, for the first step. Slots and v_I are those of (1), (2) afterwards.
void begin_affine(Particles& particles, UpdatedGrid& grid, int threads);
void begin_affine(const Particles& particles, TotalBody& body, int threads);

/// (1) Slots' momenta += sum_p phi_Ip m_p C_p (x_I - x_p), at the particles' present places.
void add_affine_momenta(const Particles& particles, UpdatedGrid& grid, int threads);

/// (3) C_p of v~_I and of PIC's v_p, which advance_particles has found, with the weights of the step; and (5) slots'
/// momenta += its share of the second map.
void advance_affine(const Particles& particles, UpdatedGrid& grid, int threads);
void advance_affine(const Particles& particles, TotalBody& body, int threads);

/// Of the state as it stands; the same bits for any number of threads.
AffineMotion measure_affine(const Particles& particles, const UpdatedGrid& grid, int threads);
AffineMotion measure_affine(const Particles& particles, const TotalBody& body, int threads);

inline AffineMotion operator+(const AffineMotion& a, const AffineMotion& b) {
  return {a.kinetic + b.kinetic, a.angular_momentum + b.angular_momentum};
}

/// Of one particle. D: the diagonal of D_p, m2.
inline AffineMotion affine_motion(double mass, const Mat3& F, const Vec3& D, const Mat3& C) {
  AffineMotion sum;
  Mat3 M{};  // F D C^T
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < 3; ++a) {
      sum.kinetic += 0.5 * mass * D[a] * C[3 * i + a] * C[3 * i + a];
      for (int j = 0; j < 3; ++j) M[3 * i + j] += mass * F[3 * i + a] * D[a] * C[3 * j + a];
    }
  sum.angular_momentum = {M[5] - M[7], M[6] - M[2], M[1] - M[3]};
  return sum;
}

}  // namespace scarp

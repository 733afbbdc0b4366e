// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extended particle-in-cell transfer of order m (XPIC; Hammerquist and Nairn 2017). With S from nodes to particles,
// (S v)_p = sum_I phi_Ip v_I, and S+ the lumped map back, (S+ v)_I = sum_p phi_Ip m_p v_p / m_I, PIC gives S v~ and
// FLIP v_p + S (v~ - v). FLIP keeps in v_p what the nodes cannot see and never damp; PIC drops it, and what they see in
// part. XPIC replaces v_p by [I - (I - S S+)^m] v_p, which drops what they do not see and nearly nothing else:
//
//   v_p <- S (v* + v~ - v)          x_p <- x_p + dt S v~, as with every transfer here
//   v*  =  sum_(k=1)^m (-1)^(k+1) binomial(m, k) u_k,    u_1 = v = S+ v_p,   u_(k+1) = S+ S u_k
//
// m = 1 is PIC, and m without limit FLIP without its null space. Where conditions hold or drive a node's axis, u_k is
// v_I there, and so is v*. Hammerquist and Nairn let x_p feel v_p besides v~ (their second-order term); the rule kept
// here moves particles in the one velocity field that the nodes agree on, so that they do not cross, as all of scarp's
// transfers do.
#pragma once

#include "solver/core/total_body.hpp"
#include "solver/core/updated_grid.hpp"
#include "solver/model/particles.hpp"

namespace scarp {

/// v*_I into `filtered`, of the velocities v_I at the beginning of the step; slots' momenta are lost. After the step's
/// conditions, whose axes are `kept`; before advance_particles. order - 1 sweeps to the particles and back.
void filter_velocities(const Particles& particles, UpdatedGrid& grid, int order, int threads);
void filter_velocities(const Particles& particles, TotalBody& body, int order, int threads);

/// binomial(order, k) with the sign of u_k's share in v*.
constexpr double xpic_factor(int order, int k) {
  double factor = k % 2 == 1 ? 1 : -1;
  for (int i = 1; i <= k; ++i) factor *= static_cast<double>(order - k + i) / i;
  return factor;
}

/// `mapped`, but `before` along held axes, bit 0 for x.
inline Vec3 with_held(const Vec3& mapped, const Vec3& before, std::uint8_t held) {
  Vec3 v = mapped;
  for (int a = 0; a < 3; ++a)
    if (held >> a & 1) v[a] = before[a];
  return v;
}

}  // namespace scarp

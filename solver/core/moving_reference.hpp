// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Total-Lagrangian bodies whose reference configuration moves (as in updated reference configurations of finite
// elements; de Vaucorbeil, Nguyen, Hutchinson 2020 name it for TLMPM). Where one particle has been stretched beyond a
// limit since the last move, the grid is built anew from the particles where they are:
//
//   F = F' F0      F0: F at the move; F': since, by the gradients on the new grid
//   dF = dt (sum v_I x grad phi_I) F0
//   force = - sum_p V0 P F0^T grad phi_I, P = J sigma F^-T, as V J' sigma F'^-T with V = V0 det F0
//
// X, V0, F, the laws' history and stress stay those of the first reference configuration: displacements, energies and
// frames are what they would be without. So are the particles' masses and velocities: a move changes no momentum and no
// energy of the particles. What it costs shows in the steps after it, as particles meet other nodes.
#pragma once

#include <optional>

#include "solver/core/current_wave_speed.hpp"
#include "solver/core/total_body.hpp"
#include "solver/materials/motion.hpp"

namespace scarp {

/// Cells that the particles' new places fill unevenly are stable to 0.5, where even ones are to 1.4: the energy of a
/// slump that moved seven times drifts by 0.1 % of what falls at 0.2 to 0.5, and by 1 % from 0.6 on.
inline constexpr double kCourantOfMovedGrids = 0.5;

/// F0 of the body's particle p (index into Model::particles); none before the first move.
inline const Mat3* base_of(const TotalBody& body, std::size_t p) {
  return body.base.empty() ? nullptr : &body.base[p - body.begin];
}

/// P F0^T, which takes gradients on the moved grid as P takes those on the first.
inline Mat3 on_moved_grid(const Mat3& P, const Mat3* base) { return base ? multiply_transposed(P, *base) : P; }

/// F' = F F0^-1.
inline Mat3 since_move(const Mat3& F, const Mat3& base) {
  const Mat3 c = cofactor(base);
  Mat3 since = multiply_transposed(F, c);
  const double per_J = 1 / determinant(base, c);
  for (double& value : since) value *= per_J;
  return since;
}

/// Upper bound of c^2, (m/s)^2, in the configuration of the grid: the law's own before the first move; after it that of
/// the current configuration, through the inverse of F' (see current_wave_speed_squared, which does the reverse).
template <class Law>
double grid_wave_speed_squared(const Law& law, const Motion& motion, const PointHistory& history, const Mat3* base) {
  if (!base) return law.wave_speed_squared(motion, history);
  const Mat3 since = since_move(motion.F, *base);
  return current_wave_speed_squared(law, motion, history) * inverse_square_of_least_stretch(make_motion(since, since));
}

/// Whether the ratio of the largest to the smallest principal stretch since the last move (in plane strain: in the
/// plane) exceeds `limit` in any particle of the body. 2.6 is a shear of 1.
bool is_past_limit(const Particles& particles, const TotalBody& body, double limit, int threads);

/// Makes the current configuration the body's reference one. Sorts its particles by cell anew; lattice and held nodes
/// stay where they are in space, and the lattice grows as needed. The caller maps momenta and stresses then.
/// @return the index of a particle too far away for any lattice, and then nothing has changed; else none
std::optional<std::size_t> move_reference(Model& model, TotalBody& body);

}  // namespace scarp

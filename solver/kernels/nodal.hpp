// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels of the total-Lagrangian method in its nodal form work on: plain arrays and plain numbers, which
// mean the same to translation units of every instruction set.
//
// The weights of a total-Lagrangian body never change. So the state of a particle is a linear function of
// accumulators on the nodes, which all start at zero (alpha: FLIP share, a: product of all alpha so far):
//
//   U_I += dt v~_I                                 F_p = I + sum_I U_I (x) grad0 phi_Ip
//   W_I += dt v_I'                                 x_p = X_p + sum_I phi_Ip W_I
//   A_I  = alpha A_I + v_I' - alpha v_I            v_p = a v_p(0) + sum_I phi_Ip A_I
//   p_I  = a P0_I + sum_J M_IJ A_J                 M_IJ = sum_p m_p phi_Ip phi_Jp, P0_I = sum_p phi_Ip m_p v_p(0)
//
// with v_I the velocities mapped last, v_I' those after the forces, v~_I = p_I / m_I the next ones mapped (method.md
// 1.1, steps 1 to 5). A step touches no byte of a particle but its history: that is all of the speed.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scarp::kernels {

/// Cells along x that are worked on at once, whatever the instruction set: the layout does not depend on it.
inline constexpr int kSegment = 8;

/// Cells with 2^D points at a quarter and three quarters of the cell (regular), or points anywhere (cut).
enum class CellKind : std::uint8_t { regular, cut };

/// Laws that have a kernel.
enum class LawKind : std::uint8_t { neo_hookean, hencky, von_mises, drucker_prager, mohr_coulomb };
inline constexpr int kLawKinds = 5;

/// Doubles that a law's kernel remembers of a point: C_p^-1 (3D: xx, yy, zz, xy, yz, xz; plane strain: xx, yy, zz, xy),
/// the plastic strain's inverse right Cauchy-Green tensor, with b_e = F C_p^-1 F^T; then the equivalent plastic strain
/// and the plastic work. An elastic step only reads it.
constexpr int history_fields(LawKind law, int dimension) {
  if (law == LawKind::neo_hookean || law == LawKind::hencky) return 0;
  return dimension == 2 ? 6 : 8;
}

/// kSegment consecutive cells of a row that hold points of one law.
struct Segment {
  std::uint32_t read[4];  ///< index of the first node of rows (y, z), (y+1, z), (y, z+1), (y+1, z+1); 2D: the first two
  std::uint32_t add[4];   ///< the same in the array of sums, in which slabs have copies of the rows they share
  std::uint64_t points;   ///< doubles from `points`; regular: m and V0 per lane; cut: per place xi, eta, zeta, V0, m
  std::uint64_t history;  ///< doubles from `history`: [place][field][lane]
  std::uint16_t law;      ///< index into the laws' parameters
  std::uint16_t places;   ///< points per lane
  CellKind kind;
  bool follows;  ///< rows go on where those of the segment before ended
};

/// Arrays over the nodes, one per axis.
struct NodeArrays {
  double* U[3];
  double* W[3];
  double* A[3];
  double* v[3];    ///< v_I
  double* sum[3];  ///< of what segments add: forces, then momenta
  const double* P0[3];
  const double* per_mass;  ///< 1 / m_I; 0 where there is no mass, or where others than the kernels advance the node
};

/// Parameters of a law, in the order that its kernel knows; see make_parameters in solver/core.
struct LawParameters {
  LawKind kind = LawKind::neo_hookean;
  double value[32] = {};
};

struct StressSweep {
  NodeArrays nodes;
  double per_cell = 0;  ///< 1 / edge, 1/m
  const double* points = nullptr;
  double* history = nullptr;
  const LawParameters* laws = nullptr;
  bool find_speed = true;  ///< whether to look for the largest wave speed
};

/// What a stress sweep of some segments found.
struct StressResult {
  double largest_speed_squared = 0;  ///< of the mean over each cell of c^2
  std::int64_t fastest_segment = 0;  ///< the first that has it
  std::int64_t bad_segment = -1;     ///< the first with a point that has J <= 0 or something not finite
};

/// What a point's place in a segment is found to be, per lane.
struct PointState {
  double displacement[3][kSegment];  ///< x - X, m
  double velocity[3][kSegment];      ///< less a v(0), m/s
  double F[9][kSegment];             ///< with averages F-bar
  double stress[6][kSegment];        ///< Cauchy, Pa
  double b_e[6][kSegment];
};

struct MomentumSweep {
  NodeArrays nodes;
  const double* points = nullptr;
};

/// First half of a step on the nodes: v' = v + dt (f / m + g), damped; W, A; sums back to zero.
struct ForceSweep {
  NodeArrays nodes;
  double gravity[3] = {0, 0, 0};
  double dt = 0;
  double alpha = 1;
  double damping = 0;
};
/// Sums over the nodes of a call.
struct ForceResult {
  double damped = 0;               ///< energy lost to damping, J
  double momentum[3] = {0, 0, 0};  ///< of m (v + v') / 2
};

/// Second half: p = sum + a P0, v = p / m, U; sums back to zero.
struct VelocitySweep {
  NodeArrays nodes;
  double dt = 0;
  double start_share = 0;  ///< a; 0 where no particle had a velocity
};

/// Energies of the points of some segments, J.
struct EnergyResult {
  double strain = 0;
  double plastic = 0;
};

}  // namespace scarp::kernels

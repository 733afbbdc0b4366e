// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/materials/tensor.hpp"

namespace scarp {

/// What a path-dependent law remembers of a particle; the fields of the same names in Particles.
struct PointHistory {
  Sym6 elastic_left_cauchy_green{1, 1, 1, 0, 0, 0};  ///< b_e at F_old on entry, at F on return
  double equivalent_plastic_strain = 0;              ///< sum of sqrt(2/3) |increment of the plastic log strain|
  double plastic_work = 0;                           ///< J/m3 of reference volume, viscous dissipation too
  double hardening = 0;                              ///< of laws that state `has_hardening`; 0 at first
};

/// A step's deformation: from F_old to F, with what is computed once for stress, force and time step.
struct Motion {
  Mat3 F_old;
  Mat3 F;
  Mat3 cofactor;  ///< cof F = J F^-T
  double J;       ///< det F
  double per_J;   ///< 1 / J
  double per_dt;  ///< 1 / time from F_old to F, 1/s; 0: infinitely slow
};

inline Motion make_motion(const Mat3& F_old, const Mat3& F, double per_dt = 0) {
  const Mat3 c = cofactor(F);
  const double J = determinant(F, c);
  return {F_old, F, c, J, 1 / J, per_dt};
}

/// Upper bound of 1 / lambda_min^2, the largest eigenvalue of C^-1: the Laguerre-Samuelson bound from its trace
/// and its second invariant. Exact where the two other stretches are equal (uniaxial strain), within 1 % in
/// simple shear beyond gamma = 1, and free of cubic roots.
inline double inverse_square_of_least_stretch(const Motion& motion) {
  const double per_J2 = motion.per_J * motion.per_J;
  const double trace = square_norm(motion.cofactor) * per_J2;
  const double second = square_norm(motion.F) * per_J2;
  return (trace + 2 * std::sqrt(std::max(0.0, trace * trace - 3 * second))) * (1.0 / 3);
}

}  // namespace scarp

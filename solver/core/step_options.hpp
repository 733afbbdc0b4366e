// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/solver_options.hpp"

namespace scarp {

/// The gravity that holds: as stated, or 9.81 m/s2 along -z (2D: -y).
Vec3 gravity_of(const SolverOptions& options, int dimension);

/// What SolverOptions asks of a step, in every formulation.
class StepOptions {
 public:
  StepOptions(const SolverOptions& options, int dimension);

  /// Gravity in the middle of the step, as it grows over the ramp, smoothly from 0 to all of it: no kink at either end.
  Vec3 gravity_at(double time, double dt) const;
  /// The FLIP share of a step, with what the PIC rate takes in it.
  double flip_share(double dt) const;
  /// From now on gravity is the steady one.
  void end_ramp() { gravity_ramp_ = 0; }

  Vec3 gravity;  ///< the steady one, m/s2
  double courant;
  double damping;

 private:
  double flip_, pic_rate_, gravity_ramp_;
};

}  // namespace scarp

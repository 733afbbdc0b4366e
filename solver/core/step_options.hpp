// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/core/velocity_update.hpp"
#include "solver/model/ground_motion.hpp"
#include "solver/model/solver_options.hpp"

namespace scarp {

/// The gravity that holds: as stated, or 9.81 m/s2 along -z (2D: -y).
Vec3 gravity_of(const SolverOptions& options, int dimension);

/// What SolverOptions asks of a step, in every formulation.
class StepOptions {
 public:
  /// @param shaking  must outlive this object
  StepOptions(const SolverOptions& options, int dimension, const std::vector<GroundMotion>& shaking);

  /// Gravity in the middle of the step, as it grows over the ramp, smoothly from 0 to all of it: no kink at either end;
  /// less the mean acceleration of a rigidly shaken base.
  Vec3 gravity_at(double time, double dt) const;
  /// How much of gravity the ramp lets through in the middle of the step.
  double ramp(double time, double dt) const;
  /// The FLIP share of a step, with what the PIC rate takes in it.
  double flip_share(double dt) const;
  /// Of transfer = "flip": kept and less are the FLIP share. APIC starts from PIC's velocities; XPIC, flip 1, puts v*_I
  /// in the place of the particles' own.
  VelocityUpdate velocity_update(double dt) const;
  /// For a start at rest: nothing shakes until it ends. Then gravity is the steady one.
  void begin_relaxing() { still_ = true; }
  void rest() {
    still_ = false;
    gravity_ramp_ = 0;
  }

  Vec3 gravity;  ///< the steady one, m/s2
  double courant;
  double damping;
  Transfer transfer;
  int xpic_order;

 private:
  const std::vector<GroundMotion>& shaking_;
  bool still_ = false;
  double flip_, pic_rate_, gravity_ramp_;
};

}  // namespace scarp

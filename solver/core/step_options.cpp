// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/step_options.hpp"

#include <cmath>

#include "solver/core/shaking.hpp"

namespace scarp {

Vec3 gravity_of(const SolverOptions& options, int dimension) {
  if (options.gravity) return *options.gravity;
  return dimension == 2 ? Vec3{0, -9.81, 0} : Vec3{0, 0, -9.81};
}

StepOptions::StepOptions(const SolverOptions& options, int dimension, const std::vector<GroundMotion>& shaking)
    : gravity(gravity_of(options, dimension)),
      courant(options.courant),
      damping(options.damping),
      transfer(options.transfer),
      xpic_order(static_cast<int>(options.xpic_order.value_or(2))),
      shaking_(shaking),
      flip_(options.flip),
      pic_rate_(options.pic_rate),
      gravity_ramp_(options.gravity_ramp) {}

Vec3 StepOptions::gravity_at(double time, double dt) const {
  const Vec3 base = still_ ? Vec3{0, 0, 0} : mean_base_acceleration(shaking_, time, dt);
  return ramp(time, dt) * gravity - base;
}

double StepOptions::ramp(double time, double dt) const {
  const double middle = time + 0.5 * dt;
  if (!(middle < gravity_ramp_)) return 1;
  const double s = middle / gravity_ramp_;
  return s * s * (3 - 2 * s);
}

double StepOptions::flip_share(double dt) const { return flip_ * std::exp(-pic_rate_ * dt); }

VelocityUpdate StepOptions::velocity_update(double dt) const {
  if (transfer == Transfer::apic) return {0, 0};
  if (transfer == Transfer::xpic) return {0, 1};
  const double flip = flip_share(dt);
  return {flip, flip};
}

}  // namespace scarp

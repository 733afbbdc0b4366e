// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/granular.hpp"

#include <algorithm>
#include <cmath>

#include "solver/materials/log_strain.hpp"

namespace scarp {

Granular::Law::Law(const Granular& m)
    : G_(m.shear_modulus()),
      K_(m.bulk_modulus()),
      per_density_(1 / m.density),
      mu_s_(m.mu_s),
      mu_2_(m.mu_2),
      rate_(G_ * m.I_0 / (m.grain_diameter * std::sqrt(m.grain_density))) {}

/// sqrt(J2) of the Kirchhoff stress, T, at the end of a step that would have ended at `trial` elastically, for the
/// pressure P = J p: T = mu(I) P with the plastic shear rate (trial - T) / (G dt) is a quadratic equation, of which
/// this is the smaller root, in the form without cancellation, multiplied by 1 / dt so that slow motion (0) is in it.
double Granular::Law::flowing(double trial, double P, const Motion& motion) const {
  const double still = mu_s_ * P, fast = mu_2_ * P;
  if (!(trial > still) || !(P > 0)) return std::min(trial, std::max(0.0, still));
  const double rate = rate_ * std::sqrt(P * motion.per_J);
  const double b = (fast + trial) * motion.per_dt + rate;
  const double c = fast * trial * motion.per_dt + still * rate;
  return 2 * c / (b + std::sqrt(std::max(0.0, b * b - 4 * motion.per_dt * c)));
}

Sym6 Granular::Law::stress(const Motion& motion, PointHistory& history) const {
  Sym6& b_e = history.elastic_left_cauchy_green;
  auto [dev, carried, planes] = deviatoric_trial(motion, b_e);
  const double trace = motion.J < 1 ? std::log(motion.J) : 0;
  const double trial = G_ * std::sqrt(2 * dot(dev, dev));  // sqrt(J2)
  const double T = flowing(trial, -K_ * trace, motion);
  if (T < trial) {
    dev = (T / trial) * dev;
    const double plastic_shear = (trial - T) / G_;
    history.equivalent_plastic_strain += plastic_shear / std::sqrt(3.0);
    history.plastic_work += T * plastic_shear;
  }
  if (T < trial || trace != carried) b_e = left_cauchy_green(dev, trace, planes);
  const double deviatoric = 2 * G_ * motion.per_J, mean = K_ * trace * motion.per_J;
  return compose({deviatoric * dev[0] + mean, deviatoric * dev[1] + mean, deviatoric * dev[2] + mean}, planes);
}

double Granular::Law::stored_energy(const Motion&, const PointHistory& history) const {
  return hencky_energy(G_, K_ - 2 * G_ / 3, history.elastic_left_cauchy_green);
}

double Granular::Law::wave_speed_squared(const Motion& motion, const PointHistory& history) const {
  return hencky_stiffness_bound(K_ + 4 * G_ / 3, motion, history.elastic_left_cauchy_green) * per_density_;
}

double Granular::Law::yield_function(const Sym6& sigma, const PointHistory&) const {
  const double mean = (sigma[0] + sigma[1] + sigma[2]) / 3;
  const double x = sigma[0] - mean, y = sigma[1] - mean, z = sigma[2] - mean;
  const double shear = sigma[3] * sigma[3] + sigma[4] * sigma[4] + sigma[5] * sigma[5];
  return std::max(std::sqrt(0.5 * (x * x + y * y + z * z) + shear) + mu_s_ * mean, mean);
}

}  // namespace scarp

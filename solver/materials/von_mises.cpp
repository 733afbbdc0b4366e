// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/von_mises.hpp"

#include <algorithm>
#include <cmath>

#include "solver/materials/log_strain.hpp"

namespace scarp {

VonMises::Law::Law(const VonMises& m)
    : G_(m.shear_modulus()),
      K_(m.bulk_modulus()),
      per_density_(1 / m.density),
      yield_(m.yield_stress),
      modulus_(m.hardening_modulus),
      saturation_rise_(m.saturation_stress.value_or(m.yield_stress) - m.yield_stress),
      per_saturation_strain_(1 / m.saturation_strain.value_or(1)),
      relaxation_time_(m.relaxation_time) {}

double VonMises::Law::strength(double a) const {
  const double linear = yield_ + modulus_ * a;
  return saturation_rise_ > 0 ? linear - saturation_rise_ * std::expm1(-a * per_saturation_strain_) : linear;
}

/// The root g of trial - 3 G g - J s(a + g) = 0, for trial > J s(a). The left side is convex and falls, so that
/// Newton's steps from below approach without passing; the start is the root for a saturated strength, which is below.
/// Where saturation is far, a step gains at least about one saturation_strain: 37 bring exp() below the last digit.
double VonMises::Law::plastic_increment(double trial, double a, double J) const {
  const double slope = 3 * G_ + J * modulus_;
  if (!(saturation_rise_ > 0)) return (trial - J * strength(a)) / slope;
  double g = std::max(0.0, (trial - J * (yield_ + modulus_ * a + saturation_rise_)) / slope);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double left = trial - 3 * G_ * g - J * strength(a + g);
    const double rate = saturation_rise_ * per_saturation_strain_ * std::exp(-(a + g) * per_saturation_strain_);
    const double next = g + left / (slope + J * rate);
    if (!(next > g)) break;
    g = next;
  }
  return g;
}

Sym6 VonMises::Law::stress(const Motion& motion, PointHistory& history) const {
  Sym6& b_e = history.elastic_left_cauchy_green;
  auto [dev, trace, planes] = deviatoric_trial(motion, b_e);
  const double trial = 2 * G_ * std::sqrt(1.5 * dot(dev, dev));
  if (trial > motion.J * strength(history.equivalent_plastic_strain)) {
    const double g = (1 - overstress_left(relaxation_time_, motion.per_dt)) *
                     plastic_increment(trial, history.equivalent_plastic_strain, motion.J);
    dev = (1 - 3 * G_ * g / trial) * dev;
    b_e = left_cauchy_green(dev, trace, planes);
    history.equivalent_plastic_strain += g;
    history.plastic_work += (trial - 3 * G_ * g) * g;
  }
  const double deviatoric = 2 * G_ * motion.per_J, mean = K_ * trace * motion.per_J;
  return compose({deviatoric * dev[0] + mean, deviatoric * dev[1] + mean, deviatoric * dev[2] + mean}, planes);
}

double VonMises::Law::stored_energy(const Motion&, const PointHistory& history) const {
  return hencky_energy(G_, K_ - 2 * G_ / 3, history.elastic_left_cauchy_green);
}

double VonMises::Law::wave_speed_squared(const Motion& motion, const PointHistory& history) const {
  return hencky_stiffness_bound(K_ + 4 * G_ / 3, motion, history.elastic_left_cauchy_green) * per_density_;
}

double VonMises::Law::yield_function(const Sym6& sigma, const PointHistory& history) const {
  const double mean = (sigma[0] + sigma[1] + sigma[2]) / 3;
  const double x = sigma[0] - mean, y = sigma[1] - mean, z = sigma[2] - mean;
  const double shear = sigma[3] * sigma[3] + sigma[4] * sigma[4] + sigma[5] * sigma[5];
  return std::sqrt(1.5 * (x * x + y * y + z * z + 2 * shear)) - strength(history.equivalent_plastic_strain);
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/drucker_prager.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/materials/log_strain.hpp"

namespace scarp {
namespace {

/// q / sin(angle) of the yield surface; with the sine of dilatancy for the match that depends on it.
double steepness(ConeMatch match, double sine, double sine_of_flow) {
  switch (match) {
    case ConeMatch::plane_strain:
      return std::sqrt(9 + 3 * sine_of_flow * sine_of_flow) / (3 + sine * sine_of_flow);
    case ConeMatch::plane_strain_associated:
      return 3 / std::sqrt(9 + 3 * sine * sine);
    case ConeMatch::inner:
      return 6 / (std::numbers::sqrt3 * (3 + sine));
    case ConeMatch::outer:
      return 6 / (std::numbers::sqrt3 * (3 - sine));
  }
  return 0;
}

}  // namespace

Cone fit_cone(const DruckerPrager& m) {
  constexpr double per_degree = std::numbers::pi / 180;
  const double sin_phi = std::sin(m.friction_angle * per_degree), sin_psi = std::sin(m.dilatancy_angle * per_degree);
  const double yield = steepness(m.match, sin_phi, sin_psi), flow = steepness(m.match, sin_psi, sin_psi);
  return {yield * sin_phi, yield * m.cohesion * std::cos(m.friction_angle * per_degree), flow * sin_psi};
}

DruckerPrager::Law::Law(const DruckerPrager& m)
    : G_(m.shear_modulus()),
      K_(m.bulk_modulus()),
      per_density_(1 / m.density),
      relaxation_time_(m.relaxation_time),
      cone_(fit_cone(m)) {
  per_cone_stiffness_ = 1 / (G_ + K_ * cone_.q * cone_.q_flow);
  const double apex = cone_.q > 0 ? cone_.k / cone_.q : std::numeric_limits<double>::infinity();
  cap_ = std::min(apex, m.tension_strength.value_or(apex));
}

Sym6 DruckerPrager::Law::stress(const Motion& motion, PointHistory& history) const {
  Sym6& b_e = history.elastic_left_cauchy_green;
  auto [dev, trace, planes] = deviatoric_trial(motion, b_e);
  const double trial = G_ * std::sqrt(2 * dot(dev, dev));  // sqrt(J2)
  double p = K_ * trace;
  const double k = cone_.k * motion.J, cap = cap_ * motion.J;
  const double f = trial + cone_.q * p - k;
  if (f > 0 || p > cap) {
    double radius = trial;
    const double trial_p = p, left = overstress_left(relaxation_time_, motion.per_dt);
    const double gamma = std::max(0.0, f * per_cone_stiffness_);
    if (p - K_ * cone_.q_flow * gamma <= cap) {
      radius -= G_ * gamma;
      p -= K_ * cone_.q_flow * gamma;
    } else {
      p = cap;
      radius = std::min(trial, std::max(0.0, k - cone_.q * cap));
    }
    radius += left * (trial - radius);
    p += left * (trial_p - p);
    dev = (trial > 0 ? radius / trial : 0.0) * dev;
    const double plastic_volume = trace - p / K_, plastic_shear = (trial - radius) / G_;
    b_e = left_cauchy_green(dev, trace - plastic_volume, planes);
    // |plastic strain|^2 = plastic_shear^2 / 2 + plastic_volume^2 / 3
    history.equivalent_plastic_strain +=
        std::sqrt(plastic_shear * plastic_shear / 3 + 2.0 / 9 * plastic_volume * plastic_volume);
    history.plastic_work += radius * plastic_shear + p * plastic_volume;
  }
  const double deviatoric = 2 * G_ * motion.per_J, mean = p * motion.per_J;
  return compose({deviatoric * dev[0] + mean, deviatoric * dev[1] + mean, deviatoric * dev[2] + mean}, planes);
}

double DruckerPrager::Law::stored_energy(const Motion&, const PointHistory& history) const {
  return hencky_energy(G_, K_ - 2 * G_ / 3, history.elastic_left_cauchy_green);
}

double DruckerPrager::Law::wave_speed_squared(const Motion& motion, const PointHistory& history) const {
  return hencky_stiffness_bound(K_ + 4 * G_ / 3, motion, history.elastic_left_cauchy_green) * per_density_;
}

double DruckerPrager::Law::yield_function(const Sym6& sigma, const PointHistory&) const {
  const double p = (sigma[0] + sigma[1] + sigma[2]) / 3;
  const double x = sigma[0] - p, y = sigma[1] - p, z = sigma[2] - p;
  const double shear = sigma[3] * sigma[3] + sigma[4] * sigma[4] + sigma[5] * sigma[5];
  const double f = std::sqrt(0.5 * (x * x + y * y + z * z) + shear) + cone_.q * p - cone_.k;
  return std::max(f, p - cap_);
}

}  // namespace scarp

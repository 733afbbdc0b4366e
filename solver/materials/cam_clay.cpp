// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/cam_clay.hpp"

#include <algorithm>
#include <numbers>

#include "solver/materials/log_strain.hpp"

namespace scarp {
namespace {

/// (exp(y) - 1) / y.
double expm1_over(double y) { return y == 0 ? 1 : std::expm1(y) / y; }

/// The return from a trial state to the ellipse, along the ellipse's normal. With the compressive plastic volumetric
/// strain x, the pressure P = P_tr exp(-x / kappa*) and J p_c = C exp(x / (lambda* - kappa*)) move towards each other
/// until P = J p_c / 2 at x = x_crit, where the flow keeps the volume. The solution lies between the trial state and
/// that, on whichever side: with x = t x_crit the yield function is above 0 at t = 0 and below at t = 1, where the
/// multiplier is infinite and q gone. One unknown in a bracket: no trial state is without a solution, none out of
/// reach.
struct Ellipse {
  double per_swelling, per_hardening, per_M_squared, G;
  double critical_strain = 0;    ///< x_crit
  double critical_pressure = 0;  ///< P at x_crit
  double trial_q = 0;

  struct State {
    double pressure = 0, q = 0;
    double f = 0;      ///< q^2 / M^2 + P (P - J p_c), per critical_pressure^2
    double scale = 1;  ///< of the largest term in f
  };

  /// d f / d p = 2 P - J p_c is critical_pressure (x_crit - x) `rate`, exactly, also where it vanishes.
  State at(double t) const {
    const double left = (1 - t) * critical_strain;
    const double rate =
        2 * (per_swelling * expm1_over(left * per_swelling) + per_hardening * expm1_over(-left * per_hardening));
    const double multiplier = t / ((1 - t) * critical_pressure * rate);
    State s;
    const double up = std::exp(left * per_swelling), down = std::exp(-left * per_hardening);
    s.pressure = critical_pressure * up;
    s.q = t < 1 ? trial_q / (1 + 6 * G * per_M_squared * multiplier) : 0;
    const double ratio = s.q / critical_pressure;
    s.f = ratio * ratio * per_M_squared + up * (up - 2 * down);
    s.scale = ratio * ratio * per_M_squared + up * up;
    return s;
  }

  /// The root t: secants that halve the older end's weight (the Illinois method), every third step a bisection.
  double root(double f_trial) const {
    double low = 0, high = 1, f_low = f_trial, f_high = at(1).f;
    for (int step = 1; step < 200; ++step) {
      const double secant = (low * f_high - high * f_low) / (f_high - f_low);
      const double t = step % 3 == 0 || !(secant > low && secant < high) ? 0.5 * (low + high) : secant;
      if (!(t > low && t < high)) break;
      const State s = at(t);
      if (std::abs(s.f) <= 1e-15 * s.scale) return t;
      (s.f > 0 ? low : high) = t;
      (s.f > 0 ? f_low : f_high) = s.f;
      (s.f > 0 ? f_high : f_low) *= 0.5;
    }
    return high;
  }
};

}  // namespace

double CamClay::M() const {
  if (critical_stress_ratio) return *critical_stress_ratio;
  const double sine = std::sin(friction_angle.value_or(0) * std::numbers::pi / 180);
  return 6 * sine / (3 - sine);
}

CamClay::Law::Law(const CamClay& m)
    : G_(m.shear_modulus),
      per_density_(1 / m.density),
      pressure_(m.initial_pressure),
      yield_pressure_(m.first_yield_pressure()),
      per_M_squared_(1 / (m.M() * m.M())),
      per_swelling_(1 / m.swelling()),
      per_hardening_(1 / m.hardening()) {}

Sym6 CamClay::Law::stress(const Motion& motion, PointHistory& history) const {
  Sym6& b_e = history.elastic_left_cauchy_green;
  auto [dev, trace, planes] = deviatoric_trial(motion, b_e);
  Ellipse ellipse{per_swelling_, per_hardening_, per_M_squared_, G_};
  ellipse.trial_q = G_ * std::sqrt(6 * dot(dev, dev));
  // In logarithms, so that no trial state overflows.
  const double above =
      std::log(2 * pressure_ / (motion.J * yield_pressure_)) - trace * per_swelling_ - history.hardening;
  ellipse.critical_strain = above / (per_swelling_ + per_hardening_);
  ellipse.critical_pressure = pressure_ * std::exp(-(trace + ellipse.critical_strain) * per_swelling_);
  double P = pressure_ * std::exp(-trace * per_swelling_);
  const Ellipse::State trial = ellipse.at(0);
  if (trial.f > 1e-14 * trial.scale) {
    const double t = ellipse.root(trial.f);
    const Ellipse::State end = ellipse.at(t);
    const double plastic_volume = t * ellipse.critical_strain, plastic_shear = (ellipse.trial_q - end.q) / (3 * G_);
    dev = (ellipse.trial_q > 0 ? end.q / ellipse.trial_q : 0.0) * dev;
    trace += plastic_volume;
    b_e = left_cauchy_green(dev, trace, planes);
    P = end.pressure;
    history.hardening += plastic_volume * per_hardening_;
    // |plastic strain|^2 = 3/2 plastic_shear^2 + plastic_volume^2 / 3
    history.equivalent_plastic_strain +=
        std::sqrt(plastic_shear * plastic_shear + 2.0 / 9 * plastic_volume * plastic_volume);
    history.plastic_work += end.q * plastic_shear + P * plastic_volume;
  }
  const double deviatoric = 2 * G_ * motion.per_J, mean = -P * motion.per_J;
  return compose({deviatoric * dev[0] + mean, deviatoric * dev[1] + mean, deviatoric * dev[2] + mean}, planes);
}

double CamClay::Law::stored_energy(const Motion&, const PointHistory& history) const {
  const Vec3 squares = symmetric_eigen(history.elastic_left_cauchy_green).values;
  const Vec3 e{0.5 * std::log(squares[0]), 0.5 * std::log(squares[1]), 0.5 * std::log(squares[2])};
  const double trace = e[0] + e[1] + e[2];
  const double square = dot(e, e) - trace * trace / 3;
  return pressure_ / per_swelling_ * std::expm1(-trace * per_swelling_) + G_ * square;
}

/// As hencky_stiffness_bound, with the bulk modulus P / kappa* at the pressure P of b_e, and P itself, by which
/// pressure stiffens a compression wave.
double CamClay::Law::wave_speed_squared(const Motion& motion, const PointHistory& history) const {
  const Sym6& b = history.elastic_left_cauchy_green;
  const double determinant =
      b[0] * (b[1] * b[2] - b[4] * b[4]) - b[3] * (b[3] * b[2] - b[4] * b[5]) + b[5] * (b[3] * b[4] - b[1] * b[5]);
  const double P = pressure_ * std::pow(determinant, -0.5 * per_swelling_);
  return hencky_stiffness_bound(P * (per_swelling_ + 1) + 4 * G_ / 3, motion, b) * per_density_;
}

double CamClay::Law::yield_function(const Sym6& sigma, const PointHistory& history) const {
  const double p = -(sigma[0] + sigma[1] + sigma[2]) / 3, p_c = yield_pressure_ * std::exp(history.hardening);
  const double x = sigma[0] + p, y = sigma[1] + p, z = sigma[2] + p;
  const double shear = sigma[3] * sigma[3] + sigma[4] * sigma[4] + sigma[5] * sigma[5];
  return 1.5 * (x * x + y * y + z * z + 2 * shear) * per_M_squared_ / p_c + p * (p / p_c - 1);
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/mohr_coulomb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "solver/materials/log_strain.hpp"

namespace scarp {
namespace {

/// Places of the largest, the middle and the least value: the out-of-plane direction takes part like any other.
std::array<int, 3> descending(const Vec3& v) {
  std::array<int, 3> order{0, 1, 2};
  if (v[order[0]] < v[order[1]]) std::swap(order[0], order[1]);
  if (v[order[1]] < v[order[2]]) std::swap(order[1], order[2]);
  if (v[order[0]] < v[order[1]]) std::swap(order[0], order[1]);
  return order;
}

/// The cut-off, or infinity; no more than the apex.
double tension_of(const MohrCoulomb& m, double cohesion, double friction_angle) {
  if (!m.tension_strength) return std::numeric_limits<double>::infinity();
  if (friction_angle == 0) return *m.tension_strength;
  return std::min(*m.tension_strength, cohesion / std::tan(friction_angle * std::numbers::pi / 180));
}

/// The root of g - strain(g), with strain >= 0 bounded and continuous: a bracket, then secants that halve the older
/// end's weight (the Illinois method), with a bisection in every third step for strain that changes abruptly. The last
/// call of `strain` is the one for the root.
template <class F>
void solve_increment(const F& strain, double tolerance) {
  double low = 0, high = strain(0.0), f_low = -high, f_high = high - strain(high);
  while (f_high < -tolerance) {
    low = high;
    f_low = f_high;
    high *= 2;
    f_high = high - strain(high);
  }
  if (f_high <= tolerance) return;
  for (int step = 1; high - low > tolerance; ++step) {
    const double secant = (low * f_high - high * f_low) / (f_high - f_low);
    const double g = step % 3 == 0 || !(secant > low && secant < high) ? 0.5 * (low + high) : secant;
    if (!(g > low && g < high)) return;
    const double f = g - strain(g);
    if (std::abs(f) <= tolerance) return;
    (f < 0 ? low : high) = g;
    (f < 0 ? f_low : f_high) = f;
    (f < 0 ? f_high : f_low) *= 0.5;
  }
}

}  // namespace

MohrCoulomb::Law::Law(const MohrCoulomb& m, double cell)
    : G_(m.shear_modulus()),
      K_(m.bulk_modulus()),
      per_2G_(1 / (2 * G_)),
      per_3K_(1 / (3 * K_)),
      per_density_(1 / m.density),
      surface_(G_, K_, m.cohesion, m.friction_angle, m.dilatancy_angle, tension_of(m, m.cohesion, m.friction_angle)),
      softens_(m.softens()),
      parameters_(m) {
  if (!softens_) return;
  const double scale = m.softening_length && cell > 0 ? *m.softening_length / cell : 1;
  per_softening_strain_ = 1 / (m.softening_strain.value_or(0) * scale);
}

CoulombSurface MohrCoulomb::Law::surface_after(double equivalent_plastic_strain) const {
  const MohrCoulomb& m = parameters_;
  const double way = equivalent_plastic_strain * per_softening_strain_;
  const double gone = m.softening == Softening::linear ? std::min(1.0, way) : -std::expm1(-way);
  const auto now = [gone](double peak, const std::optional<double>& residual) {
    return residual ? peak + gone * (*residual - peak) : peak;
  };
  const double cohesion = now(m.cohesion, m.residual_cohesion);
  if (!m.residual_friction_angle && !m.residual_dilatancy_angle)
    return surface_.with_strength(cohesion, tension_of(m, cohesion, m.friction_angle));
  const double phi = now(m.friction_angle, m.residual_friction_angle);
  const double psi = now(m.dilatancy_angle, m.residual_dilatancy_angle);
  return CoulombSurface(G_, K_, cohesion, phi, psi, tension_of(m, cohesion, phi));
}

/// sqrt(2/3) |plastic log strain| between a trial stress and the one it returned to.
double MohrCoulomb::Law::plastic_strain(const Vec3& trial, const Vec3& tau) const {
  const Vec3 fall = trial - tau;
  const double mean = (fall[0] + fall[1] + fall[2]) / 3;
  double square = 0;
  for (double d : fall) {
    const double plastic = (d - mean) * per_2G_ + mean * per_3K_;
    square += plastic * plastic;
  }
  return std::sqrt(2.0 / 3.0 * square);
}

/// @return whether the step is plastic
bool MohrCoulomb::Law::return_softening(Vec3& tau, double J, double before) const {
  const Vec3 trial = tau;
  const auto strain = [&](double increment) {
    tau = trial;
    const CoulombSurface surface = surface_after(before + increment);
    if (surface.exceeded(tau, J)) surface.return_map(tau, J);
    return plastic_strain(trial, tau);
  };
  if (!surface_after(before).exceeded(trial, J)) return false;
  solve_increment(strain, 1e-15 * (1 + before));
  return true;
}

Sym6 MohrCoulomb::Law::stress(const Motion& motion, PointHistory& history) const {
  Sym6& b_e = history.elastic_left_cauchy_green;
  b_e = elastic_trial(motion, b_e);
  LogStrain strain = log_strain(b_e);
  const std::array<int, 3> order = descending(strain.squares);
  Vec3 e;
  for (int k = 0; k < 3; ++k) e[k] = strain.principal[order[k]];
  const double pressure = (K_ - 2 * G_ / 3) * (e[0] + e[1] + e[2]);
  Vec3 tau{2 * G_ * e[0] + pressure, 2 * G_ * e[1] + pressure, 2 * G_ * e[2] + pressure};
  const Vec3 trial = tau;
  bool plastic = false;
  if (softens_) {
    plastic = return_softening(tau, motion.J, history.equivalent_plastic_strain);
  } else if (surface_.exceeded(tau, motion.J)) {
    surface_.return_map(tau, motion.J);
    plastic = true;
  }
  if (plastic) {
    if (parameters_.relaxation_time > 0)
      tau = tau + overstress_left(parameters_.relaxation_time, motion.per_dt) * (trial - tau);
    const double mean = (tau[0] + tau[1] + tau[2]) / 3;
    double square = 0, work = 0;
    for (int k = 0; k < 3; ++k) {
      const double elastic = (tau[k] - mean) * per_2G_ + mean * per_3K_;
      const double difference = e[k] - elastic;
      square += difference * difference;
      work += tau[k] * difference;
      strain.squares[order[k]] = std::exp(2 * elastic);
    }
    b_e = compose(strain.squares, strain.planes);
    history.equivalent_plastic_strain += std::sqrt(2.0 / 3.0 * square);
    history.plastic_work += work;
  }
  Vec3 sigma;
  for (int k = 0; k < 3; ++k) sigma[order[k]] = tau[k] * motion.per_J;
  return compose(sigma, strain.planes);
}

double MohrCoulomb::Law::stored_energy(const Motion&, const PointHistory& history) const {
  return hencky_energy(G_, K_ - 2 * G_ / 3, history.elastic_left_cauchy_green);
}

double MohrCoulomb::Law::wave_speed_squared(const Motion& motion, const PointHistory& history) const {
  return hencky_stiffness_bound(K_ + 4 * G_ / 3, motion, history.elastic_left_cauchy_green) * per_density_;
}

double MohrCoulomb::Law::yield_function(const Sym6& sigma, const PointHistory& history) const {
  Vec3 s = symmetric_eigen(sigma).values;
  std::sort(s.begin(), s.end(), std::greater<>());
  const CoulombSurface surface = softens_ ? surface_after(history.equivalent_plastic_strain) : surface_;
  return std::max(surface.yield(s, 1), surface.above_cut_off(s, 1));
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/mohr_coulomb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "solver/materials/symmetric_eigen.hpp"

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

/// n_k n_k^T for the eigenvectors n_k.
std::array<Sym6, 3> projections(const Mat3& n) {
  std::array<Sym6, 3> E;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const double x = n[k], y = n[3 + k], z = n[6 + k];
    E[k] = {x * x, y * y, z * z, x * y, y * z, x * z};
  }
  return E;
}

/// sum of values[k] E[k].
Sym6 compose(const Vec3& values, const std::array<Sym6, 3>& E) {
  Sym6 A;
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) A[i] = values[0] * E[0][i] + values[1] * E[1][i] + values[2] * E[2][i];
  return A;
}

/// b_e carried along elastically from F_old to F.
Sym6 elastic_trial(const Motion& motion, const Sym6& b_e) {
  const Mat3 c = cofactor(motion.F_old);
  const double per_J = 1 / determinant(motion.F_old, c);
  Mat3 f = multiply_transposed(motion.F, c);
  for (double& entry : f) entry *= per_J;
  return push_forward(f, b_e);
}

double yield(const Vec3& s, double sin_phi, double cohesion_cos_phi) {
  return (s[0] - s[2]) + (s[0] + s[2]) * sin_phi - 2 * cohesion_cos_phi;
}

}  // namespace

MohrCoulomb::Law::Law(const MohrCoulomb& m)
    : G_(m.shear_modulus()), K_(m.bulk_modulus()), per_density_(1 / m.density), cohesion_(m.cohesion) {
  per_2G_ = 1 / (2 * G_);
  per_3K_ = 1 / (3 * K_);
  constexpr double per_degree = std::numbers::pi / 180;
  sin_phi_ = std::sin(m.friction_angle * per_degree);
  cos_phi_ = std::cos(m.friction_angle * per_degree);
  sin_psi_ = std::sin(m.dilatancy_angle * per_degree);
  fall_ = 2 * G_ * (1 + sin_psi_ / 3) + 2 * K_ * sin_psi_;
  middle_ = (4 * G_ / 3 - 2 * K_) * sin_psi_;
  rise_ = 2 * G_ * (1 - sin_psi_ / 3) - 2 * K_ * sin_psi_;
  const double product = sin_phi_ * sin_psi_, volumetric = 4 * K_ * product;
  a_ = 4 * G_ * (1 + product / 3) + volumetric;
  b_right_ = 2 * G_ * (1 + sin_phi_ + sin_psi_ - product / 3) + volumetric;
  b_left_ = 2 * G_ * (1 - sin_phi_ - sin_psi_ - product / 3) + volumetric;
}

void MohrCoulomb::Law::return_map(Vec3& tau, double cohesion) const {
  const double c_cos = cohesion * cos_phi_;
  const double f = yield(tau, sin_phi_, c_cos);
  const double gamma = f / a_;
  const Vec3 main{tau[0] - fall_ * gamma, tau[1] + middle_ * gamma, tau[2] + rise_ * gamma};
  if (main[0] >= main[1] && main[1] >= main[2]) {
    tau = main;
    return;
  }
  // The plane of the hydrostatic axis and the main plane's direction of return separates the two edges.
  const bool right = (1 - sin_psi_) * tau[0] - 2 * tau[1] + (1 + sin_psi_) * tau[2] > 0;
  const double b = right ? b_right_ : b_left_;
  const double other =
      right ? yield({tau[0], 0, tau[1]}, sin_phi_, c_cos) : yield({tau[1], 0, tau[2]}, sin_phi_, c_cos);
  const double per_determinant = 1 / (a_ * a_ - b * b);
  const double ga = (a_ * f - b * other) * per_determinant, gb = (a_ * other - b * f) * per_determinant;
  if (right)
    tau = {tau[0] - fall_ * (ga + gb), tau[1] + middle_ * ga + rise_ * gb, tau[2] + rise_ * ga + middle_ * gb};
  else
    tau = {tau[0] - fall_ * ga + middle_ * gb, tau[1] + middle_ * ga - fall_ * gb, tau[2] + rise_ * (ga + gb)};
  if (sin_phi_ > 0 && tau[0] + tau[1] + tau[2] > 3 * c_cos / sin_phi_) tau.fill(c_cos / sin_phi_);
}

Sym6 MohrCoulomb::Law::stress(const Motion& motion, PointHistory& history) const {
  Sym6& b_e = history.elastic_left_cauchy_green;
  b_e = elastic_trial(motion, b_e);
  SymmetricEigen b = symmetric_eigen(b_e);
  const std::array<int, 3> order = descending(b.values);
  const std::array<Sym6, 3> E = projections(b.vectors);
  Vec3 e;
  for (int k = 0; k < 3; ++k) e[k] = 0.5 * std::log(b.values[order[k]]);
  const double pressure = (K_ - 2 * G_ / 3) * (e[0] + e[1] + e[2]);
  Vec3 tau{2 * G_ * e[0] + pressure, 2 * G_ * e[1] + pressure, 2 * G_ * e[2] + pressure};
  const double cohesion = cohesion_ * motion.J;
  if (yield(tau, sin_phi_, cohesion * cos_phi_) > 0) {
    return_map(tau, cohesion);
    const double mean = (tau[0] + tau[1] + tau[2]) / 3;
    double square = 0, work = 0;
    for (int k = 0; k < 3; ++k) {
      const double elastic = (tau[k] - mean) * per_2G_ + mean * per_3K_;
      const double plastic = e[k] - elastic;
      square += plastic * plastic;
      work += tau[k] * plastic;
      b.values[order[k]] = std::exp(2 * elastic);
    }
    b_e = compose(b.values, E);
    history.equivalent_plastic_strain += std::sqrt(2.0 / 3.0 * square);
    history.plastic_work += work;
  }
  Vec3 sigma;
  for (int k = 0; k < 3; ++k) sigma[order[k]] = tau[k] * motion.per_J;
  return compose(sigma, E);
}

double MohrCoulomb::Law::stored_energy(const Motion&, const PointHistory& history) const {
  const Vec3 b = symmetric_eigen(history.elastic_left_cauchy_green).values;
  const Vec3 e{0.5 * std::log(b[0]), 0.5 * std::log(b[1]), 0.5 * std::log(b[2])};
  const double trace = e[0] + e[1] + e[2];
  return G_ * dot(e, e) + 0.5 * (K_ - 2 * G_ / 3) * trace * trace;
}

double MohrCoulomb::Law::wave_speed_squared(const Motion& motion, const PointHistory& history) const {
  const Sym6& b = history.elastic_left_cauchy_green;
  const double x = b[0] - 1, y = b[1] - 1, z = b[2] - 1;
  const double strain = std::sqrt(x * x + y * y + z * z + 2 * (b[3] * b[3] + b[4] * b[4] + b[5] * b[5]));
  return (K_ + 4 * G_ / 3) * (1 + strain) * inverse_square_of_least_stretch(motion) * per_density_;
}

double MohrCoulomb::Law::yield_function(const Sym6& sigma) const {
  Vec3 s = symmetric_eigen(sigma).values;
  std::sort(s.begin(), s.end(), std::greater<>());
  return yield(s, sin_phi_, cohesion_ * cos_phi_);
}

}  // namespace scarp

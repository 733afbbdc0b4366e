// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/materials/elastic_parameters.hpp"
#include "solver/materials/log_strain.hpp"

namespace scarp {

/// Hencky's hyperelastic solid (Hencky 1928; Anand 1979): Hooke's law in the logarithmic strain e = ln(F F^T) / 2,
/// W = mu |e|^2 + lambda/2 (tr e)^2. Tension and compression to the reciprocal stretch mirror each other.
struct Hencky : ElasticParameters {
  static constexpr std::string_view name = "hencky";

  template <class V>
  void describe(V&& v) {
    describe_elastic(v);
  }
  class Law;
};

class Hencky::Law {
 public:
  static constexpr bool has_history = false;

  explicit Law(const Hencky& m) : mu_(m.shear_modulus()), lambda_(m.lambda()), per_density_(1 / m.density) {}

  /// sigma = (2 mu e + lambda tr(e) I) / J.
  Sym6 stress(const Motion& motion, PointHistory&) const {
    const LogStrain strain = log_strain(left_product(motion.F));
    const Vec3& e = strain.principal;
    const double isotropic = lambda_ * motion.per_J * (e[0] + e[1] + e[2]);
    const double twice_mu = 2 * mu_ * motion.per_J;
    return compose({twice_mu * e[0] + isotropic, twice_mu * e[1] + isotropic, twice_mu * e[2] + isotropic},
                   strain.planes);
  }

  double stored_energy(const Motion& motion, const PointHistory&) const {
    return hencky_energy(mu_, lambda_, left_product(motion.F));
  }

  /// For the increment m x N and n = F^-T N, |n|^2 <= 1 / lambda_min^2, in the principal axes of b:
  ///   sum over pairs of 2 mu (m_i N_j)^2 / lambda_min^2  +  lambda (m.n)^2  -  (m.n) (m.tau n)  is an upper bound,
  /// since ln(r) (r + 1) / (r (r - 1)) <= 2 for ratios r >= 1 of stretches. The pairs sum up to 2 mu / lambda_min^2;
  /// the last term is at most (|tau n| |n| - n.tau n) / 2 <= (max |tau| - min tau) / (2 lambda_min^2), in which max |e|
  /// - min e <= ln max(1 / lambda_min^2, lambda_max / lambda_min), and ln J is held between 1 - 1/J and J - 1.
  double wave_speed_squared(const Motion& motion, const PointHistory&) const {
    const double shrunk = inverse_square_of_least_stretch(motion);
    const double stretched = square_norm(motion.F) - 2 / shrunk;  // >= lambda_max^2
    const double spread = 0.5 * std::log(shrunk * std::max(shrunk, stretched));
    const double pressed = std::max(0.0, lambda_ > 0 ? lambda_ * (motion.per_J - 1) : lambda_ * (1 - motion.J));
    return (mu_ * (2 + spread) + std::max(0.0, lambda_) + pressed) * shrunk * per_density_;
  }

 private:
  double mu_, lambda_, per_density_;
};

}  // namespace scarp

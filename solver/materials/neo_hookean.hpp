// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/materials/elastic_parameters.hpp"
#include "solver/materials/motion.hpp"

namespace scarp {

/// Compressible neo-Hookean solid after Simo and Pister (1984):
/// W = mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2.
struct NeoHookean : ElasticParameters {
  static constexpr std::string_view name = "neo-hookean";

  template <class V>
  void describe(V&& v) {
    describe_elastic(v);
  }
  class Law;
};

class NeoHookean::Law {
 public:
  static constexpr bool has_history = false;

  explicit Law(const NeoHookean& m) : mu_(m.shear_modulus()), lambda_(m.lambda()), per_density_(1 / m.density) {}

  /// sigma = [mu (b - I) + lambda ln J I] / J.
  Sym6 stress(const Motion& motion, PointHistory&) const {
    const double mu_per_J = mu_ * motion.per_J;
    const double isotropic = lambda_ * std::log(motion.J) * motion.per_J - mu_per_J;
    const Sym6 b = left_product(motion.F);
    return {mu_per_J * b[0] + isotropic,
            mu_per_J * b[1] + isotropic,
            mu_per_J * b[2] + isotropic,
            mu_per_J * b[3],
            mu_per_J * b[4],
            mu_per_J * b[5]};
  }

  double stored_energy(const Motion& motion, const PointHistory&) const {
    const double log_J = std::log(motion.J);
    return 0.5 * mu_ * (square_norm(motion.F) - 3 - 2 * log_J) + 0.5 * lambda_ * log_J * log_J;
  }

  /// The acoustic tensor is mu I + (mu + lambda (1 - ln J)) n x n with n = F^-T N, |n| <= 1/lambda_min. ln J is
  /// replaced by a bound that costs no logarithm: 1 - 1/J <= ln J < 1 + J.
  double wave_speed_squared(const Motion& motion, const PointHistory&) const {
    const double along = mu_ + (lambda_ > 0 ? lambda_ * motion.per_J : -lambda_ * motion.J);
    return (mu_ + along * inverse_square_of_least_stretch(motion)) * per_density_;
  }

 private:
  double mu_, lambda_, per_density_;
};

}  // namespace scarp

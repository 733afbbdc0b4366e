// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/materials/elastic_parameters.hpp"
#include "solver/materials/motion.hpp"

namespace scarp {

/// Hooke's law in the Biot strain U - I, exact under any rotation: W = mu |U - I|^2 + lambda/2 tr(U - I)^2,
/// P = R (2 mu (U - I) + lambda tr(U - I) I), with F = R U.
struct LinearElastic : ElasticParameters {
  static constexpr std::string_view name = "linear-elastic";

  template <class V>
  void describe(V&& v) {
    describe_elastic(v);
  }
  class Law;
};

class LinearElastic::Law {
 public:
  static constexpr bool has_history = false;

  explicit Law(const LinearElastic& m) : mu_(m.shear_modulus()), lambda_(m.lambda()), per_density_(1 / m.density) {}

  /// sigma = P F^T / J = [2 mu (V^2 - V) + lambda tr(V - I) V] / J, with F = V R.
  Sym6 stress(const Motion& motion, PointHistory&) const {
    const Sym6 V = left_stretch(motion.F);
    const Sym6 V2 = left_product(motion.F);
    const double square = 2 * mu_ * motion.per_J;
    const double linear = (lambda_ * (V[0] + V[1] + V[2] - 3) - 2 * mu_) * motion.per_J;
    Sym6 sigma;
    for (int i = 0; i < 6; ++i) sigma[i] = square * V2[i] + linear * V[i];
    return sigma;
  }

  double stored_energy(const Motion& motion, const PointHistory&) const {
    const Sym6 V = left_stretch(motion.F);
    const double x = V[0] - 1, y = V[1] - 1, z = V[2] - 1;
    const double square = x * x + y * y + z * z + 2 * (V[3] * V[3] + V[4] * V[4] + V[5] * V[5]);
    return mu_ * square + 0.5 * lambda_ * (x + y + z) * (x + y + z);
  }

  /// For a rank-one increment m x N turned by R: 2 mu + lambda (m.N)^2 + (lambda tr(U - I) - 2 mu) |m x N|^2 / s,
  /// with s at least the sum of the two least stretches, and (m.N)^2 + |m x N|^2 = 1. The last term rules only
  /// where a stretch exceeds 3 + 2 mu / lambda.
  double wave_speed_squared(const Motion& motion, const PointHistory&) const {
    double along = std::max(0.0, lambda_);
    const double size = std::sqrt(square_norm(motion.F));
    const double turning = lambda_ * (std::sqrt(3.0) * size - 3) - 2 * mu_;
    if (lambda_ * (size - 3) > 2 * mu_)
      along = std::max(along, turning * 0.5 * std::sqrt(inverse_square_of_least_stretch(motion)));
    return (2 * mu_ + along) * per_density_;
  }

 private:
  static Sym6 left_stretch(const Mat3& F) {
    const Mat3 V = multiply_transposed(F, polar_rotation(F));
    return {V[0], V[4], V[8], 0.5 * (V[1] + V[3]), 0.5 * (V[5] + V[7]), 0.5 * (V[2] + V[6])};
  }

  double mu_, lambda_, per_density_;
};

}  // namespace scarp

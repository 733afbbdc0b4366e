// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hencky elasticity, W = mu |e|^2 + lambda/2 (tr e)^2 in the logarithmic strain e = ln(b) / 2, and what a return map on
// b_e needs beside (de Souza Neto, Peric, Owen 2008, chapter 14). The Kirchhoff stress tau = J sigma = 2 mu e +
// lambda tr(e) I has the principal axes of b.
#pragma once

#include <array>
#include <cmath>

#include "solver/materials/motion.hpp"
#include "solver/materials/symmetric_eigen.hpp"

namespace scarp {

/// A symmetric positive tensor b = sum of squares[k] n_k n_k^T, and its logarithmic strain; in no order.
struct LogStrain {
  Vec3 squares;                ///< squares of the principal stretches
  Vec3 principal;              ///< principal values of ln(b) / 2
  std::array<Sym6, 3> planes;  ///< n_k n_k^T
};

inline LogStrain log_strain(const Sym6& b) {
  const SymmetricEigen eigen = symmetric_eigen(b);
  LogStrain strain;
  strain.squares = eigen.values;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const double x = eigen.vectors[k], y = eigen.vectors[3 + k], z = eigen.vectors[6 + k];
    strain.planes[k] = {x * x, y * y, z * z, x * y, y * z, x * z};
    strain.principal[k] = 0.5 * std::log(eigen.values[k]);
  }
  return strain;
}

/// sum of values[k] planes[k].
inline Sym6 compose(const Vec3& values, const std::array<Sym6, 3>& planes) {
  Sym6 A;
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) A[i] = values[0] * planes[0][i] + values[1] * planes[1][i] + values[2] * planes[2][i];
  return A;
}

/// b_e carried along elastically from F_old to F. As a call of its own it would cost each stress update 6 %.
[[gnu::always_inline]] inline Sym6 elastic_trial(const Motion& motion, const Sym6& b_e) {
  const Mat3 c = cofactor(motion.F_old);
  const double per_J = 1 / determinant(motion.F_old, c);
  Mat3 f = multiply_transposed(motion.F, c);
  for (double& entry : f) entry *= per_J;
  return push_forward(f, b_e);
}

/// The elastic trial in logarithmic strain, split as laws of J2 and pressure want it: e = dev + trace / 3.
struct DeviatoricTrial {
  Vec3 dev;                    ///< principal values of the deviator
  double trace;                ///< volumetric strain
  std::array<Sym6, 3> planes;  ///< n_k n_k^T
};

/// Carries b_e along elastically and splits its logarithmic strain.
[[gnu::always_inline]] inline DeviatoricTrial deviatoric_trial(const Motion& motion, Sym6& b_e) {
  b_e = elastic_trial(motion, b_e);
  const LogStrain strain = log_strain(b_e);
  const Vec3& e = strain.principal;
  const double trace = e[0] + e[1] + e[2];
  return {{e[0] - trace / 3, e[1] - trace / 3, e[2] - trace / 3}, trace, strain.planes};
}

/// b of the logarithmic strain dev + volumetric / 3.
inline Sym6 left_cauchy_green(const Vec3& dev, double volumetric, const std::array<Sym6, 3>& planes) {
  Vec3 squares;
  for (int k = 0; k < 3; ++k) squares[k] = std::exp(2 * (dev[k] + volumetric / 3));
  return compose(squares, planes);
}

/// G |e|^2 + lambda/2 (tr e)^2 of the logarithmic strain of b, J/m3 of reference volume.
inline double hencky_energy(double shear_modulus, double lambda, const Sym6& b) {
  const Vec3 squares = symmetric_eigen(b).values;
  const Vec3 e{0.5 * std::log(squares[0]), 0.5 * std::log(squares[1]), 0.5 * std::log(squares[2])};
  const double trace = e[0] + e[1] + e[2];
  return shear_modulus * dot(e, e) + 0.5 * lambda * trace * trace;
}

/// The bound of the wave speed for laws of small elastic strain, (lambda + 2 mu) / lambda_min^2 in units of
/// `stiffness` = lambda + 2 mu, raised by the elastic strain: the Hencky tangent departs from Hooke's by stresses, and
/// stress / (lambda + 2 mu) is below |b_e - I|. Tested for elastic strains up to 0.2.
inline double hencky_stiffness_bound(double stiffness, const Motion& motion, const Sym6& b) {
  const double x = b[0] - 1, y = b[1] - 1, z = b[2] - 1;
  const double strain = std::sqrt(x * x + y * y + z * z + 2 * (b[3] * b[3] + b[4] * b[4] + b[5] * b[5]));
  return stiffness * (1 + strain) * inverse_square_of_least_stretch(motion);
}

}  // namespace scarp

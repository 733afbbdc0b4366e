// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mohr-Coulomb at a point against closed forms: phi = 30 deg, c = 10 kPa, psi = 0, p = -100 kPa, E = 10 MPa, nu = 0.3.
#include "solver/materials/mohr_coulomb.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/materials/symmetric_eigen.hpp"
#include "tests/support/driven_point.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using test::validate_near;
using Driven = test::DrivenPoint<MohrCoulomb>;

constexpr double kPressure = -100e3;
MohrCoulomb soil() { return {{1900, 10e6, 0.3}, 10e3, 30, 0}; }

/// Compresses isotropically to the Cauchy pressure p: J with K ln J / J = p.
Mat3 isotropic(const MohrCoulomb& m, double p) {
  double J = 1;
  for (int i = 0; i < 50; ++i) J = std::exp(p * J / m.bulk_modulus());
  const double s = std::cbrt(J);
  return {s, 0, 0, 0, s, 0, 0, 0, s};
}

TEST(MohrCoulombPoint, SimpleShearReachesCohesionPlusFriction) {
  Driven point(soil());
  Mat3 F = isotropic(soil(), kPressure);
  point.move(F);
  Sym6 sigma{};
  for (int i = 1; i <= 400; ++i) {
    F[1] = i * 1e-4 * F[0];
    sigma = point.move(F);
  }
  const Vec3 s = symmetric_eigen(sigma).values;
  validate_near("Mohr-Coulomb point: simple shear, (s1 - s3) / 2, Pa", 58660.254,
                (std::max({s[0], s[1], s[2]}) - std::min({s[0], s[1], s[2]})) / 2, 1e-2,
                "c cos(phi) - p sin(phi); psi = 0 keeps p");
  validate_near("Mohr-Coulomb point: simple shear, sigma_xy, Pa", 58660.254, sigma[3], 60,
                "the principal axes lag behind by half the elastic shear: 1e-3");
  validate_near("Mohr-Coulomb point: simple shear, mean stress, Pa", kPressure, (sigma[0] + sigma[1] + sigma[2]) / 3,
                0.1, "psi = 0 keeps it");
}

/// Plane strain in z, sigma_xx held at -100 kPa by a search for F_xx, sigma_yy driven to yield. The closed form is of
/// small strain and does not depend on E: a thousandfold E leaves finite-strain terms of 3e-5.
TEST(MohrCoulombPoint, BiaxialCompression) {
  MohrCoulomb m = soil();
  m.youngs_modulus *= 1000;
  Driven point(m);
  Mat3 F = isotropic(m, kPressure);
  point.move(F);
  Sym6 sigma{};
  for (int i = 1; i <= 600; ++i) {
    F[4] *= 1 - 1e-7;
    double low = F[0] - 1e-6, high = F[0] + 1e-6;
    for (int k = 0; k < 60; ++k) {  // sigma_xx grows with F_xx
      F[0] = 0.5 * (low + high);
      Driven trial = point;
      (trial.move(F)[0] < kPressure ? low : high) = F[0];
    }
    sigma = point.move(F);
  }
  validate_near("Mohr-Coulomb point: biaxial compression at sigma_xx = -100 kPa, sigma_yy, Pa", -334641.02, sigma[1],
                0.1, "N_phi sigma_xx - 2 c sqrt(N_phi)");
  validate_near("Mohr-Coulomb point: biaxial compression, sigma_zz, Pa", -170392.3, sigma[2], 10,
                "left where the elastic path met the yield surface: one step's share");
}

TEST(MohrCoulombPoint, TensionEndsAtTheApex) {
  Driven point(soil());
  const Sym6 sigma = point.move({1.02, 0.003, 0, 0, 1.01, 0, 0.001, 0, 1.015});
  double worst = 0;
  for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(sigma[k] - 10e3 / std::tan(M_PI / 6)));
  validate_near("Mohr-Coulomb point: tension, largest departure from the apex of 17320.508 Pa, Pa", 0, worst, 1e-3,
                "c cot(phi) in all directions");
}

/// E = 450, nu = 0.125, phi = psi = 10 deg, c = 1, compressed by 1 % between rigid walls and half of it back. Strains
/// and cohesion are scaled by 1e-3, by which the small-strain answer scales exactly.
TEST(MohrCoulombPoint, ConfinedCompression) {
  const double scale = 1e-3, E = 450, nu = 0.125, phi = 10 * M_PI / 180, c = 1;
  Driven point(MohrCoulomb{{1, E, nu}, c * scale, 10, 10});
  const auto stress_at = [&](double strain) {
    return point.move({1, 0, 0, 0, std::exp(strain * scale), 0, 0, 0, 1})[1] / scale;
  };
  const double modulus = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), k0 = nu / (1 - nu);
  const double N = (1 + std::sin(phi)) / (1 - std::sin(phi));
  // Yield: -sigma_yy = N (-sigma_xx) + 2 c sqrt(N), with sigma_xx = k0 sigma_yy.
  const double yield_stress = -2 * c * std::sqrt(N) / (1 - N * k0), yield_strain = yield_stress / modulus;
  validate_near("Mohr-Coulomb point: confined compression to yield, sigma_yy", yield_stress, stress_at(yield_strain),
                1e-3, "elastic, 466.67 x 0.64075 %");
  double top = 0;
  for (int i = 1; i <= 400; ++i) top = stress_at(yield_strain + (-0.01 - yield_strain) * i / 400);
  // Associated flow on the edge of two equal lateral stresses, 2 lambda across and -N lambda along each: from
  // d sigma_yy = N d sigma_xx, with the oedometer's and Lame's moduli M and L.
  const double L = E * nu / ((1 + nu) * (1 - 2 * nu)), G = E / (2 * (1 + nu));
  const double plastic = modulus - std::pow(modulus - N * L, 2) / (modulus - 2 * N * L + N * N * (L + G));  // 296.93
  validate_near("Mohr-Coulomb point: confined compression, plastic modulus", plastic,
                (top - yield_stress) / (-0.01 - yield_strain), 0.05, "associated flow on the edge");
  const double back = stress_at(-0.005);
  validate_near("Mohr-Coulomb point: confined unloading, modulus", modulus, (back - top) / 0.005, 0.05, "elastic");
}

}  // namespace
}  // namespace scarp

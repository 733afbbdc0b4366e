// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Hencky solid against closed forms: stretches along the axes, where ln is the strain, and simple shear.
#include "solver/materials/hencky.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scarp {
namespace {

const Hencky kRubber{{1000, 1e6, 0.3}};

Sym6 stress(const Hencky& m, const Mat3& F) {
  PointHistory history;
  return Hencky::Law(m).stress(make_motion(kIdentity, F), history);
}

TEST(HenckyPoint, StretchAlongTheAxesIsHookeInTheLogarithm) {
  const double x = 1.4, y = 0.7, z = 1.1, J = x * y * z;
  const Sym6 s = stress(kRubber, {x, 0, 0, 0, y, 0, 0, 0, z});
  const double mu = kRubber.shear_modulus(), lambda = kRubber.lambda();
  EXPECT_NEAR(s[0], (2 * mu * std::log(x) + lambda * std::log(J)) / J, 1e-9);
  EXPECT_NEAR(s[1], (2 * mu * std::log(y) + lambda * std::log(J)) / J, 1e-9);
  EXPECT_NEAR(s[2], (2 * mu * std::log(z) + lambda * std::log(J)) / J, 1e-9);
  for (int k = 3; k < 6; ++k) EXPECT_EQ(s[k], 0);
}

/// Uniaxial stress: the stretch across is lambda^-nu at any strain, and tau = E ln(lambda).
TEST(HenckyPoint, KeepsPoissonsRatioInTheLogarithm) {
  for (double stretch : {0.5, 0.9, 1.3, 2.0}) {
    const double across = std::pow(stretch, -kRubber.poissons_ratio), J = stretch * across * across;
    const Sym6 s = stress(kRubber, {stretch, 0, 0, 0, across, 0, 0, 0, across});
    EXPECT_NEAR(s[0] * J, kRubber.youngs_modulus * std::log(stretch), 1e-9 * kRubber.youngs_modulus);
    EXPECT_NEAR(s[1], 0, 1e-9 * kRubber.youngs_modulus);
  }
}

/// Simple shear gamma = 2 sinh(a): principal stretches exp(+-a), so that (s1 - s3) / 2 = 2 mu a; the major axis stands
/// at 1/2 atan(2 / gamma), so that sigma_xy = 2 mu a / cosh(a).
TEST(HenckyPoint, SimpleShear) {
  for (double a : {1e-6, 0.1, 0.5, 1.0, 2.0}) {
    const Sym6 s = stress(kRubber, {1, 2 * std::sinh(a), 0, 0, 1, 0, 0, 0, 1});
    const double tau = 2 * kRubber.shear_modulus() * a;
    EXPECT_NEAR(s[3], tau / std::cosh(a), 1e-10 * kRubber.youngs_modulus);
    EXPECT_NEAR(s[0] - s[1], 2 * tau * std::tanh(a), 1e-10 * kRubber.youngs_modulus);
    EXPECT_NEAR(s[0] + s[1], 0, 1e-10 * kRubber.youngs_modulus);
  }
}

/// det F = 1.2, W has no part of shape for a pure change of volume.
TEST(HenckyPoint, EnergyOfAPureChangeOfVolume) {
  const double s = std::cbrt(1.2);
  const double W = Hencky::Law(kRubber).stored_energy(make_motion(kIdentity, {s, 0, 0, 0, s, 0, 0, 0, s}), {});
  EXPECT_NEAR(W, 0.5 * kRubber.bulk_modulus() * std::pow(std::log(1.2), 2), 1e-9);
}

}  // namespace
}  // namespace scarp

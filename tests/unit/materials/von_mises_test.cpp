// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// J2 plasticity at a point against closed forms of small strain: the yield stress is 1e-6 of E, which leaves
// finite-strain terms of that size.
#include "solver/materials/von_mises.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/materials/law.hpp"
#include "tests/support/driven_point.hpp"

namespace scarp {
namespace {

constexpr double kE = 200e9, kYield = 200e3, kNu = 0.3;
VonMises steel(double modulus = 0) { return {{7850, kE, kNu}, kYield, modulus}; }

/// Uniaxial stress to the logarithmic strain `strain`, the two faces across held free by bisection of their stretch.
Sym6 uniaxial(test::DrivenPoint<VonMises>& point, double strain, int steps) {
  Sym6 sigma{};
  for (int i = 1; i <= steps; ++i) {
    const double along = std::exp(strain * i / steps);
    double low = -0.6 * strain, high = 0;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high), across = std::exp(middle);
      test::DrivenPoint<VonMises> trial = point;
      (trial.move({along, 0, 0, 0, across, 0, 0, 0, across})[1] < 0 ? low : high) = middle;
    }
    const double across = std::exp(0.5 * (low + high));
    sigma = point.move({along, 0, 0, 0, across, 0, 0, 0, across});
  }
  return sigma;
}

TEST(VonMisesPoint, UniaxialTensionFollowsTheElasticPlasticTangent) {
  for (double modulus : {0.0, 2e9, 50e9}) {
    test::DrivenPoint<VonMises> point(steel(modulus));
    const double at_yield = kYield / kE, tangent = kE * modulus / (kE + modulus);
    EXPECT_NEAR(uniaxial(point, 0.999 * at_yield, 1)[0], 0.999 * kYield, 1e-5 * kYield);
    EXPECT_EQ(point.history.equivalent_plastic_strain, 0);
    const double first = uniaxial(point, 3 * at_yield, 4)[0];
    EXPECT_NEAR(first, kYield + tangent * 2 * at_yield, 1e-5 * kYield);
    const double second = uniaxial(point, 5 * at_yield, 4)[0];
    EXPECT_NEAR(second - first, tangent * 2 * at_yield, 1e-5 * kYield);
    EXPECT_NEAR(point.history.equivalent_plastic_strain, 5 * at_yield - second / kE, 1e-5 * at_yield);
    // The area below the hardening line; eight backward steps overrate its triangle by at most a quarter.
    const double a = point.history.equivalent_plastic_strain;
    EXPECT_NEAR(point.history.plastic_work, kYield * a + 0.5 * modulus * a * a,
                0.13 * modulus * a * a + 1e-4 * kYield * a);
  }
}

TEST(VonMisesPoint, SimpleShearYieldsAtTheStressOverRootThree) {
  for (double modulus : {0.0, 10e9}) {
    const VonMises m = steel(modulus);
    test::DrivenPoint<VonMises> point(m);
    const double G = m.shear_modulus(), yield = kYield / std::sqrt(3.0), at_yield = yield / G;
    for (double multiple : {0.5, 0.999, 2.0, 4.0, 8.0}) {
      const Sym6 sigma = point.move({1, multiple * at_yield, 0, 0, 1, 0, 0, 0, 1});
      const double tangent = G * modulus / (3 * G + modulus);
      const double expected = multiple < 1 ? multiple * yield : yield + tangent * (multiple - 1) * at_yield;
      EXPECT_NEAR(sigma[3], expected, 1e-5 * yield);
      EXPECT_NEAR(sigma[0] + sigma[1] + sigma[2], 0, 1e-5 * yield);
    }
  }
}

TEST(VonMisesPoint, UnloadsElasticallyAndYieldsAtTheHardenedStress) {
  const VonMises m = steel(10e9);
  test::DrivenPoint<VonMises> point(m);
  const double at_yield = kYield / std::sqrt(3.0) / m.shear_modulus();
  const double top = point.move({1, 3 * at_yield, 0, 0, 1, 0, 0, 0, 1})[3];
  const double a = point.history.equivalent_plastic_strain;
  const double back = point.move({1, 1.5 * at_yield, 0, 0, 1, 0, 0, 0, 1})[3];
  EXPECT_NEAR(top - back, 1.5 * at_yield * m.shear_modulus(), 1e-5 * kYield);
  EXPECT_EQ(point.history.equivalent_plastic_strain, a);
  const double again = point.move({1, 2.999 * at_yield, 0, 0, 1, 0, 0, 0, 1})[3];
  EXPECT_EQ(point.history.equivalent_plastic_strain, a);
  EXPECT_NEAR(again, top, 1e-3 * kYield);
}

/// Voce's curve, in steps that range from far below the saturation strain to far beyond it.
TEST(VonMisesPoint, SaturatesAsVoceSays) {
  VonMises m = steel(1e9);
  m.saturation_stress = 3 * kYield;
  for (double saturation : {1e-12, 1e-6, 1e-5, 1e-3}) {
    m.saturation_strain = saturation;
    test::DrivenPoint<VonMises> point(m);
    for (double gamma : {1e-6, 3e-6, 1e-5, 1e-4}) {
      const Sym6 sigma = point.move({1, gamma, 0, 0, 1, 0, 0, 0, 1});
      const double a = point.history.equivalent_plastic_strain;
      if (gamma < 1.4e-6) continue;
      EXPECT_GT(a, 0);
      const double expected = kYield + 1e9 * a + 2 * kYield * (1 - std::exp(-a / saturation));
      EXPECT_NEAR(std::sqrt(3.0) * sigma[3], expected, 1e-4 * kYield) << saturation << " " << gamma;
      EXPECT_NEAR(point.law.yield_function(sigma, point.history), 0, 1e-9 * kYield);
    }
  }
}

/// At large strain: no change of volume by plastic flow, and the strength in the Cauchy stress at any J.
TEST(VonMisesPoint, LargeStrainKeepsTheVolumeElasticAndTheStrengthInTheCauchyStress) {
  const VonMises m{{1900, 20e6, 0.3}, 20e3};
  test::DrivenPoint<VonMises> point(m);
  Sym6 sigma{};
  for (int i = 1; i <= 100; ++i) sigma = point.move({1 - 0.001 * i, 0.03 * i, 0, 0, 1 - 0.001 * i, 0, 0, 0, 1});
  const Sym6& b = point.history.elastic_left_cauchy_green;
  const double det =
      b[0] * (b[1] * b[2] - b[4] * b[4]) - b[3] * (b[3] * b[2] - b[4] * b[5]) + b[5] * (b[3] * b[4] - b[1] * b[5]);
  EXPECT_NEAR(std::sqrt(det), 0.81, 1e-12);
  EXPECT_NEAR((sigma[0] + sigma[1] + sigma[2]) / 3, m.bulk_modulus() * std::log(0.81) / 0.81, 1e-3);
  EXPECT_NEAR(point.law.yield_function(sigma), 0, 1e-6);
}

/// Simple shear, almost rigid-plastic: the equivalent plastic strain is gamma / sqrt(3), less the elastic share,
/// however far the shear goes.
TEST(VonMisesPoint, LargeSimpleShearAddsUpItsPlasticStrain) {
  const VonMises m{{1900, 20e6, 0.3}, 20e3};
  test::DrivenPoint<VonMises> point(m);
  for (int i = 1; i <= 500; ++i) point.move({1, 0.004 * i, 0, 0, 1, 0, 0, 0, 1});
  const double elastic = 20e3 / std::sqrt(3.0) / m.shear_modulus();
  EXPECT_NEAR(point.history.equivalent_plastic_strain, (2 - elastic) / std::sqrt(3.0), 1e-5);
}

TEST(VonMisesPoint, SaturationNeedsBothItsParametersAndMayNotSoften) {
  VonMises m = steel();
  m.saturation_stress = 2 * kYield;
  try {
    validate(m, "bolt");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "saturation of material 'bolt': found saturation_stress alone; allowed: saturation_stress and "
                 "saturation_strain together, or neither");
  }
  m.saturation_strain = -0.1;
  EXPECT_THROW(validate(m, "bolt"), Error);
  m.saturation_strain = 0.1;
  EXPECT_NO_THROW(validate(m, "bolt"));
  m.saturation_stress = 0.5 * kYield;
  EXPECT_THROW(validate(m, "bolt"), Error);
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Element tests of modified Cam-clay against its closed forms; strains in compression are positive here.
#include "solver/materials/cam_clay.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/materials/law.hpp"
#include "tests/support/triaxial.hpp"

namespace scarp {
namespace {

using test::deviator_of;
using test::pressure_of;
using test::Triaxial;

CamClay clay(double ratio) {
  CamClay m{
      .density = 1700, .shear_modulus = 20e6, .kappa = 0.05, .lambda = 0.2, .void_ratio = 1, .initial_pressure = 100e3};
  m.critical_stress_ratio = 1.2;
  m.overconsolidation_ratio = ratio;
  return m;
}

/// Virgin line: with J p_c on it, - ln J (1 + kappa*) = kappa* ln(p/p0) + (lambda* - kappa*) ln(p/p_c0), in any number
/// of steps; swelling back: J p = p0 exp(- tr e / kappa*).
TEST(CamClayPoint, FollowsTheVirginAndTheSwellingLine) {
  for (int steps : {1, 7, 100}) {
    const CamClay m = clay(2);
    test::DrivenPoint<CamClay> point(m);
    Sym6 sigma{};
    const double end = 0.15;
    for (int i = 1; i <= steps; ++i) {
      const double s = std::exp(-end * i / steps / 3);
      sigma = point.move({s, 0, 0, 0, s, 0, 0, 0, s});
    }
    const double p = pressure_of(sigma);
    EXPECT_NEAR(end * (1 + m.swelling()), m.swelling() * std::log(p / 100e3) + m.hardening() * std::log(p / 200e3),
                1e-12);
    const double back = std::exp(-0.12 / 3);
    const double swollen = pressure_of(point.move({back, 0, 0, 0, back, 0, 0, 0, back}));
    EXPECT_NEAR(std::log(swollen * std::exp(-0.12) / (p * std::exp(-0.15))), -0.03 / m.swelling(), 1e-11);
  }
}

/// Undrained, at constant volume: q = M p sqrt(p_c / p - 1) with p_c = p_c0 (p0 / p)^(kappa / (lambda - kappa)) where
/// it yields, to the critical state p = p0 (R/2)^(1 - kappa / lambda), q = M p; normally consolidated, lightly and
/// heavily overconsolidated.
TEST(CamClayPoint, UndrainedTriaxialPathEndsInTheCriticalState) {
  for (double ratio : {1.0, 1.5, 4.0, 8.0}) {
    const CamClay m = clay(ratio);
    Triaxial<CamClay> point(m);
    for (int i = 1; i <= 400; ++i) {
      const Sym6 sigma = point.undrained(5e-4 * i);
      if (point.history.equivalent_plastic_strain == 0) continue;
      const double p = pressure_of(sigma);
      const double p_c = ratio * 100e3 * std::pow(100e3 / p, 0.05 / 0.15);
      EXPECT_NEAR(deviator_of(sigma), 1.2 * std::sqrt(std::max(0.0, p * (p_c - p))), 1e-6 * p);
    }
    const Sym6 sigma = point.undrained(1.0);
    const double critical = 100e3 * std::pow(ratio / 2, 1 - 0.05 / 0.2);
    EXPECT_NEAR(pressure_of(sigma), critical, 1e-3 * critical);
    EXPECT_NEAR(deviator_of(sigma), 1.2 * critical, 1e-3 * critical);
  }
}

/// Drained, at constant lateral stress: dq = 3 dp to p = p0 / (1 - M / 3).
TEST(CamClayPoint, DrainedTriaxialPathEndsInTheCriticalState) {
  const CamClay m = clay(1.5);
  Triaxial<CamClay> point(m);
  Sym6 sigma{};
  for (int i = 1; i <= 300; ++i) {
    sigma = point.drained(4e-3 * i, 100e3);
    EXPECT_NEAR(deviator_of(sigma), 3 * (pressure_of(sigma) - 100e3), 1e-3 * 100e3);
  }
  EXPECT_NEAR(pressure_of(sigma), 100e3 / (1 - 0.4), 1e-3 * 100e3);
  EXPECT_NEAR(deviator_of(sigma) / pressure_of(sigma), 1.2, 1e-3);
}

/// Any trial state: returned to the ellipse, finite, and dissipating.
TEST(CamClayPoint, ReturnsFromAnyTrialState) {
  const CamClay m = clay(1);
  for (double volume : {-2.0, -0.3, -1e-3, -1e-9, 0.0, 1e-12, 1e-6, 0.01, 0.2, 2.0})
    for (double shear : {0.0, 1e-12, 1e-6, 1e-3, 0.1, 3.0}) {
      test::DrivenPoint<CamClay> point(m);
      const double s = std::exp(-volume / 3);
      const Sym6 sigma = point.move({s, shear * s, 0, 0, s, 0, 0, 0, s});
      for (double v : sigma) ASSERT_TRUE(std::isfinite(v)) << volume << " " << shear;
      EXPECT_LE(point.law.yield_function(sigma, point.history), 1e-11 * (pressure_of(sigma) + 100e3))
          << volume << " " << shear;
      EXPECT_GE(point.history.plastic_work, 0);
    }
}

TEST(CamClayPoint, TakesMFromTheAngleOfFriction) {
  CamClay m = clay(1);
  m.critical_stress_ratio.reset();
  m.friction_angle = 30;
  EXPECT_NEAR(m.M(), 1.2, 1e-12);
}

TEST(CamClayPoint, RefusesWhatCannotRun) {
  const auto message = [](const CamClay& m) -> std::string {
    try {
      validate(m, "clay");
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  CamClay m = clay(1);
  EXPECT_EQ(message(m), "accepted");
  m.lambda = 0.05;
  EXPECT_EQ(message(m), "lambda of material 'clay': found 0.05; allowed: above kappa (0.05)");
  m = clay(1);
  m.friction_angle = 30;
  EXPECT_EQ(message(m),
            "critical state of material 'clay': found critical_stress_ratio and friction_angle; allowed: one of "
            "critical_stress_ratio and friction_angle");
  m = clay(1);
  m.preconsolidation = 200e3;
  EXPECT_EQ(message(m),
            "preconsolidation of material 'clay': found preconsolidation and overconsolidation_ratio; allowed: "
            "at most one of them");
  m.overconsolidation_ratio.reset();
  m.preconsolidation = 50e3;
  EXPECT_EQ(message(m),
            "preconsolidation of material 'clay': found 50000; allowed: at least initial_pressure (100000 Pa)");
  m = clay(1);
  m.initial_pressure = 0;
  EXPECT_EQ(message(m), "initial_pressure of material 'clay': found 0; allowed: above 0 Pa");
}

}  // namespace
}  // namespace scarp

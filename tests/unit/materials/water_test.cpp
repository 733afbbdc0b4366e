// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/water.hpp"

#include <gtest/gtest.h>

#include "solver/core/current_wave_speed.hpp"
#include "solver/materials/law.hpp"
#include "tests/support/driven_point.hpp"

namespace scarp {
namespace {

constexpr double kPerDt = 1e4;
const Water kOil{.density = 900, .sound_speed = 30, .viscosity = 2};

Mat3 stretched(double s) { return {s, 0, 0, 0, s, 0, 0, 0, s}; }

/// p = B (J^-7 - 1), and a change of pressure of density c^2 per volumetric strain at first.
TEST(WaterPoint, HasTaitsPressure) {
  test::DrivenPoint<Water> point(kOil);
  const double B = 900 * 900 / 7.0;
  for (double J : {0.999, 0.97, 0.9}) {
    const Sym6 sigma = point.move(stretched(std::cbrt(J)));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(sigma[k], -B * (std::pow(1 / J, 7) - 1), 1e-10 * B);
    EXPECT_EQ(sigma[3], 0);
  }
  EXPECT_NEAR(point.move(stretched(std::cbrt(1 - 1e-6)))[0], -900 * 900 * 1e-6, 1e-5);
}

TEST(WaterPoint, IsNotPulledUnlessAllowed) {
  Water cohesive = kOil;
  cohesive.tension = true;
  test::DrivenPoint<Water> parts(kOil), holds(cohesive);
  const Mat3 F = stretched(1.01);
  EXPECT_EQ(parts.move(F), (Sym6{0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(parts.law.stored_energy(make_motion(F, F), {}), 0);
  EXPECT_GT(holds.move(F)[0], 1e4);
  EXPECT_GT(holds.law.stored_energy(make_motion(F, F), {}), 0);
  const Mat3 back = stretched(0.999);
  EXPECT_NEAR(parts.move(back)[0], holds.move(back)[0], 1e-9);
}

/// Simple shear at rate g: tau = viscosity g, and viscosity g^2 is dissipated.
TEST(WaterPoint, ShearsWithItsViscosityAndDissipatesTheWork) {
  const Water::Law law(kOil);
  PointHistory history;
  Mat3 F = kIdentity;
  const double rate = 5, step = rate / kPerDt;
  for (int i = 1; i <= 400; ++i) {
    const Mat3 next{1, i * step, 0, 0, 1, 0, 0, 0, 1};
    const Sym6 sigma = law.stress(make_motion(F, next, kPerDt), history);
    EXPECT_NEAR(sigma[3], 2 * rate, 1e-6 * rate);
    F = next;
  }
  EXPECT_NEAR(history.plastic_work, 2 * rate * rate * 400 / kPerDt, 1e-6);
}

/// A uniform stretching at rate r in x: sigma_xx + p = 4/3 viscosity r.
TEST(WaterPoint, StretchesWithItsViscosity) {
  const Water::Law law(kOil);
  PointHistory history;
  const Mat3 F{1.2, 0.1, 0, 0, 0.9, 0, 0, 0, 1}, f{std::exp(3 / kPerDt), 0, 0, 0, 1, 0, 0, 0, 1};
  const Sym6 sigma = law.stress(make_motion(F, multiply(f, F), kPerDt), history);
  EXPECT_NEAR(sigma[0], 4.0 / 3 * 2 * 3, 1e-6);
  EXPECT_NEAR(sigma[1], -2.0 / 3 * 2 * 3, 1e-6);
  EXPECT_NEAR(sigma[0] + sigma[1] + sigma[2], 0, 1e-9);
}

TEST(WaterPoint, DoesNotFeelRotationAndTurnsWithIt) {
  const Water::Law law(kOil);
  const Mat3 F{1.2, 0.1, 0, 0.3, 0.9, 0, 0, 0.2, 1}, Q = polar_rotation({0, -1, 0.2, 1, 0.3, 0, 0, 0.1, 1});
  PointHistory still;
  EXPECT_NEAR(law.stress(make_motion(F, multiply(Q, F), kPerDt), still)[3], 0, 1e-9);
  EXPECT_NEAR(still.plastic_work, 0, 1e-9);
  const Mat3 next = multiply({1, 0.01, 0, 0, 0.998, 0.02, 0, 0, 1}, F);
  PointHistory a, b;
  const Sym6 plain = push_forward(Q, law.stress(make_motion(F, next, kPerDt), a));
  const Sym6 turned = law.stress(make_motion(F, multiply(Q, next), kPerDt), b);
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(plain[k], turned[k], 1e-10 * 2 * kPerDt);
  EXPECT_GT(a.plastic_work, 0);
}

/// Creeping flow in fine cells: the step is bound by h^2 / (2 nu), nu that of compression, 4/3 viscosity / density; in
/// coarse cells by h / c.
TEST(WaterPoint, ViscosityBoundsTheTimeStep) {
  const Motion rest = make_motion(kIdentity, kIdentity);
  const double nu = 4.0 / 3 * 2 / 900, fine = 1e-6, coarse = 1;
  const double viscous = fine / std::sqrt(Water::Law(kOil, fine).wave_speed_squared(rest, {}));
  EXPECT_NEAR(viscous, fine * fine / (2 * nu), 1e-3 * viscous);
  const double acoustic = coarse / std::sqrt(Water::Law(kOil, coarse).wave_speed_squared(rest, {}));
  EXPECT_NEAR(acoustic, coarse / 30, 2e-4 * acoustic);
  EXPECT_LT(acoustic, coarse / 30);
}

TEST(WaterPoint, FlowDoesNotShortenTheTimeStep) {
  const Water::Law law(kOil);
  const Mat3 sheared{1, 50, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_NEAR(current_wave_speed_squared(law, make_motion(sheared, sheared), {}), 900, 1e-9);
}

}  // namespace
}  // namespace scarp

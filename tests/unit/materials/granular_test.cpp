// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/granular.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/materials/law.hpp"
#include "tests/support/driven_point.hpp"

namespace scarp {
namespace {

const Granular kBeads{{1500, 1e7, 0.3}, 0.38, 0.64, 0.279, 1e-3, 2500};

double pressure_of(const Sym6& s) { return -(s[0] + s[1] + s[2]) / 3; }

/// Steady simple shear at constant volume, i.e. constant pressure: tau / p = mu(I), over six decades of the rate.
TEST(GranularPoint, FlowsWithTheFrictionOfItsInertialNumber) {
  const Granular::Law law(kBeads);
  for (double rate : {1e-4, 1e-2, 1.0, 10.0, 100.0, 1000.0}) {
    const double s = 1 - 1e-4, step = 1e-5, per_dt = rate / step;
    PointHistory history;
    Mat3 F = kIdentity;
    Sym6 sigma{};
    for (int i = 0; i <= 400; ++i) {
      const Mat3 next{s, i * step * s, 0, 0, s, 0, 0, 0, s};
      sigma = law.stress(make_motion(F, next, per_dt), history);
      F = next;
    }
    const double p = pressure_of(sigma), I = rate * 1e-3 * std::sqrt(2500 / p);
    EXPECT_NEAR(p, -kBeads.bulk_modulus() * 3 * std::log(s) / (s * s * s), 1e-6 * p);
    EXPECT_NEAR(sigma[3] / p, 0.38 + 0.26 / (1 + 0.279 / I), 1e-3) << rate;
  }
}

/// A step that takes for ever ends at mu_s, one that takes no time at mu_2.
TEST(GranularPoint, TakesAnyStep) {
  const Granular::Law law(kBeads);
  const double s = 1 - 1e-4;
  const Mat3 pressed{s, 0, 0, 0, s, 0, 0, 0, s}, sheared{s, 0.01, 0, 0, s, 0, 0, 0, s};
  const auto shear = [&](double per_dt) {
    PointHistory history;
    law.stress(make_motion(kIdentity, pressed), history);
    return law.stress(make_motion(pressed, sheared, per_dt), history)[3];
  };
  const double p = -kBeads.bulk_modulus() * 3 * std::log(s);
  EXPECT_NEAR(shear(0), 0.38 * p, 1e-3 * p);
  EXPECT_NEAR(shear(1e-6), 0.38 * p, 1e-3 * p);
  EXPECT_LT(shear(1e2), 0.64 * p);
  EXPECT_NEAR(shear(1e12), 0.64 * p, 1e-3 * p);
}

/// Looser than the grains touch: no stress at all; met again, the pressure of the volume that is left.
TEST(GranularPoint, PartsAndMeetsAgain) {
  test::DrivenPoint<Granular> point(kBeads);
  point.move({1, 0, 0, 0, 1 - 1e-3, 0, 0, 0, 1});
  for (double y : {1 + 1e-6, 1.01, 1.5}) {
    EXPECT_EQ(point.move({1, 0.1, 0, 0, y, 0, 0, 0, 1}), (Sym6{0, 0, 0, 0, 0, 0}));
    EXPECT_NEAR(point.law.stored_energy(make_motion(point.F, point.F), point.history), 0, 1e-12);
  }
  const Sym6 sigma = point.move({1, 0.1, 0, 0, 0.999, 0, 0, 0, 1});
  const double p = -kBeads.bulk_modulus() * std::log(0.999) / 0.999;
  EXPECT_NEAR(pressure_of(sigma), p, 1e-9 * p);
}

TEST(GranularPoint, RefusesWhatDoesNotFitTogether) {
  const auto message = [](const Granular& m) -> std::string {
    try {
      validate(m, "beads");
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  Granular m = kBeads;
  EXPECT_EQ(message(m), "accepted");
  m.mu_2 = 0.2;
  EXPECT_EQ(message(m), "mu_2 of material 'beads': found 0.2; allowed: at least mu_s (0.38)");
  m = kBeads;
  m.grain_density = 1000;
  EXPECT_EQ(message(m), "grain_density of material 'beads': found 1000; allowed: at least density (1500 kg/m3)");
}

}  // namespace
}  // namespace scarp

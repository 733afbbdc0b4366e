// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Strain softening of Mohr-Coulomb at a point. Without friction simple shear carries tau = c(a) and a = gamma_p /
// sqrt(3), to the finite-strain terms that a stiffness of 1e4 c leaves.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/materials/law.hpp"
#include "solver/materials/symmetric_eigen.hpp"
#include "tests/support/driven_point.hpp"

namespace scarp {
namespace {

constexpr double kPeak = 20e3, kResidual = 5e3;
using Point = test::DrivenPoint<MohrCoulomb>;

MohrCoulomb clay(Softening shape, double strain) {
  MohrCoulomb m{{1900, 1e9, 0.3}, kPeak, 0, 0};
  m.residual_cohesion = kResidual;
  m.softening = shape;
  m.softening_strain = strain;
  return m;
}

double shear_strength(const Sym6& sigma) {
  const Vec3 s = symmetric_eigen(sigma).values;
  return (std::max({s[0], s[1], s[2]}) - std::min({s[0], s[1], s[2]})) / 2;
}

TEST(SofteningPoint, CohesionFallsAsStated) {
  for (Softening shape : {Softening::linear, Softening::exponential}) {
    Point point(clay(shape, 0.01));
    for (int i = 1; i <= 300; ++i) {
      const Sym6 sigma = point.move({1, 2e-4 * i, 0, 0, 1, 0, 0, 0, 1});
      const double a = point.history.equivalent_plastic_strain;
      if (a == 0) continue;
      const double gone = shape == Softening::linear ? std::min(1.0, a / 0.01) : 1 - std::exp(-a / 0.01);
      EXPECT_NEAR(shear_strength(sigma), kPeak + gone * (kResidual - kPeak), 1e-6 * kPeak);
    }
    EXPECT_GT(point.history.equivalent_plastic_strain, 0.03);
  }
}

/// tau and gamma by hand for linear softening: d tau / d gamma = G H / (G + H) with H = d c / d gamma_p.
TEST(SofteningPoint, FallsWithTheElasticPlasticTangent) {
  const MohrCoulomb m = clay(Softening::linear, 0.01);
  Point point(m);
  const double G = m.shear_modulus(), H = (kResidual - kPeak) / (0.01 * std::sqrt(3.0));
  const double first = 1e-3, second = 3e-3;
  const double tau1 = point.move({1, first, 0, 0, 1, 0, 0, 0, 1})[3];
  const double tau2 = point.move({1, second, 0, 0, 1, 0, 0, 0, 1})[3];
  EXPECT_NEAR((tau2 - tau1) / (second - first), G * H / (G + H), 2e-3 * std::abs(H));
}

/// The step does not matter but for the path of the axes: one step or a thousand.
TEST(SofteningPoint, DoesNotDependOnTheStep) {
  const MohrCoulomb m = clay(Softening::exponential, 0.01);
  Point once(m), often(m);
  const Sym6 one = once.move({1, 0.01, 0, 0, 1, 0, 0, 0, 1});
  Sym6 many{};
  for (int i = 1; i <= 1000; ++i) many = often.move({1, 1e-5 * i, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_NEAR(one[3], many[3], 1e-3 * kPeak);
  EXPECT_NEAR(once.history.equivalent_plastic_strain, often.history.equivalent_plastic_strain, 1e-5);
}

/// Friction and dilatancy fall with it: simple shear at constant pressure, c cos(phi) - p sin(phi) of what is left.
TEST(SofteningPoint, AnglesFallToo) {
  MohrCoulomb m{{1900, 1e9, 0.3}, kPeak, 35, 0};
  m.residual_cohesion = 0;
  m.residual_friction_angle = 20;
  m.softening_strain = 0.02;
  Point point(m);
  const double s = std::exp(-100e3 / (3 * m.bulk_modulus()));
  point.move({s, 0, 0, 0, s, 0, 0, 0, s});
  for (int i = 1; i <= 100; ++i) {
    const Sym6 sigma = point.move({s, 5e-4 * i * s, 0, 0, s, 0, 0, 0, s});
    const double p = (sigma[0] + sigma[1] + sigma[2]) / 3, a = point.history.equivalent_plastic_strain;
    if (a == 0) continue;
    const Vec3 v = symmetric_eigen(sigma).values;
    const double s1 = std::max({v[0], v[1], v[2]}), s3 = std::min({v[0], v[1], v[2]});
    const double gone = std::min(1.0, a / 0.02), phi = (35 - 15 * gone) * M_PI / 180;
    EXPECT_NEAR(p, -100e3, 50);
    EXPECT_NEAR((s1 - s3) + (s1 + s3) * std::sin(phi), 2 * kPeak * (1 - gone) * std::cos(phi), 1e-6 * kPeak);
  }
  EXPECT_GT(point.history.equivalent_plastic_strain, 0.02);
}

/// With dilatancy that fades: the volume stops growing.
TEST(SofteningPoint, DilatancyFades) {
  MohrCoulomb m{{1900, 1e9, 0.3}, kPeak, 30, 15};
  m.residual_dilatancy_angle = 0;
  m.softening_strain = 1e-3;
  Point point(m);
  double p_middle = 0, p_late = 0;
  for (int i = 1; i <= 400; ++i) {
    const Sym6 sigma = point.move({1, 2e-5 * i, 0, 0, 1, 0, 0, 0, 1});
    p_late = (sigma[0] + sigma[1] + sigma[2]) / 3;
    if (i == 200) p_middle = p_late;
  }
  EXPECT_LT(p_middle, -10e3);
  EXPECT_NEAR(p_late, p_middle, 1e-2 * std::abs(p_middle));
}

/// The cut-off shrinks with the apex of what is left.
TEST(SofteningPoint, TensionStrengthNeverExceedsTheApexThatIsLeft) {
  MohrCoulomb m{{1900, 1e9, 0.3}, kPeak, 30, 0, 10e3};
  m.residual_cohesion = 1e3;
  m.softening_strain = 1e-3;
  Point point(m);
  const Sym6 first = point.move({1.00002, 0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_NEAR(first[0], 10e3, 1e-3);
  const Sym6 last = point.move({1.05, 0, 0, 0, 1.05, 0, 0, 0, 1.05});
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(last[k], 1e3 / std::tan(M_PI / 6), 1e-3);
}

/// Work that softening takes beyond the residual strength, per volume of a band as wide as a cell: the same per area on
/// every grid. The triangle is (c - c_r) / 2 times gamma_p = sqrt(3) softening_strain softening_length / cell.
TEST(SofteningPoint, SofteningLengthKeepsTheEnergyPerArea) {
  MohrCoulomb m = clay(Softening::linear, 0.02);
  m.softening_length = 0.5;
  const double expected = 0.5 * (kPeak - kResidual) * std::sqrt(3.0) * 0.02 * 0.5;
  for (double cell : {0.1, 0.25, 0.5, 1.0, 2.0}) {
    const PreparedLaw law = prepare(Material(m), cell);
    PointHistory history;
    Mat3 F = kIdentity;
    const int steps = 4000;
    for (int i = 1; i <= steps; ++i) {
      const Mat3 next{1, 0.25 * i / steps, 0, 0, 1, 0, 0, 0, 1};
      std::visit([&](const auto& l) { l.stress(make_motion(F, next), history); }, law);
      F = next;
    }
    const double residual = kResidual * std::sqrt(3.0) * history.equivalent_plastic_strain;
    EXPECT_NEAR((history.plastic_work - residual) * cell, expected, 0.01 * expected) << cell;
  }
}

/// Softening faster than the elastic strain can follow: one step falls to the residual strength, and the work is still
/// what a stress within the surface does.
TEST(SofteningPoint, BrittleFallEndsAtTheResidualStrength) {
  for (Softening shape : {Softening::linear, Softening::exponential}) {
    Point point(clay(shape, 1e-9));
    const double at_yield = kPeak / clay(shape, 1e-9).shear_modulus();
    EXPECT_NEAR(point.move({1, 0.99 * at_yield, 0, 0, 1, 0, 0, 0, 1})[3], 0.99 * kPeak, 1e-3 * kPeak);
    EXPECT_NEAR(point.move({1, 1.01 * at_yield, 0, 0, 1, 0, 0, 0, 1})[3], kResidual, 1e-3 * kPeak);
    EXPECT_GT(point.history.plastic_work, 0);
  }
}

TEST(SofteningPoint, RefusesWhatDoesNotFitTogether) {
  const auto message = [](const MohrCoulomb& m) -> std::string {
    try {
      validate(m, "clay");
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  MohrCoulomb m{{1900, 1e9, 0.3}, kPeak, 30, 10};
  m.softening_strain = 0.1;
  EXPECT_EQ(message(m),
            "softening_strain of material 'clay': found no residual value beside it; allowed: residual_cohesion, "
            "residual_friction_angle or residual_dilatancy_angle with it");
  m.residual_cohesion = 30e3;
  EXPECT_EQ(message(m), "residual_cohesion of material 'clay': found 30000; allowed: at most cohesion (20000 Pa)");
  m.residual_cohesion = 1e3;
  EXPECT_EQ(message(m), "accepted");
  m.residual_friction_angle = 5;
  EXPECT_EQ(message(m),
            "residual_dilatancy_angle of material 'clay': found 10; allowed: at most residual_friction_angle (5 deg)");
  m.residual_dilatancy_angle = 0;
  EXPECT_EQ(message(m), "accepted");
  m.residual_friction_angle = 0;
  m.residual_cohesion = 0;
  EXPECT_NE(message(m), "accepted");
  m.residual_cohesion = 1e3;
  m.softening_strain.reset();
  EXPECT_EQ(message(m),
            "softening_strain of material 'clay': found no value; allowed: a plastic strain above 0, which a residual "
            "value needs");
}

}  // namespace
}  // namespace scarp

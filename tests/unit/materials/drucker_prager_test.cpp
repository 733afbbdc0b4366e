// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Drucker-Prager at a point: each cone has Mohr-Coulomb's strength in the state that it is named for, and every region
// of the return map ends where it must.
#include "solver/materials/drucker_prager.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/materials/law.hpp"
#include "solver/materials/symmetric_eigen.hpp"
#include "tests/support/driven_point.hpp"

namespace scarp {
namespace {

constexpr double kCohesion = 10e3, kFriction = 30, kSide = -100e3;
using Point = test::DrivenPoint<DruckerPrager>;

/// So stiff that strains at failure leave finite-strain terms of 1e-5.
DruckerPrager soil(ConeMatch match, double dilatancy = 0) {
  return {{1900, 10e9, 0.3}, kCohesion, kFriction, dilatancy, std::nullopt, match};
}

/// Mohr-Coulomb's f of the largest and the least stress, tension positive.
double mohr_coulomb(double s1, double s3) {
  const double phi = kFriction * M_PI / 180;
  return (s1 - s3) + (s1 + s3) * std::sin(phi) - 2 * kCohesion * std::cos(phi);
}

/// Drives F_yy while sigma_xx is held at kSide by a search for F_xx; F_zz follows F_xx or stays (plane strain).
Sym6 failed(const DruckerPrager& m, double step, bool axisymmetric) {
  const double start = std::exp(kSide / (3 * m.bulk_modulus()));
  Point point(m);
  Mat3 F{start, 0, 0, 0, start, 0, 0, 0, start};
  point.move(F);
  Sym6 sigma{};
  for (int i = 0; i < 500; ++i) {
    F[4] *= 1 + step;
    double low = F[0] - 4 * std::abs(step), high = F[0] + 4 * std::abs(step);
    for (int k = 0; k < 50; ++k) {  // sigma_xx grows with F_xx
      F[0] = 0.5 * (low + high);
      if (axisymmetric) F[8] = F[0];
      Point trial = point;
      (trial.move(F)[0] < kSide ? low : high) = F[0];
    }
    sigma = point.move(F);
  }
  EXPECT_NEAR(sigma[0], kSide, 10);
  EXPECT_GT(point.history.plastic_work, 0);
  return sigma;
}

TEST(DruckerPragerPoint, PlaneStrainMatchHasMohrCoulombsStrengthInBiaxialCompression) {
  for (double dilatancy : {0.0, 10.0, 30.0}) {
    const Sym6 s = failed(soil(ConeMatch::plane_strain, dilatancy), -1e-6, false);
    EXPECT_NEAR(mohr_coulomb(s[0], s[1]), 0, 1e-3 * kCohesion) << dilatancy;
    EXPECT_GT(s[0], s[2]);
    EXPECT_GT(s[2], s[1]);
  }
  const Sym6 s = failed(soil(ConeMatch::plane_strain), -1e-6, false);
  EXPECT_NEAR(s[1], -334641.02, 30);  // the unit value of Mohr-Coulomb
}

TEST(DruckerPragerPoint, AssociatedMatchHasMohrCoulombsStrengthInAssociatedFlow) {
  const Sym6 s = failed(soil(ConeMatch::plane_strain_associated, kFriction), -1e-6, false);
  EXPECT_NEAR(mohr_coulomb(s[0], s[1]), 0, 1e-3 * kCohesion);
  // Without dilatancy that cone is on the safe side.
  const Sym6 weaker = failed(soil(ConeMatch::plane_strain_associated), -1e-6, false);
  EXPECT_LT(mohr_coulomb(weaker[0], weaker[1]), -0.5 * kCohesion);
}

TEST(DruckerPragerPoint, OuterConeMatchesTriaxialCompressionAndIsTooStrongElsewhere) {
  for (double dilatancy : {0.0, 15.0}) {
    const Sym6 s = failed(soil(ConeMatch::outer, dilatancy), -1e-6, true);
    EXPECT_NEAR(mohr_coulomb(s[0], s[1]), 0, 1e-4 * kCohesion);
  }
  const Sym6 plane = failed(soil(ConeMatch::outer), -1e-6, false);
  EXPECT_GT(mohr_coulomb(plane[0], plane[1]), 2 * kCohesion);
  const Sym6 extension = failed(soil(ConeMatch::outer), 1e-6, true);
  EXPECT_GT(mohr_coulomb(extension[1], extension[0]), kCohesion);
}

TEST(DruckerPragerPoint, InnerConeMatchesTriaxialExtensionAndIsSafeInCompression) {
  for (double dilatancy : {0.0, 15.0}) {
    const Sym6 s = failed(soil(ConeMatch::inner, dilatancy), 1e-6, true);
    EXPECT_NEAR(mohr_coulomb(s[1], s[0]), 0, 1e-4 * kCohesion);
  }
  const Sym6 compression = failed(soil(ConeMatch::inner), -1e-6, true);
  EXPECT_LT(mohr_coulomb(compression[0], compression[1]), -kCohesion);
}

TEST(DruckerPragerPoint, ConesAreThoseOfTheFormulas) {
  const double phi = kFriction * M_PI / 180, s = std::sin(phi), t = std::tan(phi), root = std::sqrt(9 + 12 * t * t);
  const Cone flat = fit_cone(soil(ConeMatch::plane_strain));
  EXPECT_NEAR(flat.q, s, 1e-15);
  EXPECT_NEAR(flat.k, kCohesion * std::cos(phi), 1e-10);
  EXPECT_EQ(flat.q_flow, 0);
  for (ConeMatch match : {ConeMatch::plane_strain, ConeMatch::plane_strain_associated}) {
    const Cone cone = fit_cone(soil(match, kFriction));
    EXPECT_NEAR(cone.q, 3 * t / root, 1e-15);
    EXPECT_NEAR(cone.k, 3 * kCohesion / root, 1e-10);
    EXPECT_NEAR(cone.q_flow, cone.q, 1e-15);
  }
  EXPECT_NEAR(fit_cone(soil(ConeMatch::inner)).q, 6 * s / (std::sqrt(3.0) * (3 + s)), 1e-15);
  EXPECT_NEAR(fit_cone(soil(ConeMatch::outer)).q, 6 * s / (std::sqrt(3.0) * (3 - s)), 1e-15);
  for (ConeMatch match :
       {ConeMatch::plane_strain, ConeMatch::plane_strain_associated, ConeMatch::inner, ConeMatch::outer})
    for (double dilatancy : {0.0, 12.0}) {
      const Cone cone = fit_cone(soil(match, dilatancy));
      EXPECT_NEAR(cone.k / cone.q, kCohesion / t, 1e-9);
      EXPECT_LT(cone.q_flow, cone.q);
    }
}

Vec3 principal(const Sym6& s) {
  Vec3 v = symmetric_eigen(s).values;
  std::sort(v.begin(), v.end());
  return v;
}

TEST(DruckerPragerPoint, IsotropicTensionEndsAtTheApexOrAtTheCap) {
  for (double dilatancy : {0.0, 15.0, 30.0})
    for (bool cut : {false, true}) {
      DruckerPrager m = soil(ConeMatch::plane_strain, dilatancy);
      if (cut) m.tension_strength = 4e3;
      Point point(m);
      const Vec3 s = principal(point.move({1.02, 0, 0, 0, 1.02, 0, 0, 0, 1.02}));
      for (double v : s) EXPECT_NEAR(v, cut ? 4e3 : 17320.508, 1e-3);
    }
}

/// One step from rest, each into its region: (mean strain, shear strain) in units of what yields.
TEST(DruckerPragerPoint, ReturnsToConeCapAndCircle) {
  DruckerPrager m = soil(ConeMatch::plane_strain, 10);
  m.tension_strength = 5e3;
  const Cone cone = fit_cone(m);
  const double G = m.shear_modulus(), K = m.bulk_modulus(), corner = cone.k - cone.q * 5e3;
  const auto after = [&](double mean, double root_J2) {  // trial values, Pa
    const double v = mean / K / 3, g = 0.5 * root_J2 / G;
    Point point(m);
    const Sym6 s = point.move({std::exp(v + g), 0, 0, 0, std::exp(v - g), 0, 0, 0, std::exp(v)});
    return Vec2{(s[0] + s[1] + s[2]) / 3, 0.5 * (s[0] - s[1])};
  };
  {  // along (K q_flow, G) on to the cone
    const Vec2 s = after(-50e3, 80e3);
    const double gamma = (80e3 - cone.q * 50e3 - cone.k) / (G + K * cone.q * cone.q_flow);
    EXPECT_NEAR(s[0], -50e3 - K * cone.q_flow * gamma, 1);
    EXPECT_NEAR(s[1], 80e3 - G * gamma, 1);
  }
  {  // straight down to the cap
    const Vec2 s = after(9e3, 0.5 * corner);
    EXPECT_NEAR(s[0], 5e3, 0.1);
    EXPECT_NEAR(s[1], 0.5 * corner, 0.1);
  }
  {  // between the two directions of flow
    const Vec2 s = after(12e3, 2 * corner);
    EXPECT_NEAR(s[0], 5e3, 0.1);
    EXPECT_NEAR(s[1], corner, 0.1);
  }
}

TEST(DruckerPragerPoint, WithoutFrictionOnlyTheCapLimitsTension) {
  DruckerPrager m{{1900, 10e6, 0.3}, kCohesion, 0, 0};
  Point free(m);
  const Mat3 F{1.05, 0.03, 0, 0, 1.02, 0, 0, 0, 1.04};
  Sym6 s = free.move(F);
  const double J = determinant(F);
  EXPECT_NEAR((s[0] + s[1] + s[2]) / 3, m.bulk_modulus() * std::log(J) / J, 1e-6 * kCohesion);
  m.tension_strength = 3e3;
  Point cut(m);
  s = cut.move(F);
  EXPECT_NEAR((s[0] + s[1] + s[2]) / 3, 3e3, 1e-6);
}

TEST(DruckerPragerPoint, RefusesWhatTheConeDoesNotHave) {
  DruckerPrager m = soil(ConeMatch::plane_strain);
  m.tension_strength = 17321;
  try {
    validate(m, "slope");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("tension_strength of material 'slope': found 17321; allowed: at most "
                        "cohesion / tan(friction_angle) (17320.5"),
              std::string::npos)
        << error.what();
  }
  m.tension_strength = 17320;
  EXPECT_NO_THROW(validate(m, "slope"));
  m.dilatancy_angle = 31;
  EXPECT_THROW(validate(m, "slope"), Error);
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mohr-Coulomb's planes with Rankine's: one step from rest along the axes, in which the logarithmic strains are the
// trial, against closed forms and against the principle that an associated return obeys.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "solver/materials/law.hpp"

namespace scarp {
namespace {

constexpr double kPi = 3.14159265358979323846;

MohrCoulomb rock(double tension, double dilatancy = 0) { return {{2500, 10e9, 0.25}, 100e3, 30, dilatancy, tension}; }

/// s3 at which Mohr-Coulomb holds beside s1.
double least_beside(const MohrCoulomb& m, double s1) {
  const double s = std::sin(m.friction_angle * kPi / 180), c = std::cos(m.friction_angle * kPi / 180);
  return (s1 * (1 + s) - 2 * m.cohesion * c) / (1 - s);
}

struct Outcome {
  Vec3 tau, elastic, plastic;  ///< Kirchhoff stress; elastic and plastic logarithmic strain
  double J, work;
};

/// From rest to the logarithmic strains that the trial stresses `tau` (Kirchhoff, Pa) belong to.
Outcome after_trial(const MohrCoulomb& m, const Vec3& tau) {
  const double E = m.youngs_modulus, nu = m.poissons_ratio, sum = tau[0] + tau[1] + tau[2];
  Vec3 e;
  for (int k = 0; k < 3; ++k) e[k] = ((1 + nu) * tau[k] - nu * sum) / E;
  const Motion motion = make_motion(kIdentity, {std::exp(e[0]), 0, 0, 0, std::exp(e[1]), 0, 0, 0, std::exp(e[2])});
  PointHistory history;
  const Sym6 sigma = MohrCoulomb::Law(m).stress(motion, history);
  Outcome out{{}, {}, {}, motion.J, history.plastic_work};
  for (int k = 0; k < 3; ++k) {
    out.tau[k] = sigma[k] * motion.J;
    out.elastic[k] = 0.5 * std::log(history.elastic_left_cauchy_green[k]);
    out.plastic[k] = e[k] - out.elastic[k];
  }
  return out;
}

TEST(TensionCutOff, LimitsOneTwoOrThreePrincipalStresses) {
  const double t = 50e3, share = 1.0 / 3;  // nu / (1 - nu)
  const MohrCoulomb m = rock(t);
  {
    const Outcome o = after_trial(m, {80e3, 10e3, -20e3});
    EXPECT_NEAR(o.tau[0], t, 10);
    EXPECT_NEAR(o.tau[1], 10e3 - share * 30e3, 10);
    EXPECT_NEAR(o.tau[2], -20e3 - share * 30e3, 10);
    EXPECT_NEAR(o.plastic[1], 0, 1e-15);  // the crack opens across itself only
    EXPECT_NEAR(o.plastic[2], 0, 1e-15);
    EXPECT_NEAR(o.work, o.tau[0] * o.plastic[0], 1e-12 * t);
  }
  {
    const Outcome o = after_trial(m, {80e3, 75e3, -10e3});
    EXPECT_NEAR(o.tau[0], t, 10);
    EXPECT_NEAR(o.tau[1], t, 10);
    EXPECT_NEAR(o.tau[2], -10e3 - 0.25 * (30e3 + 25e3), 10);  // nu: plane stress increments
    EXPECT_NEAR(o.plastic[2], 0, 1e-15);
  }
  {
    const Outcome o = after_trial(m, {90e3, 80e3, 75e3});
    for (double s : o.tau) EXPECT_NEAR(s, t, 10);
  }
}

/// From a point of the line in which the planes meet, or of its ends, outwards by positive multipliers of the planes
/// that meet there: the return must end at the point that it came from.
TEST(TensionCutOff, MeetsMohrCoulombInALineAndItsEnds) {
  const double t = 50e3;
  for (double dilatancy : {0.0, 10.0, 30.0}) {
    const MohrCoulomb m = rock(t, dilatancy);
    const double low = least_beside(m, t), up = 1 + std::sin(dilatancy * kPi / 180), down = up - 2;
    const double lambda = m.lambda(), twice_G = 2 * m.shear_modulus();
    const auto stress_of = [&](const Vec3& e) {
      const double mean = lambda * (e[0] + e[1] + e[2]);
      return Vec3{twice_G * e[0] + mean, twice_G * e[1] + mean, twice_G * e[2] + mean};
    };
    struct Case {
      Vec3 end, plastic;
    };
    const double g = 1e-5;
    const Case cases[]{{{t, -20e3, low}, {(up + 2) * g, 0, down * g}},  // planes 13 and cut-off 1
                       {{t, -20e3, low}, {(3 * up + 0.1) * g, 0, 3 * down * g}},
                       {{t, t, low}, {(up + 2) * g, 2.1 * g, down * g}},                      // and cut-off 2
                       {{t, t, low}, {(up + 2) * g, (up + 1) * g, 2 * down * g}},             // and plane 23
                       {{t, low, low}, {(2 * up + 1) * g, 0.9 * down * g, 1.1 * down * g}}};  // and plane 12
    for (const Case& c : cases) {
      const Outcome o = after_trial(m, c.end + stress_of(c.plastic));
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(o.tau[k], c.end[k], 1e-3 * t) << dilatancy;  // J
        EXPECT_NEAR(o.plastic[k], c.plastic[k], 5e-3 * g);
      }
      EXPECT_NEAR(o.work, dot(o.tau, o.plastic), 1e-9 * t * g);
    }
  }
}

/// With associated flow a return is Moreau's: no admissible stress does more work on the plastic strain than the one it
/// ended at. Admissible stresses are drawn where it could fail: near that one, in any order of the axes, and on the
/// corners.
TEST(TensionCutOff, AssociatedReturnMaximisesDissipation) {
  std::mt19937_64 engine(3);
  const auto number = [&engine](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1.0p-53);
  };
  int on_line = 0, at_end = 0, cut_only = 0, planes_only = 0;
  for (int i = 0; i < 3000; ++i) {
    MohrCoulomb m = rock(number(0, 1) * 100e3, 30);
    m.poissons_ratio = number(-0.2, 0.45);
    const double size = std::pow(10.0, number(4.5, 6.3));
    const Outcome o = after_trial(m, {number(-1, 1) * size, number(-1, 1) * size, number(-1, 1) * size});
    if (o.work <= 0) continue;
    const double t = *m.tension_strength * o.J, low = least_beside(m, *m.tension_strength) * o.J;
    const auto f = [&](Vec3 s) {
      std::sort(s.begin(), s.end());
      return std::max(s[2] - t, (s[2] - s[0]) + (s[2] + s[0]) * 0.5 - 2 * m.cohesion * o.J * std::cos(kPi / 6));
    };
    Vec3 sorted = o.tau;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_LE(f(o.tau), 1e-6 * size);
    const bool cut = sorted[2] > t - 1, plane = sorted[0] < least_beside(m, sorted[2] / o.J) * o.J + 1;
    (cut && plane ? (sorted[1] > t - 1 || sorted[1] < low + 1 ? at_end : on_line) : cut ? cut_only : planes_only)++;
    const double scale = size * (std::abs(o.plastic[0]) + std::abs(o.plastic[1]) + std::abs(o.plastic[2]));
    const auto may_not_do_more = [&](const Vec3& s) {
      if (f(s) > 0) return;
      EXPECT_LE(dot(s - o.tau, o.plastic), 1e-9 * scale + 1e-15 * size) << i;
    };
    for (int k = 0; k < 200; ++k) {
      const double near = size * std::pow(10.0, number(-4, 0));
      may_not_do_more(o.tau + near * Vec3{number(-1, 1), number(-1, 1), number(-1, 1)});
    }
    const double in = 1e-9 * size;
    for (int k = 0; k < 3; ++k) {
      Vec3 two{t - in, t - in, t - in}, one{low + 3 * in, low + 3 * in, low + 3 * in};
      two[k] = low + 3 * in;
      one[k] = t - in;
      may_not_do_more(two);
      may_not_do_more(one);
    }
  }
  for (int count : {on_line, at_end, cut_only, planes_only}) EXPECT_GT(count, 40);
}

TEST(TensionCutOff, AboveTheStressesThereOrAtTheApexItChangesNothing) {
  const MohrCoulomb plain{{2500, 10e9, 0.25}, 100e3, 30, 10};
  MohrCoulomb cut = plain;
  cut.tension_strength = 173e3;  // the apex is 173205 Pa
  for (const Vec3& trial : {Vec3{150e3, 0, -500e3}, Vec3{-100e3, -150e3, -900e3}, Vec3{100e3, 90e3, -300e3}}) {
    const Outcome a = after_trial(plain, trial), b = after_trial(cut, trial);
    EXPECT_EQ(a.tau, b.tau);
    EXPECT_EQ(a.work, b.work);
  }
  const Outcome apex = after_trial(cut, {900e3, 800e3, 850e3});
  for (double s : apex.tau) EXPECT_NEAR(s, 173e3, 100);
}

TEST(TensionCutOff, AboveTheApexIsRefused) {
  EXPECT_NO_THROW(validate(rock(173e3), "rock"));
  EXPECT_THROW(validate(rock(174e3), "rock"), Error);
  EXPECT_THROW(validate(rock(-1), "rock"), Error);
  MohrCoulomb clay = rock(1e9);
  clay.friction_angle = 0;
  EXPECT_NO_THROW(validate(clay, "clay"));  // no apex
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The viscoplastic option of every law that has it: nothing changes without it, slow motion gives the rate-independent
// law, fast motion the elastic one, and overstress at a held strain dies exponentially.
#include "solver/materials/overstress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "solver/materials/law.hpp"
#include "tests/support/law_samples.hpp"

namespace scarp {
namespace {

constexpr double kTime = 0.01;

template <class M>
class Viscoplastic : public ::testing::Test {};
using Laws = ::testing::Types<VonMises, DruckerPrager, MohrCoulomb>;
TYPED_TEST_SUITE(Viscoplastic, Laws);

const Mat3 kSheared{0.998, 0.01, 0, 0, 0.999, 0.004, 0, 0, 0.996};

template <class M>
struct TimedPoint {
  explicit TimedPoint(M parameters, double time) : law((parameters.relaxation_time = time, parameters)) {}
  Sym6 step(const Mat3& next, double per_dt) {
    const Sym6 sigma = law.stress(make_motion(F, next, per_dt), history);
    F = next;
    return sigma;
  }
  typename M::Law law;
  PointHistory history;
  Mat3 F = kIdentity;
};

TYPED_TEST(Viscoplastic, WithoutTimeOrInfinitelySlowIsTheRateIndependentLaw) {
  for (const TypeParam& m : test::law_samples<TypeParam>()) {
    TimedPoint<TypeParam> none(m, 0), slow(m, kTime), plain(m, 0);
    for (int i = 1; i <= 20; ++i) {
      Mat3 next;
      for (int k = 0; k < 9; ++k) next[k] = kIdentity[k] + (kSheared[k] - kIdentity[k]) * i / 20;
      const Sym6 expected = plain.step(next, 0);
      EXPECT_EQ(none.step(next, 1e5), expected);
      EXPECT_EQ(slow.step(next, 0), expected);
      EXPECT_EQ(none.history.plastic_work, plain.history.plastic_work);
      EXPECT_EQ(slow.history.equivalent_plastic_strain, plain.history.equivalent_plastic_strain);
    }
  }
}

TYPED_TEST(Viscoplastic, InstantlyIsElastic) {
  for (const TypeParam& m : test::law_samples<TypeParam>()) {
    TimedPoint<TypeParam> fast(m, kTime);
    const Sym6 sigma = fast.step(kSheared, std::numeric_limits<double>::max());
    const Sym6 elastic = Hencky::Law(Hencky{static_cast<const ElasticParameters&>(m)})
                             .stress(make_motion(kIdentity, kSheared), fast.history);
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(sigma[k], elastic[k], 1e-12 * m.youngs_modulus);
    EXPECT_NEAR(fast.history.plastic_work, 0, 1e-14 * m.youngs_modulus);
  }
}

/// Perfectly plastic laws at a held strain: sigma(t) = sigma_inf + (sigma_0 - sigma_inf) exp(-t / T), whatever the
/// steps.
TYPED_TEST(Viscoplastic, OverstressDiesExponentiallyAtAHeldStrain) {
  for (const TypeParam& m : test::law_samples<TypeParam>()) {
    if constexpr (requires { m.softens(); }) {
      if (m.softens()) continue;
    }
    if constexpr (requires { m.hardening_modulus; }) {
      if (m.hardening_modulus > 0 || m.saturation_stress) continue;
    }
    TimedPoint<TypeParam> slow(m, kTime);
    const Sym6 end = slow.step(kSheared, 0);
    for (int steps : {1, 10, 100}) {
      TimedPoint<TypeParam> point(m, kTime);
      const Sym6 start = point.step(kSheared, std::numeric_limits<double>::max());
      const double dt = 3 * kTime / steps;
      for (int i = 1; i <= steps; ++i) {
        const Sym6 sigma = point.step(kSheared, 1 / dt);
        const double left = std::exp(-i * dt / kTime);
        for (int k = 0; k < 6; ++k)
          EXPECT_NEAR(sigma[k], end[k] + (start[k] - end[k]) * left, 1e-11 * m.youngs_modulus);
      }
    }
  }
}

/// At a steady rate the overstress is (elastic stiffness) (strain rate) T: of von Mises in simple shear, tau = k + G g
/// T.
TEST(ViscoplasticVonMises, OverstressOfASteadyRate) {
  const VonMises m{{1900, 20e6, 0.3}, 20e3};
  TimedPoint<VonMises> point(m, kTime);
  const double rate = 0.01, dt = 1e-4;
  Sym6 sigma{};
  for (int i = 1; i <= 5000; ++i) sigma = point.step({1, i * rate * dt, 0, 0, 1, 0, 0, 0, 1}, 1 / dt);
  const double left = std::exp(-dt / kTime);  // of the trial's overstress, at the end of a step
  EXPECT_NEAR(sigma[3], 20e3 / std::sqrt(3.0) + m.shear_modulus() * rate * dt * left / (1 - left), 5);
}

}  // namespace
}  // namespace scarp

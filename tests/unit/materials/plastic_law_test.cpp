// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the contract of law.hpp says of every law of Material that yields, beside law_test.cpp: the strength may depend
// on the plastic strain, and one large step must do what no law may refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <type_traits>

#include "solver/materials/law.hpp"
#include "tests/support/driven_point.hpp"
#include "tests/support/law_samples.hpp"

namespace scarp {
namespace {

template <class M>
inline constexpr bool yields = requires(const typename M::Law& law, const Sym6& s) {
  law.yield_function(s, PointHistory{});
};

template <class M>
inline constexpr bool purely_viscous = requires {
  requires M::Law::purely_viscous;
};

template <class Found, class... M>
struct Plastic {
  using type = Found;
};
template <class... Found, class First, class... Rest>
struct Plastic<::testing::Types<Found...>, First, Rest...> {
  using with = std::conditional_t<yields<First>, ::testing::Types<Found..., First>, ::testing::Types<Found...>>;
  using type = typename Plastic<with, Rest...>::type;
};
template <class V>
struct PlasticOf;
template <class... M>
struct PlasticOf<std::variant<M...>> {
  static_assert(((yields<M> || !M::Law::has_history || purely_viscous<M>)&&...),
                "a law with a history states its yield function, or that it has none");
  using type = typename Plastic<::testing::Types<>, M...>::type;
};

template <class M>
class PlasticLaw : public ::testing::Test {
 protected:
  double number(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
  }
  Mat3 gradient(double size) {
    Mat3 F = kIdentity;
    for (double& f : F) f += number(-size, size);
    return F;
  }
  /// 10^-4 to 10^-1: from a part of the elastic range to a hundred times what it holds.
  double any_size() { return std::pow(10.0, number(-4, -1)); }

 private:
  std::mt19937_64 engine_{11};
};
double largest(const Sym6& s) {
  double m = 0;
  for (double v : s) m = std::max(m, std::abs(v));
  return m;
}

/// Work of P along the straight path from I to `end`, by trapezoids, J/m3.
template <class Point>
double work_along(Point& point, const Mat3& end, int steps) {
  double work = 0;
  Mat3 P_old = first_piola(point.move(kIdentity), kIdentity);
  for (int i = 1; i <= steps; ++i) {
    Mat3 next;
    for (int k = 0; k < 9; ++k) next[k] = kIdentity[k] + (end[k] - kIdentity[k]) * i / steps;
    const Mat3 P = first_piola(point.move(next), make_motion(next, next).cofactor);
    for (int k = 0; k < 9; ++k) work += 0.5 * (P[k] + P_old[k]) * (end[k] - kIdentity[k]) / steps;
    P_old = P;
  }
  return work;
}
TYPED_TEST_SUITE(PlasticLaw, typename PlasticOf<Material>::type);

/// The stress lies within the surface of the strength that is left, and no step gives energy back.
TYPED_TEST(PlasticLaw, IsAdmissibleForTheStrengthThatIsLeftAndDissipates) {
  int plastic_steps = 0;
  for (const TypeParam& parameters : test::law_samples<TypeParam>()) {
    const double E = test::stiffness(parameters);
    for (int walk = 0; walk < 60; ++walk) {
      test::DrivenPoint<TypeParam> point(parameters);
      for (int step = 0; step < 40; ++step) {
        const Mat3 next = multiply(this->gradient(this->any_size()), point.F);
        if (determinant(next) < 0.3 || determinant(next) > 3) continue;
        const PointHistory before = point.history;
        const Sym6 sigma = point.move(next);
        const double a = point.history.equivalent_plastic_strain;
        ASSERT_GE(a, before.equivalent_plastic_strain);
        ASSERT_GE(point.history.plastic_work, before.plastic_work - 1e-14 * E);
        ASSERT_LE(point.law.yield_function(sigma, point.history), 1e-12 * (E + largest(sigma))) << walk << " " << step;
        plastic_steps += a > before.equivalent_plastic_strain;
      }
    }
  }
  EXPECT_GT(plastic_steps, 2000);
}

/// Softening that the elastic strain cannot follow falls within one step, however small, and what the fall sets free
/// is neither stored nor dissipated.
template <class M>
bool falls_abruptly(const M& m) {
  if constexpr (requires { m.softening_strain; }) return m.softening_strain && *m.softening_strain < 0.01;
  return false;
}

/// First law: the work of the stress is what is stored and what is dissipated. A backward Euler step dissipates the
/// work of its final stress, so that the gap halves with the step; in an abrupt fall no energy appears.
TYPED_TEST(PlasticLaw, WorkIsStoredOrDissipated) {
  for (const TypeParam& parameters : test::law_samples<TypeParam>()) {
    for (int path = 0; path < 6; ++path) {
      const Mat3 end = this->gradient(0.02);
      double gap[2], work = 0;
      for (int refined = 0; refined < 2; ++refined) {
        test::DrivenPoint<TypeParam> point(parameters);
        work = work_along(point, end, 200 << refined);
        gap[refined] =
            work - point.law.stored_energy(make_motion(end, end), point.history) - point.history.plastic_work;
      }
      const double rounding = 1e-9 * test::stiffness(parameters) + 1e-4 * std::abs(work);
      if (falls_abruptly(parameters)) {
        EXPECT_GE(gap[1], -4e-3 * std::abs(work) - rounding);
      } else {
        EXPECT_LE(std::abs(gap[1]), 4e-3 * std::abs(work) + rounding);
        EXPECT_LE(std::abs(gap[1]), 0.75 * std::abs(gap[0]) + rounding);
      }
    }
  }
}

/// One huge step and many small ones: finite, admissible, b_e positive.
TYPED_TEST(PlasticLaw, TakesAHugeStep) {
  for (const TypeParam& parameters : test::law_samples<TypeParam>()) {
    const double E = test::stiffness(parameters);
    for (int i = 0; i < 300; ++i) {
      const Mat3 F = this->gradient(0.7);
      if (determinant(F) < 0.05) continue;
      test::DrivenPoint<TypeParam> point(parameters);
      const Sym6 sigma = point.move(F);
      for (double s : sigma) ASSERT_TRUE(std::isfinite(s));
      ASSERT_LE(point.law.yield_function(sigma, point.history), 1e-11 * (E + largest(sigma)));
      ASSERT_GE(point.history.plastic_work, 0);
      ASSERT_TRUE(point.law.wave_speed_squared(make_motion(F, F), point.history) > 0);
    }
  }
}

}  // namespace
}  // namespace scarp

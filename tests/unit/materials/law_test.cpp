// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One harness over every alternative of Material: a new law is held to the contract of law.hpp by being in the
// variant and in law_samples.hpp.
#include "solver/materials/law.hpp"

#include <gtest/gtest.h>

#include <random>
#include <type_traits>

#include "solver/materials/symmetric_eigen.hpp"
#include "tests/support/law_samples.hpp"

namespace scarp {
namespace {

template <class V>
struct TypesOf;
template <class... M>
struct TypesOf<std::variant<M...>> {
  using type = ::testing::Types<M...>;
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
  }
  Mat3 matrix(double size) {
    Mat3 A;
    for (double& a : A) a = (*this)(-size, size);
    return A;
  }
  /// F near I, with entries of F - I up to `size`.
  Mat3 gradient(double size) {
    Mat3 F = matrix(size);
    for (int i = 0; i < 9; i += 4) F[i] += 1;
    return F;
  }
  Mat3 rotation() {
    Mat3 F = gradient(0.9);
    while (determinant(F) < 0.05) F = gradient(0.9);
    return polar_rotation(F);
  }

 private:
  std::mt19937_64 engine_;
};

Sym6 turned(const Mat3& Q, const Sym6& s) { return push_forward(Q, s); }
double largest(const Sym6& s) {
  double m = 0;
  for (double v : s) m = std::max(m, std::abs(v));
  return m;
}

template <class M>
class Law : public ::testing::Test {};
TYPED_TEST_SUITE(Law, TypesOf<Material>::type);

TYPED_TEST(Law, HasTheStatedStressAtRest) {
  for (const TypeParam& parameters : test::law_samples<TypeParam>()) {
    const typename TypeParam::Law law(parameters);
    PointHistory history;
    const Motion rest = make_motion(kIdentity, kIdentity);
    const Sym6 expected = rest_stress(Material(parameters)), sigma = law.stress(rest, history);
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(sigma[k], expected[k], 1e-15 * largest(expected));
    EXPECT_EQ(law.stored_energy(rest, history), 0);
    EXPECT_EQ(history.equivalent_plastic_strain, 0);
  }
}

TYPED_TEST(Law, IsObjective) {
  Random random(1);
  for (const TypeParam& parameters : test::law_samples<TypeParam>()) {
    const typename TypeParam::Law law(parameters);
    for (int i = 0; i < 200; ++i) {
      const Mat3 F1 = random.gradient(0.05), F2 = random.gradient(0.1), Q = random.rotation();
      if (determinant(F1) <= 0 || determinant(F2) <= 0) continue;
      PointHistory plain, rotated;
      law.stress(make_motion(kIdentity, F1), plain);
      law.stress(make_motion(kIdentity, F1), rotated);
      const Sym6 sigma = law.stress(make_motion(F1, F2), plain);
      const Sym6 sigma_turned = law.stress(make_motion(F1, multiply(Q, F2)), rotated);
      const Sym6 expected = turned(Q, sigma);
      for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(sigma_turned[k], expected[k], 1e-13 * test::stiffness(parameters) + 1e-12 * largest(sigma));
      EXPECT_NEAR(plain.plastic_work, rotated.plastic_work, 1e-13 * test::stiffness(parameters));
    }
  }
}

TYPED_TEST(Law, KeepsStressAndEnergyUnderPureRotation) {
  Random random(2);
  for (const TypeParam& parameters : test::law_samples<TypeParam>()) {
    const typename TypeParam::Law law(parameters);
    for (int i = 0; i < 50; ++i) {
      PointHistory history;
      const Motion turn = make_motion(kIdentity, random.rotation());
      const Sym6 expected = rest_stress(Material(parameters)), sigma = law.stress(turn, history);
      for (int k = 0; k < 6; ++k) EXPECT_NEAR(sigma[k], expected[k], 1e-14 * test::stiffness(parameters));
      EXPECT_NEAR(law.stored_energy(turn, history), 0, 1e-15 * test::stiffness(parameters));
    }
  }
}

TYPED_TEST(Law, StressIsTheDerivativeOfTheStoredEnergyWhereNothingDissipates) {
  Random random(3);
  int compared = 0;
  for (const TypeParam& parameters : test::law_samples<TypeParam>()) {
    const typename TypeParam::Law law(parameters);
    for (int i = 0; i < 60; ++i) {
      const double size = TypeParam::Law::has_history ? 2e-4 * (1 + i % 5) : 0.3;
      const Mat3 F = random.gradient(size);
      if (determinant(F) < 0.2) continue;
      PointHistory history;
      const Motion motion = make_motion(kIdentity, F);
      const Mat3 P = first_piola(law.stress(motion, history), motion.cofactor);
      if (history.plastic_work > 0 || history.equivalent_plastic_strain > 0) continue;
      ++compared;
      double scale = std::sqrt(square_norm(P));
      // Central differences: error step^2 W''' + rounding W eps / step.
      const double step = 1e-5;
      for (int k = 0; k < 9; ++k) {
        double W[2], bend = -2 * P[k];  // of the stress, over the difference: a law may have a kink there
        for (int side = 0; side < 2; ++side) {
          Mat3 moved = F;
          moved[k] += side ? step : -step;
          PointHistory fresh;
          const Motion m = make_motion(kIdentity, moved);
          // An elastic law's energy needs no history; one with history stays inside its yield surface, or is
          // not compared there.
          bend += first_piola(law.stress(m, fresh), m.cofactor)[k];
          W[side] = fresh.plastic_work > 0 ? NAN : law.stored_energy(m, fresh);
        }
        if (std::isnan(W[0]) || std::isnan(W[1])) continue;
        EXPECT_NEAR((W[1] - W[0]) / (2 * step), P[k],
                    1e-6 * scale + 1e-8 * test::stiffness(parameters) + std::abs(bend));
      }
    }
  }
  EXPECT_GT(compared, 20);
}

TYPED_TEST(Law, NeverGivesDissipatedEnergyBackAndStaysAdmissible) {
  Random random(4);
  for (const TypeParam& parameters : test::law_samples<TypeParam>()) {
    const typename TypeParam::Law law(parameters);
    for (int walk = 0; walk < 40; ++walk) {
      PointHistory history;
      Mat3 F = kIdentity;
      const double size = walk % 2 ? 0.02 : 0.001;
      for (int step = 0; step < 60; ++step) {
        const Mat3 next = multiply(random.gradient(size), F);
        if (determinant(next) < 0.3 || determinant(next) > 3) continue;
        const PointHistory before = history;
        const Sym6 sigma = law.stress(make_motion(F, next), history);
        F = next;
        ASSERT_GE(history.plastic_work, before.plastic_work - 1e-14 * test::stiffness(parameters));
        ASSERT_GE(history.equivalent_plastic_strain, before.equivalent_plastic_strain);
        for (double s : sigma) ASSERT_TRUE(std::isfinite(s));
        if constexpr (requires { law.yield_function(sigma, history); }) {
          ASSERT_LE(law.yield_function(sigma, history), 1e-12 * (test::stiffness(parameters) + largest(sigma)))
              << walk << " " << step;
        }
      }
    }
  }
}

/// (m x N) : dP/dF : (m x N) by central differences, elastically from the state (F, history).
template <class L>
double acoustic(const L& law, const Mat3& F, const PointHistory& history, const Vec3& m, const Vec3& N) {
  const double step = 1e-5;
  double work[2];
  for (int side = 0; side < 2; ++side) {
    Mat3 moved = F;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) moved[3 * i + j] += (side ? step : -step) * m[i] * N[j];
    PointHistory copy = history;
    const Motion motion = make_motion(F, moved);
    const Mat3 P = first_piola(law.stress(motion, copy), motion.cofactor);
    if (copy.plastic_work > history.plastic_work) return 0;  // softer than elastic
    work[side] = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) work[side] += P[3 * i + j] * m[i] * N[j];
  }
  return (work[1] - work[0]) / (2 * step);
}

TYPED_TEST(Law, BoundsTheWaveSpeed) {
  Random random(5);
  const auto unit = [&random] {
    Vec3 v{random(-1, 1), random(-1, 1), random(-1, 1)};
    return (1 / norm(v)) * v;
  };
  for (TypeParam parameters : test::law_samples<TypeParam>()) {
    if constexpr (requires { parameters.cohesion; }) parameters.cohesion = test::stiffness(parameters);  // stay elastic
    const typename TypeParam::Law law(parameters);
    const Motion rest = make_motion(kIdentity, kIdentity);
    EXPECT_GE(law.wave_speed_squared(rest, {}), (1 - 1e-12) * std::pow(parameters.wave_speed(), 2));
    bool auxetic = false;  // where a bound may be above the exact speed at rest
    if constexpr (requires { parameters.poissons_ratio; }) auxetic = parameters.poissons_ratio < 0;
    if (!auxetic) {
      EXPECT_NEAR(std::sqrt(law.wave_speed_squared(rest, {})), parameters.wave_speed(),
                  1e-12 * parameters.wave_speed());
    }
    for (int i = 0; i < 400; ++i) {
      const Mat3 F = random.gradient(TypeParam::Law::has_history ? 0.12 : i % 2 ? 0.3 : 0.6);
      if (determinant(F) < 0.1) continue;
      PointHistory history;
      const Motion motion = make_motion(kIdentity, F);
      law.stress(motion, history);
      const double bound = parameters.density * law.wave_speed_squared(motion, history);
      for (int k = 0; k < 30; ++k) {
        Vec3 m = unit();
        const Vec3 N = unit();
        if (k % 2) {  // the stiff direction: along F^-T N
          const Mat3& c = motion.cofactor;
          m = {c[0] * N[0] + c[1] * N[1] + c[2] * N[2], c[3] * N[0] + c[4] * N[1] + c[5] * N[2],
               c[6] * N[0] + c[7] * N[1] + c[8] * N[2]};
          m = (1 / norm(m)) * m;
        }
        EXPECT_LE(acoustic(law, F, history, m, N), (1 + 1e-6) * bound);
      }
    }
  }
}

TYPED_TEST(Law, ValidatesItsRanges) {
  for (TypeParam parameters : test::law_samples<TypeParam>()) {
    EXPECT_NO_THROW(validate(parameters, "m"));
    TypeParam wrong = parameters;
    wrong.density = -1900;
    try {
      validate(wrong, "soil");
      FAIL();
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "density of material 'soil': found -1900; allowed: above 0 kg/m3");
    }
    wrong.density = NAN;
    EXPECT_THROW(validate(wrong, "m"), Error);
    if constexpr (requires { parameters.poissons_ratio; }) {
      wrong = parameters;
      wrong.poissons_ratio = 0.5;
      EXPECT_THROW(validate(wrong, "m"), Error);
      wrong.poissons_ratio = NAN;
      EXPECT_THROW(validate(wrong, "m"), Error);
    }
  }
}

TEST(MotionBound, IsAboveTheLeastStretchAndTightInUniaxialStrainAndShear) {
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const Motion motion = make_motion(kIdentity, random.gradient(0.7));
    if (motion.J < 0.01) continue;
    const Vec3 b = symmetric_eigen(left_product(motion.F)).values;
    const double exact = 1 / std::min({b[0], b[1], b[2]});
    EXPECT_GE(inverse_square_of_least_stretch(motion), (1 - 1e-9) * exact);
    EXPECT_LE(inverse_square_of_least_stretch(motion), 1.34 * exact);  // worst: two stretches equal and least
  }
  EXPECT_NEAR(inverse_square_of_least_stretch(make_motion(kIdentity, {0.5, 0, 0, 0, 1, 0, 0, 0, 1})), 4, 1e-12);
  const double largest_of_shear_5 = 0.5 * (27 + std::sqrt(27.0 * 27 - 4));
  EXPECT_NEAR(inverse_square_of_least_stretch(make_motion(kIdentity, {1, 5, 0, 0, 1, 0, 0, 0, 1})), largest_of_shear_5,
              0.01 * largest_of_shear_5);
}

TEST(SymmetricEigenTest, RebuildsTheTensorAlsoAtEqualEigenvalues) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Mat3 Q = random.rotation();
    const double gap = std::pow(10.0, random(-17, 1));
    const Vec3 values{1, 1 + gap, i % 3 ? 1 + random(-1, 1) * gap : 1.0};
    const Sym6 A = push_forward(Q, {values[0], values[1], values[2], 0, 0, 0});
    const SymmetricEigen e = symmetric_eigen(A);
    const double scale = 3 + 2 * gap;
    const Sym6 again = push_forward(e.vectors, {e.values[0], e.values[1], e.values[2], 0, 0, 0});
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(again[k], A[k], 3e-15 * scale);
    const Sym6 unit = left_product(e.vectors);
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(unit[k], k < 3 ? 1 : 0, 3e-15);
  }
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "solver/kernels/choose_kernels.hpp"
#include "solver/model/error.hpp"

namespace scarp::kernels {
namespace {

/// Distance in units of the last place of `expected`.
double ulps(double got, long double expected) {
  const double rounded = static_cast<double>(expected);
  return static_cast<double>(std::abs(got - expected) /
                             (std::nextafter(std::abs(rounded), INFINITY) - std::abs(rounded)));
}

std::vector<double> arguments_of_log() {
  std::vector<double> x{1, 0.5, 2, 1e-300, 1e300, 2.2250738585072014e-308, 1.7976931348623157e308, std::sqrt(0.5)};
  for (int i = 1; i < 20000; ++i) {
    x.push_back(i * 1e-4);
    x.push_back(1 + std::ldexp(i - 10000, -40));
    x.push_back(std::exp(0.07 * (i - 10000)));
  }
  return x;
}

TEST(VectorMath, LogarithmAndExponentialAreWithinTwoUnitsOfTheLastPlace) {
  for (const Kernels& kernels : available_kernels()) {
    double worst_log = 0, worst_exp = 0;
    std::vector<double> x = arguments_of_log();
    x.resize((x.size() + 7) / 8 * 8, 1.0);
    std::vector<double> y(x.size());
    kernels.natural_log(x.data(), y.data(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      worst_log =
          std::max(worst_log, x[i] == 1 ? std::abs(y[i]) : ulps(y[i], std::log(static_cast<long double>(x[i]))));
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = -700 + 1400.0 * static_cast<double>(i) / static_cast<double>(x.size());
    kernels.exponential(x.data(), y.data(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      worst_exp = std::max(worst_exp, ulps(y[i], std::exp(static_cast<long double>(x[i]))));
    std::printf("%s: log %.2f, exp %.2f units of the last place\n", kernels.name, worst_log, worst_exp);
    EXPECT_LT(worst_log, 2);
    EXPECT_LT(worst_exp, 2);
  }
}

TEST(VectorMath, InverseRootsAreWithinTwoUnitsOfTheLastPlace) {
  std::vector<double> x{0, 1e-281, 1e-280, 1e300, 1, 2, 0.25, 1e-16};
  for (int i = 0; i < 20000; ++i) x.push_back(std::exp(0.03 * (i - 10000)));
  std::vector<double> y(x.size());
  for (const Kernels& kernels : available_kernels()) {
    kernels.inverse_root(x.data(), y.data(), x.size());
    EXPECT_EQ(y[0], 0) << kernels.name;
    EXPECT_EQ(y[1], 0) << kernels.name;
    for (std::size_t i = 2; i < x.size(); ++i)
      EXPECT_LT(ulps(y[i], 1 / std::sqrt(static_cast<long double>(x[i]))), 2) << kernels.name << ", " << x[i];
  }
}

using Principal = std::array<long double, 3>;

/// Sum of value[k] n_k n_k^T of an orthonormal triad that goes with `seed`; in 2D turned about z alone.
std::array<long double, 6> compose(const Principal& value, int dimension, int seed) {
  const long double a = 0.7L * seed, b = dimension == 2 ? 0 : 1.3L * seed, c = dimension == 2 ? 0 : 0.4L * seed;
  const long double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b), cc = std::cos(c),
                    sc = std::sin(c);
  const long double Q[3][3] = {{ca * cb, ca * sb * sc - sa * cc, ca * sb * cc + sa * sc},
                               {sa * cb, sa * sb * sc + ca * cc, sa * sb * cc - ca * sc},
                               {-sb, cb * sc, cb * cc}};
  constexpr int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  std::array<long double, 6> s{};
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 3; ++k) s[i] += value[k] * Q[row[i]][k] * Q[column[i]][k];
  return s;
}

/// The largest error of f over tensors of norm `size` or somewhat less, with eigenvalues that meet, nearly or not.
template <class F>
double tensor_error(void (*kernel)(const double*, double*), int dimension, double size, F&& f) {
  const Principal shapes[] = {{1, 0, 0},          {-1, 0, 0},      {1, 1, 1},
                              {-1, -1, -1},       {1, -1, 0},      {1, 1, -2},
                              {-1, -1, 2},        {0.3L, 0.2L, 1}, {1, 1 - 1e-9L, -0.5L},
                              {1, 1e-5L, -1e-5L}, {1, 0, -1e-12L}, {0.5L, 0.5L + 1e-15L, 0.2L}};
  double worst = 0;
  for (const Principal& shape : shapes)
    for (int seed = 0; seed < 20; ++seed) {
      const long double norm = std::sqrt(shape[0] * shape[0] + shape[1] * shape[1] + shape[2] * shape[2]);
      double A[6 * kSegment], result[6 * kSegment];
      std::array<long double, 6> expected[kSegment];
      for (int lane = 0; lane < kSegment; ++lane) {
        Principal value, image;
        for (int k = 0; k < 3; ++k) {
          value[k] = size * shape[k] / norm * (1 - 0.1L * lane);
          image[k] = f(value[k]);
        }
        const auto s = compose(value, dimension, seed * kSegment + lane);
        expected[lane] = compose(image, dimension, seed * kSegment + lane);
        for (int i = 0, entry = 0; i < 6; ++i)
          if (dimension == 3 || i < 4) A[entry++ * kSegment + lane] = static_cast<double>(s[i]);
      }
      kernel(A, result);
      for (int lane = 0; lane < kSegment; ++lane)
        for (int i = 0; i < (dimension == 3 ? 6 : 4); ++i)
          worst = std::max(worst, static_cast<double>(std::abs(result[i * kSegment + lane] - expected[lane][i])));
    }
  return worst;
}

TEST(VectorMath, FunctionsOfTensorsAreExactToTheRoundingOfTheirArguments) {
  const auto log = [](long double x) { return std::log1p(x) / 2; };
  const auto exp = [](long double x) { return std::expm1(2 * x); };
  for (const Kernels& kernels : available_kernels())
    for (int dimension : {2, 3})
      for (double size : {1e-300, 1e-12, 1e-5, 1e-3, 0.02, 0.0629, 0.1, 0.2, 0.349, 0.36, 0.5, 0.8}) {
        const double log_error = tensor_error(kernels.half_log[dimension - 2], dimension, size, log),
                     exp_error = tensor_error(kernels.exp_twice[dimension - 2], dimension, size, exp);
        SCOPED_TRACE(std::string(kernels.name) + ", norm " + std::to_string(size));
        EXPECT_LT(log_error, 2e-17 + 1e-15 * size);
        EXPECT_LT(exp_error, 2e-17 + 2e-15 * size * std::exp(2 * size));
      }
}

TEST(Kernels, OneIsAlwaysThereAndAStrangeNameIsRefused) {
  ASSERT_FALSE(available_kernels().empty());
  for (const Kernels& kernels : available_kernels()) EXPECT_EQ(&kernels_named(kernels.name), &kernels);
  try {
    kernels_named("sparc");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(best_kernels().name), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scarp::kernels

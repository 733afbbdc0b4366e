// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

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

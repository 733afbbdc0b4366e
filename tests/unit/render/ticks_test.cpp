// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/ticks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scarp {
namespace {

TEST(Ticks, StepsAreOneTwoFive) {
  EXPECT_DOUBLE_EQ(nice_step(0.9), 1);
  EXPECT_DOUBLE_EQ(nice_step(1.1), 2);
  EXPECT_DOUBLE_EQ(nice_step(3e-4), 5e-4);
  EXPECT_DOUBLE_EQ(nice_step(70), 100);
}

TEST(Ticks, LieWithinTheRangeAndAreFewEnough) {
  for (const auto& [low, high] : {std::pair{0.0, 9.37}, {-142.0, 0.0}, {1899.5, 1900.25}, {1e-9, 3e-9}, {-3.0, 1e6}}) {
    const Ticks ticks = nice_ticks(low, high, 8);
    ASSERT_GE(ticks.values.size(), 2u);
    EXPECT_LE(ticks.values.size(), 8u);
    for (double v : ticks.values) {
      EXPECT_GE(v, low - 1e-6 * ticks.step);
      EXPECT_LE(v, high + 1e-6 * ticks.step);
      EXPECT_NEAR(std::stod(format_number(std::abs(v), ticks.decimals)), std::abs(v), 1e-6 * ticks.step);
    }
  }
}

TEST(Ticks, RoundsOutwardsByLittle) {
  const auto [low, high] = round_outwards(0.02, 9.37);
  EXPECT_DOUBLE_EQ(low, 0);
  EXPECT_DOUBLE_EQ(high, 9.5);
  const auto same = round_outwards(0, 10);
  EXPECT_DOUBLE_EQ(same.first, 0);
  EXPECT_DOUBLE_EQ(same.second, 10);
}

TEST(DisplayUnit, PicksThePrefixByTheRange) {
  EXPECT_EQ(display_unit("m", 12).symbol, "m");
  EXPECT_EQ(display_unit("m", 0.4).symbol, "cm");
  EXPECT_EQ(display_unit("m", 0.035).symbol, "mm");
  EXPECT_DOUBLE_EQ(0.035 * display_unit("m", 0.035).factor, 35);
  EXPECT_EQ(display_unit("Pa", 900).symbol, "Pa");
  EXPECT_EQ(display_unit("Pa", 150e3).symbol, "kPa");
  EXPECT_EQ(display_unit("Pa", 2e6).symbol, "MPa");
  EXPECT_EQ(display_unit("kg/m3", 1900).symbol, "kg/m³");
  EXPECT_EQ(display_unit("1", 0.4).symbol, "");
  EXPECT_EQ(display_unit("1", 4e-6).symbol, "×10⁻⁶");
  EXPECT_DOUBLE_EQ(4e-6 * display_unit("1", 4e-6).factor, 4);
}

TEST(Numbers, HaveATrueMinusAndNoMinusZero) {
  EXPECT_EQ(format_number(-1.5, 1), "−1.5");
  EXPECT_EQ(format_number(-0.001, 1), "0.0");
  EXPECT_EQ(format_three_digits(8.314), "8.31");
  EXPECT_EQ(format_three_digits(-1234.5), "−1234");
  EXPECT_EQ(format_three_digits(0), "0");
  EXPECT_EQ(format_three_digits(1.234e-7), "1.23×10⁻⁷");
}

}  // namespace
}  // namespace scarp

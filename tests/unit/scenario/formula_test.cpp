// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

TEST(Formula, IsEvaluatedInTheSitesCoordinates) {
  const Field field = compile_field("f", {"X + 2 * Y^2", "sin(pi * t) + ln(exp(Z))", "t > 1 ? 5 : -5"}, {100, 0, 7});
  const Vec3 value = field({1, 3, 4}, 0.25);
  EXPECT_DOUBLE_EQ(value[0], 101 + 18);
  EXPECT_DOUBLE_EQ(value[1], std::sin(std::numbers::pi / 4) + 11);
  EXPECT_EQ(value[2], -5);
  EXPECT_EQ(field({0, 0, 0}, 2)[2], 5);
}

TEST(Formula, OfOneAxisLessLeavesZero) {
  const Field field = compile_field("f", {"1", "2"}, {0, 0, 0});
  EXPECT_EQ(field({1, 3, 4}, 0.25), (Vec3{1, 2, 0}));
}

TEST(Formula, MistakesAreNamed) {
  for (const char* wrong : {"", "X +", "sine(X)", "x", "(X", "X, Y", "X = 3", "\"text\""}) {
    EXPECT_FALSE(mistake_in_formula(wrong).empty()) << wrong;
    EXPECT_THROW(compile_field("f", {wrong}, {0, 0, 0}), Error) << wrong;
  }
  EXPECT_TRUE(mistake_in_formula("1 / X").empty());
}

TEST(Formula, WithoutAFiniteValueIsRefusedWhereItHasNone) {
  const Field field = compile_field("solver.body_force", {"1 / X", "sqrt(Y)"}, {0, 0, 0});
  EXPECT_EQ(field({2, 4, 0}, 0), (Vec3{0.5, 2, 0}));
  for (const Vec3& X : {Vec3{0, 1, 0}, Vec3{1, -1, 0}}) {
    try {
      field(X, 3);
      FAIL();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("solver.body_force has no finite value"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace scarp

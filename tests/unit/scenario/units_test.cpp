// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/units.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace scarp {
namespace {

struct Case {
  const char* text;
  const char* unit;
  double value;
};

TEST(Units, ConvertExactlyByPowersOfTen) {
  for (const Case& c : {Case{"10 MPa", "Pa", 1e7},
                        {"9.7 kPa", "Pa", 9700},
                        {"1.8 t/m3", "kg/m3", 1800},
                        {"5 mm", "m", 0.005},
                        {"0.1cm", "m", 0.001},
                        {"34 deg", "deg", 34},
                        {"34\u00b0", "deg", 34},
                        {"9.81 m/s^2", "m/s2", 9.81},
                        {"-9.81 m s^-2", "m/s2", -9.81},
                        {"+2.5e3 N/m\u00b2", "Pa", 2500},
                        {"2 J/m^3", "Pa", 2},
                        {"30 %", "", 0.3},
                        {"4 1/m2", "1/m2", 4},
                        {"10 Hz", "1/s", 10},
                        {"3 kg/(m s\u00b2)", "Pa", 3},
                        {"3 kN\u00b7m/m3", "Pa", 3000},
                        {"1 \u00b5m", "m", 1e-6},
                        {"1 bar", "Pa", 1e5},
                        {"7 g/cm3", "kg/m3", 7000}}) {
    const Conversion converted = convert_quantity(c.text, c.unit);
    EXPECT_EQ(converted.problem, "") << c.text;
    EXPECT_EQ(converted.value, c.value) << c.text;
  }
}

TEST(Units, ConvertByFactors) {
  for (const Case& c : {Case{"0.5 rad", "deg", 90 / std::numbers::pi},
                        {"36 km/h", "m/s", 10},
                        {"2 min", "s", 120},
                        {"10 ft", "m", 3.048},
                        {"3937 us-ft", "m", 1200},
                        {"1 psi", "Pa", 6894.757293168361},
                        {"1 lb/ft3", "kg/m3", 16.018463373960142}}) {
    const Conversion converted = convert_quantity(c.text, c.unit);
    EXPECT_EQ(converted.problem, "") << c.text;
    EXPECT_NEAR(converted.value, c.value, 1e-13 * c.value) << c.text;
  }
}

TEST(Units, SayWhatIsWrong) {
  EXPECT_EQ(convert_quantity("10 kg", "m").problem, "must be a length, not a mass");
  EXPECT_EQ(convert_quantity("18 kN/m3", "kg/m3").problem, "must be a density, not a weight per volume");
  EXPECT_EQ(convert_quantity("1 m", "").problem, "must be a pure number, not a length");
  EXPECT_EQ(convert_quantity("1 kg2", "m").problem, "must be a length, not a quantity in kg^2");
  EXPECT_EQ(convert_quantity("10 parsec", "m").problem, "has an unknown unit \"parsec\"");
  EXPECT_EQ(convert_quantity("10", "m").problem, "has no unit (a number without one stands without quotes)");
  EXPECT_EQ(convert_quantity("1e999 m", "m").problem, "is beyond the range of numbers");
  EXPECT_EQ(convert_quantity("1e308 Gm", "m").problem, "is beyond the range of numbers");
  for (const char* text : {"", " ", "m", "fast", "inf m", "nan m", "- m", "+-1 m", "--1 m", "e5 m"})
    EXPECT_EQ(convert_quantity(text, "m").problem, "must be a number, or a number and a unit") << text;
}

TEST(Units, RefuseWhatIsNoUnit) {
  for (const char* text : {"m/", "/s", "m//s", "m^", "m^0", "m^99", "m**s", "(m", "m)", "()", "kkg", "MM", "m^2^2",
                           "kmin", "1 1 x", "10", "0x10"})
    EXPECT_FALSE(parse_unit(text).has_value()) << text;
  EXPECT_FALSE(parse_unit(std::string(100, '(')).has_value());
}

}  // namespace
}  // namespace scarp

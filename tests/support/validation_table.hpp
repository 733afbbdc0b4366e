// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace scarp::test {

/// One row of the table that the validation tests print: quantity | expected | got | tolerance | why. Fails where
/// |got - expected| > tolerance.
inline void validate_near(const std::string& quantity, double expected, double got, double tolerance,
                          const std::string& why) {
  std::printf("| %s | %.6g | %.6g | %.2g | %s |\n", quantity.c_str(), expected, got, tolerance, why.c_str());
  EXPECT_NEAR(got, expected, tolerance) << quantity << ": " << why;
}

/// The same for a published band.
inline void validate_within(const std::string& quantity, double low, double high, double got, const std::string& why) {
  std::printf("| %s | %.4g to %.4g | %.6g | | %s |\n", quantity.c_str(), low, high, got, why.c_str());
  EXPECT_GE(got, low) << quantity << ": " << why;
  EXPECT_LE(got, high) << quantity << ": " << why;
}

}  // namespace scarp::test

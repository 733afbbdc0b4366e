// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace scarp::test {

/// Prints a row of the validation table, and writes it to the file that $SCARP_VALIDATION_ROWS names, if any: ctest
/// sets it, and tests/validation/table.py makes the table of it. The first row of a process begins the file anew.
inline void print_row(const std::string& row) {
  ASSERT_EQ(std::count(row.begin(), row.end(), '|'), 6) << "a cell holds a bar: " << row;
  static const char* const path = std::getenv("SCARP_VALIDATION_ROWS");
  static std::FILE* const file = path ? std::fopen(path, "w") : nullptr;
  std::printf("%s\n", row.c_str());
  if (!file) return;
  std::fprintf(file, "%s\n", row.c_str());
  std::fflush(file);
}

/// One row of the table that the validation tests print: quantity | expected | got | tolerance | why. Fails where
/// |got - expected| > tolerance. The quantity begins with the problem: "bar: period".
inline void validate_near(const std::string& quantity, double expected, double got, double tolerance,
                          const std::string& why) {
  char numbers[100];
  std::snprintf(numbers, sizeof numbers, "%.6g | %.6g | %.2g", expected, got, tolerance);
  print_row("| " + quantity + " | " + numbers + " | " + why + " |");
  EXPECT_NEAR(got, expected, tolerance) << quantity << ": " << why;
}

/// The same for a published band.
inline void validate_within(const std::string& quantity, double low, double high, double got, const std::string& why) {
  char numbers[100];
  std::snprintf(numbers, sizeof numbers, "%.4g to %.4g | %.6g |", low, high, got);
  print_row("| " + quantity + " | " + numbers + " | " + why + " |");
  EXPECT_GE(got, low) << quantity << ": " << why;
  EXPECT_LE(got, high) << quantity << ": " << why;
}

}  // namespace scarp::test

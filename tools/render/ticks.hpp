// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scarp {

/// Round numbers between two ends, for a colour bar or an axis.
struct Ticks {
  double step = 1;
  int decimals = 0;  ///< enough to write every tick exactly
  std::vector<double> values;
};

/// The smallest of 1, 2 or 5 times a power of ten that is not below `at_least` (> 0).
double nice_step(double at_least);

/// Multiples of a nice step in [low, high], at most `most` of them (at least 1 is asked for; low < high).
Ticks nice_ticks(double low, double high, int most);
/// Multiples of `step` (1, 2 or 5 times a power of ten) in [low, high].
Ticks nice_ticks(double low, double high, double step);

/// The ends of [low, high] moved outwards to round numbers, by at most a tenth of the span on each side.
std::pair<double, double> round_outwards(double low, double high);

/// How a quantity is written: shown value = SI value * factor.
struct DisplayUnit {
  std::string symbol;  ///< as printed ("kPa", "kg/m³"); empty when dimensionless
  double factor = 1;
};

/// Picks the prefix for which `largest` (a magnitude, SI) is easy to read: 0.035 m in mm, 2e6 Pa in MPa.
/// A magnitude that no prefix tames gets a power of ten ("×10⁻⁶").
DisplayUnit display_unit(const std::string& si_symbol, double largest);

/// Decimal text with a true minus sign and without "-0".
std::string format_number(double value, int decimals);

/// About three significant digits, for a single value in a text.
std::string format_three_digits(double value);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/ticks.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace scarp {
namespace {

int decimals_of(double step) { return std::clamp(-static_cast<int>(std::floor(std::log10(step) + 1e-9)), 0, 12); }

/// "m3" as it is printed: "m³".
std::string with_superscripts(const std::string& symbol) {
  std::string text;
  for (std::size_t i = 0; i < symbol.size(); ++i) {
    const bool exponent = i > 0 && std::isalpha(static_cast<unsigned char>(symbol[i - 1]));
    if (exponent && symbol[i] == '2')
      text += "²";
    else if (exponent && symbol[i] == '3')
      text += "³";
    else
      text += symbol[i];
  }
  return text;
}

std::string power_of_ten(int exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "×10";
  if (exponent < 0) text += "⁻";
  for (char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

struct Prefix {
  const char* text;
  double unit;
  double from;  ///< smallest magnitude, in the plain unit, that takes this prefix
};

/// Lengths have the centimetre; velocities too. Falling order.
constexpr Prefix kLength[] = {{"k", 1e3, 2e4}, {"", 1, 1}, {"c", 1e-2, 0.1}, {"m", 1e-3, 1e-3}, {"µ", 1e-6, 1e-6}};
constexpr Prefix kThousands[] = {{"G", 1e9, 1e9}, {"M", 1e6, 1e6}, {"k", 1e3, 1e3}, {"", 1, 1}, {"m", 1e-3, 1e-3}};

template <std::size_t n>
const Prefix* pick(const Prefix (&prefixes)[n], double largest) {
  for (const Prefix& p : prefixes)
    if (largest >= p.from) return &p;
  return nullptr;
}

const Prefix* prefix_for(const std::string& symbol, double largest) {
  if (symbol == "m" || symbol == "m/s") return pick(kLength, largest);
  if (symbol == "Pa" || symbol == "J" || symbol == "N" || symbol == "J/m3") return pick(kThousands, largest);
  if (symbol == "s" && largest < 1) return pick(kThousands, largest);
  return nullptr;
}

}  // namespace

double nice_step(double at_least) {
  const double power = std::pow(10.0, std::floor(std::log10(at_least)));
  for (double m : {1.0, 2.0, 5.0, 10.0})
    if (m * power >= at_least * (1 - 1e-9)) return m * power;
  return 10 * power;
}

Ticks nice_ticks(double low, double high, double step) {
  Ticks ticks{step, decimals_of(step), {}};
  const double first = std::ceil(low / step - 1e-6), last = std::floor(high / step + 1e-6);
  for (double k = first; k <= last; ++k) ticks.values.push_back(k == 0 ? 0.0 : k * step);
  return ticks;
}

Ticks nice_ticks(double low, double high, int most) {
  double step = nice_step((high - low) / std::max(1, most));
  Ticks ticks = nice_ticks(low, high, step);
  while (static_cast<int>(ticks.values.size()) > std::max(1, most)) {
    step = nice_step(step * 1.5);
    ticks = nice_ticks(low, high, step);
  }
  return ticks;
}

std::pair<double, double> round_outwards(double low, double high) {
  const double step = nice_step((high - low) / 20);
  return {std::floor(low / step + 1e-6) * step, std::ceil(high / step - 1e-6) * step};
}

DisplayUnit display_unit(const std::string& si_symbol, double largest) {
  const std::string symbol = si_symbol == "1" ? "" : with_superscripts(si_symbol);
  if (!(largest > 0) || !std::isfinite(largest)) return {symbol, 1};
  // A value that rounding left a hair below a power of ten belongs to it.
  const double magnitude = largest * (1 + 1e-9);
  if (const Prefix* p = prefix_for(si_symbol, magnitude); p && magnitude / p->unit < 1e5)
    return {p->text + symbol, 1 / p->unit};
  if (magnitude >= 1e-3 && magnitude < 1e5) return {symbol, 1};
  const int exponent = static_cast<int>(std::floor(std::log10(magnitude)));
  return {symbol.empty() ? power_of_ten(exponent) : power_of_ten(exponent) + " " + symbol, std::pow(10.0, -exponent)};
}

std::string format_number(double value, int decimals) {
  char buffer[400];  // the longest double takes 309 digits before the point
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, std::abs(value), std::chars_format::fixed,
                                 std::clamp(decimals, 0, 20));
  const std::string digits(buffer, end.ptr);
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  return value < 0 && !zero ? "−" + digits : digits;
}

std::string format_three_digits(double value) {
  const double magnitude = std::abs(value);
  if (!(magnitude > 0)) return "0";
  if (magnitude >= 1e6 || magnitude < 1e-4) {
    const int exponent = static_cast<int>(std::floor(std::log10(magnitude)));
    return format_number(value / std::pow(10.0, exponent), 2) + power_of_ten(exponent);
  }
  return format_number(value, std::clamp(2 - static_cast<int>(std::floor(std::log10(magnitude))), 0, 6));
}

}  // namespace scarp

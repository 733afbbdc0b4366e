// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

namespace scarp {
namespace {

struct Symbol {
  std::string_view text;
  Unit unit;
  bool prefixes = false;
};

constexpr Dimension kMass{1, 0, 0, 0}, kLength{0, 1, 0, 0}, kTime{0, 0, 1, 0}, kAngle{0, 0, 0, 1};
constexpr Dimension kForce{1, 1, -2, 0}, kPressure{1, -1, -2, 0}, kEnergy{1, 2, -2, 0}, kPower{1, 2, -3, 0};

// Exact by definition: foot 0.3048 m, US survey foot 1200/3937 m, pound-force per square inch 6894.757... Pa.
constexpr std::array<Symbol, 24> kSymbols{{
    {"m", {kLength, 1, 0}, true},
    {"g", {kMass, 1, -3}, true},
    {"s", {kTime, 1, 0}, true},
    {"t", {kMass, 1, 3}, true},
    {"N", {kForce, 1, 0}, true},
    {"Pa", {kPressure, 1, 0}, true},
    {"bar", {kPressure, 1, 5}, true},
    {"J", {kEnergy, 1, 0}, true},
    {"W", {kPower, 1, 0}, true},
    {"Hz", {{0, 0, -1, 0}, 1, 0}, true},
    {"min", {kTime, 60, 0}},
    {"h", {kTime, 3600, 0}},
    {"d", {kTime, 86400, 0}},
    {"deg", {kAngle, 1, 0}},
    {"\u00b0", {kAngle, 1, 0}},
    {"rad", {kAngle, 180 / std::numbers::pi, 0}},
    {"ft", {kLength, 0.3048, 0}},
    {"us-ft", {kLength, 1200.0 / 3937.0, 0}},
    {"in", {kLength, 0.0254, 0}},
    {"lb", {kMass, 0.45359237, 0}},
    {"lbf", {kForce, 4.4482216152605, 0}},
    {"psi", {kPressure, 4.4482216152605 / (0.0254 * 0.0254), 0}},
    {"ksi", {kPressure, 4.4482216152605 / (0.0254 * 0.0254), 3}},
    {"%", {{}, 1, -2}},
}};

constexpr std::array<std::pair<std::string_view, int>, 10> kPrefixes{{{"n", -9},
                                                                      {"u", -6},
                                                                      {"\u00b5", -6},
                                                                      {"\u03bc", -6},
                                                                      {"m", -3},
                                                                      {"c", -2},
                                                                      {"d", -1},
                                                                      {"k", 3},
                                                                      {"M", 6},
                                                                      {"G", 9}}};

constexpr std::array<std::pair<Dimension, std::string_view>, 18> kNames{{
    {{}, "a pure number"},
    {kMass, "a mass"},
    {kLength, "a length"},
    {kTime, "a time"},
    {kAngle, "an angle"},
    {kForce, "a force"},
    {kPressure, "a pressure"},
    {kEnergy, "an energy"},
    {kPower, "a power"},
    {{0, 2, 0, 0}, "an area"},
    {{0, 3, 0, 0}, "a volume"},
    {{0, 1, -1, 0}, "a velocity"},
    {{0, 1, -2, 0}, "an acceleration"},
    {{0, 0, -1, 0}, "a frequency"},
    {{1, -3, 0, 0}, "a density"},
    {{1, -2, -2, 0}, "a weight per volume"},
    {{1, -1, -1, 0}, "a viscosity"},
    {{0, -2, 0, 0}, "a number per area"},
}};

std::optional<Unit> unit_of_symbol(std::string_view text) {
  for (const Symbol& symbol : kSymbols)
    if (symbol.text == text) return symbol.unit;
  for (const auto& [prefix, power] : kPrefixes) {
    if (!text.starts_with(prefix)) continue;
    for (const Symbol& symbol : kSymbols)
      if (symbol.prefixes && symbol.text == text.substr(prefix.size())) {
        Unit unit = symbol.unit;
        unit.power_of_ten += power;
        return unit;
      }
  }
  return std::nullopt;
}

Unit times_power(Unit a, const Unit& b, int n) {
  a.dimension.mass += n * b.dimension.mass;
  a.dimension.length += n * b.dimension.length;
  a.dimension.time += n * b.dimension.time;
  a.dimension.angle += n * b.dimension.angle;
  if (b.factor != 1) a.factor *= std::pow(b.factor, n);
  a.power_of_ten += n * b.power_of_ten;
  return a;
}

/// Recursive descent over: product = power { ("*" | "." | " " | "/") power }.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  std::optional<Unit> whole() {
    const auto unit = product();
    return unit && at_ == text_.size() ? unit : std::nullopt;
  }

 private:
  bool take(std::string_view token) {
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }
  void skip_blanks() {
    while (take(" ")) {
    }
  }

  std::optional<Unit> product() {
    Unit unit;
    int sign = 1;
    while (true) {
      skip_blanks();
      const auto factor = power();
      if (!factor) return std::nullopt;
      unit = times_power(unit, *factor, sign);
      const std::size_t end_of_factor = at_;
      skip_blanks();
      if (at_ == text_.size() || text_[at_] == ')') return unit;
      sign = 1;
      if (take("/"))
        sign = -1;
      else if (!take("*") && !take(".") && !take("\u00b7") && at_ == end_of_factor)
        return std::nullopt;
    }
  }

  std::optional<Unit> power() {
    std::optional<Unit> base;
    if (take("(")) {
      base = product();
      if (!base || !take(")")) return std::nullopt;
    } else {
      base = symbol();
    }
    if (!base) return std::nullopt;
    const auto n = exponent();
    return n ? std::optional(times_power(Unit{}, *base, *n)) : std::nullopt;
  }

  std::optional<Unit> symbol() {
    if (take("1")) return Unit{};
    const std::size_t first = at_;
    while (at_ < text_.size() && !is_end_of_symbol()) ++at_;
    return unit_of_symbol(text_.substr(first, at_ - first));
  }
  bool is_end_of_symbol() const {
    const std::string_view rest = text_.substr(at_);
    return std::string_view(" */.^()0123456789").find(rest[0]) != std::string_view::npos ||
           rest.starts_with("\u00b2") || rest.starts_with("\u00b3") || rest.starts_with("\u00b7");
  }

  std::optional<int> exponent() {
    if (take("\u00b2")) return 2;
    if (take("\u00b3")) return 3;
    const bool marked = take("^");
    int n = 1;
    const auto [end, code] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), n);
    const bool found = code == std::errc() && end != text_.data() + at_;
    if (!found) return marked ? std::nullopt : std::optional(1);
    at_ = static_cast<std::size_t>(end - text_.data());
    return n != 0 && std::abs(n) <= 9 ? std::optional(n) : std::nullopt;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Splits "1.8e3 t/m3" into its decimal digits, its exponent and its unit.
struct Split {
  std::string digits;
  int exponent = 0;
  std::string_view unit;
};

std::optional<Split> split_quantity(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return std::nullopt;
  text.remove_prefix(first);
  const bool plus = text.starts_with('+');
  if (plus) text.remove_prefix(1);
  double ignored = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), ignored);
  const std::string_view number = text.substr(0, static_cast<std::size_t>(end - text.data()));
  if (number.find_first_of("0123456789") == std::string_view::npos || (plus && number.starts_with('-')))
    return std::nullopt;
  Split split;
  const std::size_t e = number.find_first_of("eE");
  split.digits = number.substr(0, e);
  if (e != std::string_view::npos) {
    std::string_view power = number.substr(e + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    if (std::from_chars(power.data(), power.data() + power.size(), split.exponent).ec != std::errc() ||
        std::abs(split.exponent) > 1000)
      return std::nullopt;
  }
  std::string_view unit = text.substr(number.size());
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  while (unit.ends_with(' ')) unit.remove_suffix(1);
  split.unit = unit;
  return split;
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  constexpr std::size_t kLongest = 64;  // bounds the recursion over parentheses
  if (text.size() > kLongest) return std::nullopt;
  if (text.empty()) return Unit{};
  return UnitParser(text).whole();
}

std::string name_of_dimension(const Dimension& dimension) {
  for (const auto& [known, name] : kNames)
    if (known == dimension) return std::string(name);
  std::string out = "a quantity in";
  const std::array<std::pair<int, const char*>, 4> parts{
      {{dimension.mass, "kg"}, {dimension.length, "m"}, {dimension.time, "s"}, {dimension.angle, "deg"}}};
  for (const auto& [power, symbol] : parts) {
    if (power == 0) continue;
    out += std::string(" ") + symbol;
    if (power != 1) out += "^" + std::to_string(power);
  }
  return out;
}

Conversion convert_quantity(std::string_view text, std::string_view unit) {
  const Unit wanted = parse_unit(unit).value();
  const auto split = split_quantity(text);
  if (!split) return {0, "must be a number, or a number and a unit"};
  if (split->unit.empty()) return {0, "has no unit (a number without one stands without quotes)"};
  const auto found = parse_unit(split->unit);
  if (!found) return {0, "has an unknown unit \"" + std::string(split->unit) + "\""};
  if (!(found->dimension == wanted.dimension))
    return {0, "must be " + name_of_dimension(wanted.dimension) + ", not " + name_of_dimension(found->dimension)};
  const std::string shifted =
      split->digits + "e" + std::to_string(split->exponent + found->power_of_ten - wanted.power_of_ten);
  double value = 0;
  if (std::from_chars(shifted.data(), shifted.data() + shifted.size(), value).ec != std::errc())
    return {0, "is beyond the range of numbers"};
  return {value * (found->factor / wanted.factor), {}};
}

}  // namespace scarp

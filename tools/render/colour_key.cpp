// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/colour_key.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr std::uint32_t kSign = 0x80000000u;
constexpr double kStray = 1e-4;  ///< share of the values at each end that may be left beyond the bar
constexpr double kQuiet = 0.02;  ///< share of a range from zero that shows the ground if the options say nothing
constexpr double kStretch = 3;   ///< if they would stretch it by more than this

/// Floats in rising order have rising keys; the upper 16 bits resolve a value to better than 1 %.
std::size_t bin_of(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  return (bits & kSign ? ~bits : bits | kSign) >> 16;
}

/// Value at the upper (outer for the highest) edge of a bin.
double edge_of(std::size_t bin, bool upper) {
  const std::uint32_t key = static_cast<std::uint32_t>(bin) << 16 | (upper ? 0xFFFFu : 0u);
  return std::bit_cast<float>(key & kSign ? key & ~kSign : ~key);
}

std::pair<double, double> without_strays(const Scene& scene) {
  const auto& counts = scene.histogram;
  const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  const std::uint64_t allowed = static_cast<std::uint64_t>(kStray * static_cast<double>(total));
  std::size_t first = 0, last = counts.size() - 1;
  for (std::uint64_t seen = counts[first]; seen <= allowed; seen += counts[++first]) {
  }
  for (std::uint64_t seen = counts[last]; seen <= allowed; seen += counts[--last]) {
  }
  return {std::max(scene.low, edge_of(first, false)), std::min(scene.high, edge_of(last, true))};
}

/// A range that can be divided by: a single value gets room around it, from zero where that is near.
std::pair<double, double> widened(double low, double high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (high - low > 1e-5 * largest) return {low, high};
  if (largest == 0) return {0, 1};
  return {low - 0.01 * largest, high + 0.01 * largest};
}

/// Ends such that every edge of a band is a round number.
std::pair<double, double> round_bands(double low, double high, int bands) {
  const double power = std::pow(10.0, std::floor(std::log10((high - low) / bands)));
  for (double m : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0}) {
    const double step = m * power, first = std::floor(low / step + 1e-6) * step;
    if (first + bands * step >= high - 1e-6 * step) return {first, first + bands * step};
  }
  return {low, high};
}

std::pair<double, double> automatic_range(const Scene& scene, int bands) {
  if (!scene.any) return {0, 1};
  std::pair<double, double> range{scene.low, scene.high};
  const auto inner = without_strays(scene);
  if (inner.second > inner.first && range.second - range.first > kStretch * (inner.second - inner.first)) range = inner;
  range = widened(range.first, range.second);
  return bands > 0 ? round_bands(range.first, range.second, bands) : round_outwards(range.first, range.second);
}

std::pair<double, double> checked_range(const Vec2& range) {
  if (std::isfinite(range[0]) && std::isfinite(range[1]) && range[0] < range[1]) return {range[0], range[1]};
  throw Error("render", "the colour range is not increasing",
              "[" + shortest(range[0]) + ", " + shortest(range[1]) + "]", "two finite numbers, the smaller one first");
}

/// Ticks on the edges of the bands, as far as there is room for them.
Ticks band_ticks(double low, double high, int bands) {
  Ticks ticks;
  ticks.step = (high - low) / bands;
  for (int k = 0; k <= bands; ++k) ticks.values.push_back(low + k * ticks.step);
  const auto inexact = [&](double v) {
    const double scaled = v * std::pow(10.0, ticks.decimals);
    return std::abs(scaled - std::round(scaled)) > 1e-3 * std::pow(10.0, ticks.decimals) * ticks.step;
  };
  while (ticks.decimals < 9 && std::any_of(ticks.values.begin(), ticks.values.end(), inexact)) ++ticks.decimals;
  return ticks;
}

void add_classes(ColourKey& key, const Scene& scene, const std::vector<std::string>& names, const std::string& noun) {
  for (std::int32_t index : scene.classes) {
    const bool named = index >= 0 && static_cast<std::size_t>(index) < names.size();
    key.classes.push_back(index);
    key.class_names.push_back(named ? names[static_cast<std::size_t>(index)] : noun + " " + std::to_string(index));
  }
}

}  // namespace

void count_value(std::vector<std::uint64_t>& histogram, float value) {
  if (histogram.empty()) histogram.resize(1u << 16, 0);
  ++histogram[bin_of(value)];
}

ColourKey make_colour_key(const Scene& scene, const ColourField& field, const ColourOptions& options,
                          const RenderContext& context) {
  ColourKey key;
  key.kind = field.kind;
  key.label = field.label;
  key.missing = scene.missing;
  key.scale.table = colour_table(options.map);
  if (field.kind == ColourKind::classes) {
    const bool materials = options.field == "material";
    add_classes(key, scene, materials ? context.materials : context.bodies, options.field);
  }
  if (field.kind != ColourKind::scalar) return key;
  const auto [low, high] = options.range ? checked_range(*options.range) : automatic_range(scene, options.bands);
  key.scale.low = low;
  key.scale.high = high;
  key.scale.bands = options.bands;
  key.scale.threshold = options.threshold;
  // What starts at zero is zero where nothing happens: there the ground shows.
  if (!options.threshold && low == 0 && options.bands > 0) key.scale.threshold = kQuiet * high;
  if (!options.threshold && low == 0 && options.bands == 0) key.scale.fade = 3 * kQuiet;
  key.below = scene.any && scene.low < low - 1e-6 * (high - low);
  key.above = scene.any && scene.high > high + 1e-6 * (high - low);
  key.unit = display_unit(field.unit, std::max(std::abs(low), std::abs(high)));
  const double from = low * key.unit.factor, to = high * key.unit.factor;
  key.ticks = options.bands > 0 && options.bands <= 12 ? band_ticks(from, to, options.bands) : nice_ticks(from, to, 8);
  return key;
}

}  // namespace scarp

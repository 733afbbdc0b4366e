// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/m3c2_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The quantile quarters / 4 of n sorted values by rank.
double by_rank(const std::vector<double>& sorted, std::size_t quarters) {
  const std::size_t rank = quarters * sorted.size() / 4;
  const bool whole = quarters * sorted.size() % 4 == 0;
  return whole ? (sorted[rank - 1] + sorted[rank]) / 2 : sorted[rank];
}

double median_of(const std::vector<double>& sorted, std::size_t begin, std::size_t end) {
  const std::size_t middle = begin + (end - begin) / 2;
  return (end - begin) % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

double interquartile_range(const std::vector<double>& sorted, bool half_medians) {
  const std::size_t n = sorted.size(), half = (n + 1) / 2;
  if (half_medians) return median_of(sorted, n - half, n) - median_of(sorted, 0, half);
  return by_rank(sorted, 3) - by_rank(sorted, 1);
}

double standard_deviation(const std::vector<double>& values, double mean, bool sample) {
  double squares = 0;
  for (double value : values) squares += (value - mean) * (value - mean);
  const double divisor = static_cast<double>(values.size()) - (sample ? 1 : 0);
  return divisor > 0 ? std::sqrt(squares / divisor) : kNaN;
}

}  // namespace

M3c2Rules rules_of(CompareConvention convention, const M3c2Options& options) {
  const auto minimum = static_cast<std::size_t>(std::max(1, options.minimum_points));
  switch (convention) {
    case CompareConvention::scarp:
      return {.minimum_points = minimum};
    case CompareConvention::py4dgeo:
      return {.segments = true};
    case CompareConvention::cloudcompare:
      return {.closed_ball = true,
              .sample_spread = false,
              .half_medians = true,
              .scale = ScaleChoice::dimensionality,
              .minimum_points = minimum};
    case CompareConvention::pdal:
      return {.closed_ball = true, .sample_spread = false};
  }
  return {};
}

std::string in_words(CompareConvention convention, const M3c2Rules& rules, Average average) {
  std::string text = "Rules as in \"" + std::string(name_of(convention)) + "\". ";
  text += rules.segments ? "Cylinders are searched in ceil(max_distance / cylinder_radius) segments with open ends, "
                           "half length at least the radius: points between two segments are in neither. "
                         : "Closed cylinders: distance from the axis <= cylinder_radius, abs(t) <= max_distance. ";
  text += std::string("Neighbourhoods of normals ") + (rules.closed_ball ? "with" : "without") + " their border; ";
  text += rules.scale == ScaleChoice::planarity
              ? "of several scales that of the largest (l1 - l0) / l2, eigenvalues ascending. "
              : "of several scales that of the largest 2 s2 + 4 s1 - 2, s the normalised squares of the eigenvalues. ";
  if (average == Average::mean)
    text += std::string(
                "distance = mean of the observed - mean of the simulated points along the normal; spread: "
                "standard deviation with ") +
            (rules.sample_spread ? "n - 1. " : "n. ");
  else
    text += std::string(
                "distance = median of the observed - median of the simulated points along the normal; spread: "
                "interquartile range, ") +
            (rules.half_medians ? "quartiles as medians of the halves. " : "quartiles by rank. ");
  return text;
}

Level level_of(std::vector<double>& positions, Average average, const M3c2Rules& rules) {
  const std::size_t n = positions.size();
  if (n == 0) return {kNaN, kNaN, 0};
  if (average == Average::median) {
    std::sort(positions.begin(), positions.end());
    return {median_of(positions, 0, n), interquartile_range(positions, rules.half_medians), n};
  }
  double sum = 0;
  for (double t : positions) sum += t;
  const double mean = sum / static_cast<double>(n);
  return {mean, standard_deviation(positions, mean, rules.sample_spread), n};
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// |value - centre|, ascending.
std::vector<double> deviations(const std::vector<double>& values, double centre) {
  std::vector<double> sizes;
  sizes.reserve(values.size());
  for (double value : values) sizes.push_back(std::abs(value - centre));
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

/// Ascending, so that a sum depends on the values alone and small ones are not lost.
double sum_of_squares(const std::vector<double>& ascending_sizes) {
  double sum = 0;
  for (double size : ascending_sizes) sum += size * size;
  return sum;
}

}  // namespace

double quantile(const std::vector<double>& ascending, double q) {
  if (ascending.empty()) return kNaN;
  const double rank = q * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return ascending[below] + (rank - static_cast<double>(below)) * (ascending[above] - ascending[below]);
}

DistanceReport distance_statistics(const std::vector<double>& distances, double max_distance,
                                   const std::string& convention) {
  std::vector<double> matched;
  matched.reserve(distances.size());
  std::copy_if(distances.begin(), distances.end(), std::back_inserter(matched),
               [](double d) { return !std::isnan(d); });
  std::sort(matched.begin(), matched.end());
  const std::vector<double> sizes = deviations(matched, 0);
  const auto n = static_cast<double>(matched.size());
  double sum = 0, sum_of_sizes = 0;
  for (double d : matched) sum += d;
  for (double size : sizes) sum_of_sizes += size;

  DistanceReport report;
  report.convention = convention;
  report.points = distances.size();
  report.matched = matched.size();
  report.max_distance = max_distance;
  report.mean = sum / n;
  const RobustSpread robust = robust_spread(matched);
  report.median = robust.median;
  report.standard_deviation = n > 1 ? std::sqrt(sum_of_squares(deviations(matched, report.mean)) / (n - 1)) : kNaN;
  report.nmad = robust.nmad;
  report.root_mean_square = std::sqrt(sum_of_squares(sizes) / n);
  report.mean_absolute = sum_of_sizes / n;
  report.percentile_95 = quantile(sizes, 0.95);
  report.largest = quantile(sizes, 1);
  return report;
}

RobustSpread robust_spread(const std::vector<double>& ascending) {
  constexpr double kNormal = 1.482602218505602;  // 1 / quantile of |N(0, 1)| at one half
  const double median = quantile(ascending, 0.5);
  return {median, kNormal * quantile(deviations(ascending, median), 0.5)};
}

ComparisonReport start_report(const CompareOptions& options) {
  ComparisonReport report;
  report.name = options.name;
  report.method = name_of(options.method);
  report.convention = name_of(options.convention);
  return report;
}

void require_max_distance(const CompareOptions& options) {
  if (!(options.max_distance > 0))
    throw Error("compare", "max_distance of comparison \"" + options.name + "\"", shortest(options.max_distance),
                "above 0 m");
}

}  // namespace scarp

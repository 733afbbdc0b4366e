// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp {

double quantile(const std::vector<double>& ascending, double q) {
  if (ascending.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = q * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return ascending[below] + (rank - static_cast<double>(below)) * (ascending[above] - ascending[below]);
}

DistanceReport distance_statistics(const std::vector<double>& distances) {
  std::vector<double> matched;
  matched.reserve(distances.size());
  std::copy_if(distances.begin(), distances.end(), std::back_inserter(matched),
               [](double d) { return !std::isnan(d); });
  // Ascending, so that the sums depend on the distances alone and small ones are not lost.
  std::sort(matched.begin(), matched.end());
  const auto n = static_cast<double>(matched.size());
  double sum = 0, squares = 0, deviations = 0;
  for (double d : matched) {
    sum += d;
    squares += d * d;
  }
  const double mean = sum / n;
  for (double d : matched) deviations += (d - mean) * (d - mean);

  DistanceReport report;
  report.points = distances.size();
  report.matched = matched.size();
  report.mean = mean;
  report.median = quantile(matched, 0.5);
  report.standard_deviation = n > 1 ? std::sqrt(deviations / (n - 1)) : std::numeric_limits<double>::quiet_NaN();
  report.root_mean_square = std::sqrt(squares / n);
  report.percentile_95 = quantile(matched, 0.95);
  report.largest = quantile(matched, 1);
  return report;
}

RobustSpread robust_spread(const std::vector<double>& ascending) {
  constexpr double kNormal = 1.482602218505602;  // 1 / quantile of |N(0, 1)| at one half
  const double median = quantile(ascending, 0.5);
  std::vector<double> deviations;
  deviations.reserve(ascending.size());
  for (double v : ascending) deviations.push_back(std::abs(v - median));
  std::sort(deviations.begin(), deviations.end());
  return {median, kNormal * quantile(deviations, 0.5)};
}

}  // namespace scarp

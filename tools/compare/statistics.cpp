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

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/tolerance.hpp"

#include <cmath>
#include <limits>

#include "solver/model/error.hpp"

namespace scarp {

bool within_tolerance(const ComparisonReport& report, const CompareTolerance& tolerance,
                      std::vector<std::string>* exceeded) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  bool within = true;
  const auto check = [&](const char* statistic, double DistanceReport::*member, const std::optional<double>& limit) {
    const double value = report.distances ? (*report.distances).*member : kNaN;
    if (!limit || std::abs(value) <= *limit) return;
    within = false;
    if (!exceeded) return;
    std::string found = "is " + shortest(value) + " m";
    if (!report.distances)
      found = "is not measured by method \"" + report.method + "\"";
    else if (std::isnan(value))
      found = "is undefined, " + std::to_string(report.distances->matched) + " of " +
              std::to_string(report.distances->points) + " points matched";
    exceeded->push_back(report.name + ": " + statistic + " distance " + found + "; tolerance " + shortest(*limit) +
                        " m");
  };
  check("mean", &DistanceReport::mean, tolerance.mean);
  check("median", &DistanceReport::median, tolerance.median);
  check("95th percentile", &DistanceReport::percentile_95, tolerance.percentile_95);
  check("largest", &DistanceReport::largest, tolerance.largest);
  return within;
}

}  // namespace scarp

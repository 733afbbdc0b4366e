// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/tolerance.hpp"

#include <cmath>

#include "solver/model/error.hpp"

namespace scarp {

bool within_tolerance(const DistanceReport& report, const CompareTolerance& tolerance,
                      std::vector<std::string>* exceeded) {
  bool within = true;
  const auto check = [&](const char* statistic, double value, const std::optional<double>& limit) {
    if (!limit || value <= *limit) return;
    within = false;
    if (!exceeded) return;
    const std::string found = std::isnan(value) ? "is undefined, " + std::to_string(report.matched) + " of " +
                                                      std::to_string(report.points) + " points matched"
                                                : "is " + shortest(value) + " m";
    exceeded->push_back(report.name + ": " + statistic + " distance " + found + "; tolerance " + shortest(*limit) +
                        " m");
  };
  check("mean", report.mean, tolerance.mean);
  check("median", report.median, tolerance.median);
  check("95th percentile", report.percentile_95, tolerance.percentile_95);
  check("largest", report.largest, tolerance.largest);
  return within;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "solver/model/compare_options.hpp"
#include "solver/model/comparison_report.hpp"

namespace scarp {

/// Counts and statistics of distances (m); NaN means "not matched". Quantiles are linear between ranks (type 7).
DistanceReport distance_statistics(const std::vector<double>& distances, double max_distance = 0,
                                   const std::string& convention = {});

/// Quantile q in [0, 1] of ascending values, linear between ranks (Hyndman & Fan 1996, type 7); NaN of none.
double quantile(const std::vector<double>& ascending, double q);

/// Median and 1.4826 x the median absolute deviation from it, the standard deviation of normal values without their
/// tails; NaN of none.
struct RobustSpread {
  double median = 0;
  double nmad = 0;
};
RobustSpread robust_spread(const std::vector<double>& ascending);

/// Name, method and convention as the options say.
ComparisonReport start_report(const CompareOptions& options);

/// @throws Error unless max_distance is above zero.
void require_max_distance(const CompareOptions& options);

}  // namespace scarp

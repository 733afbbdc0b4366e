// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/reports.hpp"

namespace scarp {

/// Counts and statistics of distances (m), as compare_nearest describes them; NaN means "not matched". Name, method and
/// max_distance are left to the caller.
DistanceReport distance_statistics(const std::vector<double>& distances);

/// Quantile q in [0, 1] of ascending values, linear between ranks (Hyndman & Fan 1996, type 7); NaN of none.
double quantile(const std::vector<double>& ascending, double q);

/// Median and 1.4826 x the median absolute deviation from it, the standard deviation of normal values without their
/// tails; NaN of none.
struct RobustSpread {
  double median = 0;
  double nmad = 0;
};
RobustSpread robust_spread(const std::vector<double>& ascending);

}  // namespace scarp

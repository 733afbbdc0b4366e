// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/scan_options.hpp"

namespace scarp {

/// Statistical outlier removal with PCL's search (Rusu et al. 2008, doi:10.1016/j.robot.2008.08.005): with d_i the mean
/// distance of point i to its `neighbours` nearest others, keeps d_i <= mean(d) + deviations * std(d), std with n - 1.
/// Returns the indices of what is kept, ascending.
///
/// 2.0 us of processor time per point with 16 neighbours, for a million points in scan lines, 2.4 in any order, where
/// PCL's own filter takes 1.9 and 2.9; two threads are done 1.7 times as soon as one. Distances are those of
/// single-precision coordinates relative to the middle of the cloud.
/// @throws Error when the cloud has no more points than `neighbours`, is wider than 100 km, or has more
/// than 10,000 points at one place (as where "no return" is written as zeros).
std::vector<std::size_t> statistical_inliers(const std::vector<Vec3>& positions, const StatisticalOutlier& options,
                                             int threads = 1);

}  // namespace scarp

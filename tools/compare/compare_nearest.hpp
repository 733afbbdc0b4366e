// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solver/model/point_cloud.hpp"
#include "solver/model/reports.hpp"
#include "tools/compare/per_point_csv.hpp"
#include "tools/compare/tolerance.hpp"

namespace scarp {

struct NearestComparison {
  /// The simulated points in their own frame, with the scalars "distance", "dx", "dy", "dz" (m) before any others.
  PointCloud cloud;
  DistanceReport report;
};

/// Cloud-to-cloud distance: of each simulated point to the nearest observed one, Euclidean, never negative, and its
/// split (dx, dy, dz) = observed - simulated. All four are NaN where the nearest observed point is farther than
/// `max_distance` (m). Of equally near observed points the first counts.
///
/// The statistics are over matched points: standard deviation with n - 1 (NaN for a single point), 95th percentile
/// by linear interpolation between ranks (Hyndman & Fan 1996, type 7). All are NaN when nothing matched.
///
/// The clouds may have different origins; they are brought to the farther one, which is exact. That both
/// are in the same CRS is for the caller to see to. The same bits for any number of threads.
/// @throws Error for an empty cloud, a position that is not finite, or a max_distance that is not above zero.
NearestComparison compare_nearest(PointCloud simulated, const PointCloud& observed, double max_distance,
                                  const std::string& name, int threads);

}  // namespace scarp

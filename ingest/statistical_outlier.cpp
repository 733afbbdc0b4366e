// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/statistical_outlier.hpp"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>

#include <algorithm>

#include "ingest/pcl_bridge.hpp"
#include "solver/model/error.hpp"

namespace scarp {

std::vector<std::size_t> statistical_inliers(const std::vector<Vec3>& positions, const StatisticalOutlier& options) {
  if (options.neighbours < 1 || !(options.deviations >= 0))
    throw Error("ingest", "statistical-outlier: neighbours or deviations out of range",
                std::to_string(options.neighbours) + ", " + shortest(options.deviations), "at least 1, at least 0");
  if (positions.size() <= static_cast<std::size_t>(options.neighbours))
    throw Error("ingest", "statistical-outlier needs more points than neighbours",
                std::to_string(positions.size()) + " points with neighbours = " + std::to_string(options.neighbours),
                "at least " + std::to_string(options.neighbours + 1) + " points");
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(to_pcl(positions, "statistical-outlier"));
  filter.setMeanK(options.neighbours);
  filter.setStddevMulThresh(options.deviations);
  pcl::Indices kept;
  filter.filter(kept);
  return {kept.begin(), kept.end()};
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/statistical_outlier.hpp"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "ingest/pcl_bridge.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// PCL's search looks at every copy of a point for every copy: the square of their number.
constexpr std::size_t kMostCopies = 10000;

void require_no_pile(const pcl::PointCloud<pcl::PointXYZ>& cloud, const std::vector<Vec3>& positions) {
  const auto place = [&](std::uint32_t i) { return std::tuple(cloud[i].x, cloud[i].y, cloud[i].z); };
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  for (std::size_t i = kMostCopies; i < order.size(); ++i)
    if (place(order[i - kMostCopies]) == place(order[i])) {
      const Vec3& p = positions[order[i]];
      throw Error("ingest", "statistical-outlier cannot work through so many points at one place",
                  "more than " + std::to_string(kMostCopies) + " at local (" + shortest(p[0]) + ", " + shortest(p[1]) +
                      ", " + shortest(p[2]) + ")",
                  "at most " + std::to_string(kMostCopies) + " (crop them away, or voxel-thin first)");
    }
}

}  // namespace

std::vector<std::size_t> statistical_inliers(const std::vector<Vec3>& positions, const StatisticalOutlier& options) {
  if (options.neighbours < 1 || !(options.deviations >= 0))
    throw Error("ingest", "statistical-outlier: neighbours or deviations out of range",
                std::to_string(options.neighbours) + ", " + shortest(options.deviations), "at least 1, at least 0");
  if (positions.size() <= static_cast<std::size_t>(options.neighbours))
    throw Error("ingest", "statistical-outlier needs more points than neighbours",
                std::to_string(positions.size()) + " points with neighbours = " + std::to_string(options.neighbours),
                "at least " + std::to_string(options.neighbours + 1) + " points");
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  const auto cloud = to_pcl(positions, "statistical-outlier");
  require_no_pile(*cloud, positions);
  filter.setInputCloud(cloud);
  filter.setMeanK(options.neighbours);
  filter.setStddevMulThresh(options.deviations);
  pcl::Indices kept;
  filter.filter(kept);
  return {kept.begin(), kept.end()};
}

}  // namespace scarp

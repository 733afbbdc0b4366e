// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/clean.hpp"

#include "ingest/statistical_outlier.hpp"
#include "ingest/voxel_thin.hpp"

namespace scarp {
namespace {

// One overload per filter: the indices of what is kept.

std::vector<std::size_t> kept_by(const Crop& crop, const std::vector<Vec3>& positions, int) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    bool inside = true;
    for (int a = 0; a < 3; ++a) inside = inside && positions[i][a] >= crop.min[a] && positions[i][a] <= crop.max[a];
    if (inside) kept.push_back(i);
  }
  return kept;
}

std::vector<std::size_t> kept_by(const StatisticalOutlier& options, const std::vector<Vec3>& positions, int threads) {
  return statistical_inliers(positions, options, threads);
}

std::vector<std::size_t> kept_by(const VoxelThin& options, const std::vector<Vec3>& positions, int) {
  return voxel_thin(positions, options);
}

}  // namespace

CleanReport clean(PointCloud& cloud, const CleanFilter& filter, int threads) {
  return std::visit(
      [&](const auto& options) {
        CleanReport report{std::string(options.name), cloud.size(), 0};
        const std::vector<std::size_t> kept = kept_by(options, cloud.positions, threads);
        if (kept.size() < cloud.size()) select_points(cloud, kept);
        report.after = cloud.size();
        return report;
      },
      filter);
}

}  // namespace scarp

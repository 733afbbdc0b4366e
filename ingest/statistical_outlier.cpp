// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/statistical_outlier.hpp"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "ingest/pcl_bridge.hpp"
#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// PCL's search looks at every copy of a point for every copy: the square of their number.
constexpr std::size_t kMostCopies = 10000;

/// Bits 0 to 9 of n, two places apart.
std::uint64_t spread(std::uint64_t n) {
  n = (n | n << 16) & 0x30000ff;
  n = (n | n << 8) & 0x300f00f;
  n = (n | n << 4) & 0x30c30c3;
  return (n | n << 2) & 0x9249249;
}

/// The points cell after cell of 1024 to an axis, along Morton's curve: in the low half of each entry the index, in the
/// high half the cell. Points that are near each other ask for the same part of the tree, which is then at hand.
std::vector<std::uint64_t> order_in_space(const std::vector<Vec3>& positions) {
  const Box3 box = bounds(positions);
  const Vec3 size = box.max - box.min;
  const double per_cell = 1023.999 / std::max({size[0], size[1], size[2], 1e-300});
  std::vector<std::uint64_t> order(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    std::uint64_t cell = 0;
    for (int a = 0; a < 3; ++a)
      cell |= spread(static_cast<std::uint64_t>((positions[i][a] - box.min[a]) * per_cell)) << a;
    order[i] = cell << 32 | i;
  }
  std::sort(order.begin(), order.end());
  return order;
}

std::size_t index_of(std::uint64_t entry) { return entry & 0xffffffffu; }

/// Copies of a point stand in one cell.
void require_no_pile(const Cloud& cloud, const std::vector<Vec3>& positions, const std::vector<std::uint64_t>& order) {
  const auto place = [&](std::size_t i) { return std::tuple(cloud[i].x, cloud[i].y, cloud[i].z); };
  std::vector<std::size_t> members;
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && order[end] >> 32 == order[begin] >> 32) ++end;
    if (end - begin <= kMostCopies) continue;
    members.clear();
    for (std::size_t j = begin; j < end; ++j) members.push_back(index_of(order[j]));
    std::sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    for (std::size_t i = kMostCopies; i < members.size(); ++i) {
      if (place(members[i - kMostCopies]) != place(members[i])) continue;
      const Vec3& p = positions[members[i]];
      throw Error("ingest", "statistical-outlier cannot work through so many points at one place",
                  "more than " + std::to_string(kMostCopies) + " at local (" + shortest(p[0]) + ", " + shortest(p[1]) +
                      ", " + shortest(p[2]) + ")",
                  "at most " + std::to_string(kMostCopies) + " (crop them away, or voxel-thin first)");
    }
  }
}

/// d_i, m.
std::vector<float> mean_distances(const std::shared_ptr<Cloud>& cloud, const std::vector<std::uint64_t>& order,
                                  int neighbours, int threads) {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  std::vector<float> means(cloud->size());
  parallel_for((order.size() + kReductionBlock - 1) / kReductionBlock, threads, [&](std::size_t b) {
    pcl::Indices found(static_cast<std::size_t>(neighbours) + 1);
    std::vector<float> squares(found.size());
    for (std::size_t j = b * kReductionBlock; j < std::min(order.size(), (b + 1) * kReductionBlock); ++j) {
      const std::size_t i = index_of(order[j]);
      tree.nearestKSearch((*cloud)[i], neighbours + 1, found, squares);
      double sum = 0;
      for (std::size_t k = 1; k < squares.size(); ++k) sum += std::sqrt(squares[k]);  // the nearest is the point itself
      means[i] = static_cast<float>(sum / neighbours);
    }
  });
  return means;
}

double largest_kept(const std::vector<float>& means, double deviations) {
  const double count = static_cast<double>(means.size());
  double sum = 0, squares = 0;
  for (const double d : means) {
    sum += d;
    squares += d * d;
  }
  return sum / count + deviations * std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1)));
}

}  // namespace

std::vector<std::size_t> statistical_inliers(const std::vector<Vec3>& positions, const StatisticalOutlier& options,
                                             int threads) {
  if (options.neighbours < 1 || !(options.deviations >= 0))
    throw Error("ingest", "statistical-outlier: neighbours or deviations out of range",
                std::to_string(options.neighbours) + ", " + shortest(options.deviations), "at least 1, at least 0");
  if (positions.size() <= static_cast<std::size_t>(options.neighbours))
    throw Error("ingest", "statistical-outlier needs more points than neighbours",
                std::to_string(positions.size()) + " points with neighbours = " + std::to_string(options.neighbours),
                "at least " + std::to_string(options.neighbours + 1) + " points");
  const auto cloud = to_pcl(positions, "statistical-outlier");
  const std::vector<std::uint64_t> order = order_in_space(positions);
  require_no_pile(*cloud, positions, order);
  const std::vector<float> means = mean_distances(cloud, order, options.neighbours, threads);
  const double largest = largest_kept(means, options.deviations);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < means.size(); ++i)
    if (means[i] <= largest) kept.push_back(i);
  return kept;
}

}  // namespace scarp

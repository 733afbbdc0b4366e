// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/clean.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>

#include "ingest/statistical_outlier.hpp"
#include "ingest/voxel_thin.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

double unit(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

/// A slope with noise, and every 40th point well off it.
std::vector<Vec3> slope(std::size_t count, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::vector<Vec3> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 30 * unit(generator), y = 30 * unit(generator), noise = 0.05 * unit(generator);
    points[i] = {x, y, 0.4 * x + noise + (i % 40 == 7 ? 3 + 4 * unit(generator) : 0)};
  }
  return points;
}

/// Mean distance of each point to its k nearest others, by looking at all of them.
std::vector<double> mean_distances(const std::vector<Vec3>& points, std::size_t k) {
  std::vector<double> means;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<double> distances;
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != i) distances.push_back(norm(points[j] - points[i]));
    std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(k), distances.end());
    double sum = 0;
    for (std::size_t n = 0; n < k; ++n) sum += distances[n];
    means.push_back(sum / static_cast<double>(k));
  }
  return means;
}

double outlier_threshold(const std::vector<double>& means, double deviations) {
  double mean = 0, variance = 0;
  for (double d : means) mean += d / static_cast<double>(means.size());
  for (double d : means) variance += (d - mean) * (d - mean) / static_cast<double>(means.size() - 1);
  return mean + deviations * std::sqrt(variance);
}

TEST(StatisticalOutlier, AgreesWithTheDefinitionInDoublePrecision) {
  const std::vector<Vec3> points = slope(1500, 3);
  // 300 neighbours, because the search behind PCL changes its method there.
  for (const auto& [k, deviations] : std::vector<std::pair<int, double>>{{1, 1.0}, {16, 2.0}, {16, 0.0}, {300, 0.5}}) {
    const std::vector<double> means = mean_distances(points, static_cast<std::size_t>(k));
    const double threshold = outlier_threshold(means, deviations);
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_GT(std::abs(means[i] - threshold), 1e-5) << "too near the threshold for single precision";
      if (means[i] <= threshold) expected.push_back(i);
    }
    ASSERT_LT(expected.size(), points.size());
    for (int threads : {1, 3}) EXPECT_EQ(statistical_inliers(points, {k, deviations}, threads), expected) << k;
  }
}

TEST(StatisticalOutlier, DoesNotDependOnWhereTheCloudIs) {
  std::vector<Vec3> points = slope(1000, 4);
  for (Vec3& p : points) p = 0.01 * p;  // a stone, finer than the steps of a float at the far place
  std::vector<Vec3> far = points;
  for (Vec3& p : far) p = p + Vec3{524288, 4194304, 4096};
  EXPECT_EQ(statistical_inliers(far, {8, 2.0}), statistical_inliers(points, {8, 2.0}));
}

TEST(StatisticalOutlier, CopiesOfOnePointAreNoOutliers) {
  EXPECT_EQ(statistical_inliers(std::vector<Vec3>(100, Vec3{1, 2, 3}), {5, 1.0}).size(), 100u);
}

TEST(StatisticalOutlier, RefusesAPileOfCopiesInsteadOfTakingForever) {
  std::vector<Vec3> points = slope(1000, 4);
  points.resize(300000, Vec3{0, 0, 0});  // what some scanners write for "no return"
  EXPECT_THROW(statistical_inliers(points, {8, 2.0}), Error);
}

TEST(StatisticalOutlier, RefusesTooFewPointsAndTooWideClouds) {
  const std::vector<Vec3> four{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_THROW(statistical_inliers(four, {4, 1.0}), Error);
  EXPECT_NO_THROW(statistical_inliers(four, {3, 1.0}));
  EXPECT_THROW(statistical_inliers({}, {1, 1.0}), Error);
  std::vector<Vec3> wide = four;
  wide[3][2] = 100002;
  EXPECT_THROW(statistical_inliers(wide, {2, 1.0}), Error);
  wide[3][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(statistical_inliers(wide, {2, 1.0}), Error);
}

/// Voxels in a sorted map, each searched point by point.
std::vector<std::size_t> thin_slowly(const std::vector<Vec3>& points, double size) {
  std::map<std::array<double, 3>, std::vector<std::size_t>> voxels;
  for (std::size_t i = 0; i < points.size(); ++i)
    voxels[{std::floor(points[i][0] / size), std::floor(points[i][1] / size), std::floor(points[i][2] / size)}]
        .push_back(i);
  std::vector<std::size_t> kept;
  for (const auto& [key, members] : voxels) {
    Vec3 centroid{0, 0, 0};
    for (std::size_t i : members) centroid = centroid + (1.0 / static_cast<double>(members.size())) * points[i];
    std::size_t best = members.front();
    for (std::size_t i : members)
      if (norm(points[i] - centroid) < norm(points[best] - centroid) - 1e-6 * size) best = i;
    kept.push_back(best);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

TEST(VoxelThin, AgreesWithASlowSearch) {
  std::vector<Vec3> points = slope(20000, 5);
  for (Vec3& p : points) p = p - Vec3{15, 15, 5};  // both signs
  for (double size : {0.3, 1.0, 7.5, 100.0}) EXPECT_EQ(voxel_thin(points, {size}), thin_slowly(points, size)) << size;
}

TEST(VoxelThin, EquallyNearPointsGoByIndex) {
  // Two points are always equally far from their centroid, the corners of a square too.
  std::mt19937_64 generator(6);
  std::vector<Vec3> pairs;
  std::vector<std::size_t> firsts;
  for (int i = 0; i < 500; ++i) {
    firsts.push_back(pairs.size());
    for (int copy = 0; copy < 2; ++copy)
      pairs.push_back({i + 0.98 * unit(generator), 0.98 * unit(generator), 0.98 * unit(generator)});
  }
  EXPECT_EQ(voxel_thin(pairs, {1.0}), firsts);
  std::vector<Vec3> squares;  // turned, so that rounding makes their corners differ
  std::vector<std::size_t> corners;
  for (int i = 0; i < 500; ++i) {
    corners.push_back(squares.size());
    const double angle = 6.3 * unit(generator);
    for (int corner = 0; corner < 4; ++corner)
      squares.push_back(
          {i + 0.5 + 0.4 * std::cos(angle + corner * M_PI_2), 0.5 + 0.4 * std::sin(angle + corner * M_PI_2), 0.3});
  }
  EXPECT_EQ(voxel_thin(squares, {1.0}), corners);
}

TEST(VoxelThin, TinyVoxelsOverAWideSiteKeepEverything) {
  const std::vector<Vec3> points{{-50000, 0, 0}, {50000, 50000, 3000}, {50000, 50000, 3000.001}, {0, 0, -1}};
  EXPECT_EQ(voxel_thin(points, {1e-4}).size(), 4u) << "10^9 voxels along an axis";
  EXPECT_THROW(voxel_thin(points, {1e-13}), Error);
  EXPECT_THROW(voxel_thin({{0, std::numeric_limits<double>::quiet_NaN(), 0}}, {1.0}), Error);
  EXPECT_THROW(voxel_thin(points, {0.0}), Error);
  EXPECT_TRUE(voxel_thin({}, {1.0}).empty());
}

PointCloud with_every_attribute(std::vector<Vec3> positions) {
  PointCloud cloud;
  cloud.positions = std::move(positions);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto n = static_cast<std::uint16_t>(i);
    cloud.colour.push_back({n, 1, 2});
    cloud.intensity.push_back(n);
    cloud.classification.push_back(static_cast<std::uint8_t>(i));
    cloud.return_number.push_back(static_cast<std::uint8_t>(i));
    cloud.number_of_returns.push_back(static_cast<std::uint8_t>(i));
    cloud.gps_time.push_back(static_cast<double>(i));
    cloud.normals.push_back({0, 0, static_cast<double>(i)});
  }
  cloud.scalars = {{"range", "m", cloud.gps_time}, {"amplitude", "dB", cloud.gps_time}};
  return cloud;
}

TEST(Clean, CropKeepsItsFacesAndAllAttributes) {
  PointCloud cloud =
      with_every_attribute({{0, 0, 0}, {5, 5, 5}, {10, 10, 10}, {10, 10, 10.001}, {-0.001, 1, 1}, {1, 2, 3}});
  const CleanReport report = clean(cloud, Crop{{0, 0, 0}, {10, 10, 10}}, 1);
  EXPECT_EQ(report.filter, "crop");
  EXPECT_EQ(report.before, 6u);
  EXPECT_EQ(report.after, 4u);
  EXPECT_EQ(cloud.intensity, (std::vector<std::uint16_t>{0, 1, 2, 5}));
  for_each_attribute(cloud, [](const auto& values) { EXPECT_EQ(values.size(), 4u); });
  EXPECT_EQ(cloud.scalars[1].values, (std::vector<double>{0, 1, 2, 5}));
  EXPECT_EQ(cloud.positions[3], (Vec3{1, 2, 3}));
}

TEST(Clean, EveryFilterKeepsTheOrder) {
  for (const CleanFilter& filter :
       std::vector<CleanFilter>{StatisticalOutlier{8, 1.0}, VoxelThin{2.0}, Crop{{1, 1, 1}, {9, 9, 9}}}) {
    PointCloud cloud = with_every_attribute(slope(250, 8));
    const std::vector<Vec3> before = cloud.positions;
    const CleanReport report = clean(cloud, filter, 2);
    EXPECT_EQ(report.after, cloud.size());
    EXPECT_LT(report.after, report.before);
    EXPECT_TRUE(std::is_sorted(cloud.gps_time.begin(), cloud.gps_time.end())) << report.filter;
    for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_EQ(cloud.positions[i], before[cloud.intensity[i]]);
  }
}

}  // namespace
}  // namespace scarp

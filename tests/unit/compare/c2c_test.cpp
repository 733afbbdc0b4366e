// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/c2c.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// n x n points of a horizontal plane.
PointCloud plane(int n, double spacing, const Vec3& corner) {
  PointCloud cloud;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      cloud.positions.push_back({corner[0] + spacing * i, corner[1] + spacing * j, corner[2]});
  return cloud;
}

/// A wavy surface: no two distances alike.
PointCloud waves(int n, double spacing, double phase) {
  PointCloud cloud = plane(n, spacing, {0.1, 0.2, 0});
  for (Vec3& p : cloud.positions) p[2] = 3 + 0.8 * std::sin(0.7 * p[0] + phase) * std::cos(0.9 * p[1] - phase);
  return cloud;
}

PointCloud in_site_coordinates(PointCloud cloud) {
  for (Vec3& p : cloud.positions) p = p + cloud.site.origin;
  cloud.site.origin = {0, 0, 0};
  return cloud;
}

PointCloud with_origin(PointCloud cloud, const Vec3& origin) {
  for (Vec3& p : cloud.positions) p = p - (origin - cloud.site.origin);
  cloud.site.origin = origin;
  return cloud;
}

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> result;
  for (double v : values) result.push_back(std::bit_cast<std::uint64_t>(v));
  return result;
}

Comparison compare_nearest(PointCloud simulated, const PointCloud& observed, double max_distance, int threads) {
  CompareOptions options;
  options.name = "planes";
  options.max_distance = max_distance;
  return compare_c2c(std::move(simulated), observed, options, threads);
}

void expect_same_bits(const Comparison& a, const Comparison& b) {
  ASSERT_EQ(a.cloud.scalars.size(), b.cloud.scalars.size());
  for (std::size_t s = 0; s < a.cloud.scalars.size(); ++s)
    EXPECT_EQ(bits(a.cloud.scalars[s].values), bits(b.cloud.scalars[s].values)) << a.cloud.scalars[s].name;
  const auto numbers = [](const DistanceReport& r) {
    return bits({r.mean, r.median, r.standard_deviation, r.nmad, r.root_mean_square, r.mean_absolute, r.percentile_95,
                 r.largest});
  };
  EXPECT_EQ(numbers(*a.report.distances), numbers(*b.report.distances));
  EXPECT_EQ(a.report.distances->matched, b.report.distances->matched);
}

TEST(C2c, ParallelPlanesAreTheirOffsetApart) {
  const Comparison result = compare_nearest(plane(40, 0.5, {10, 20, 3}), plane(50, 0.5, {8, 18, 3.25}), 5, 2);
  ASSERT_EQ(result.cloud.scalars.size(), 4u);
  for (std::size_t i = 0; i < result.cloud.size(); ++i) {
    ASSERT_EQ(result.cloud.scalars[0].values[i], 0.25);
    ASSERT_EQ(result.cloud.scalars[1].values[i], 0);
    ASSERT_EQ(result.cloud.scalars[2].values[i], 0);
    ASSERT_EQ(result.cloud.scalars[3].values[i], 0.25) << "observed minus simulated";
  }
  EXPECT_EQ(result.report.name, "planes");
  EXPECT_EQ(result.report.method, "c2c");
  const DistanceReport& report = *result.report.distances;
  EXPECT_EQ(report.points, 1600u);
  EXPECT_EQ(report.matched, 1600u);
  EXPECT_EQ(report.max_distance, 5);
  for (double s : {report.mean, report.median, report.root_mean_square, report.mean_absolute, report.percentile_95,
                   report.largest})
    EXPECT_EQ(s, 0.25);
  EXPECT_EQ(report.standard_deviation, 0);
  EXPECT_EQ(report.nmad, 0);
}

/// Pairs of points, the i-th of n a distance i apart.
Comparison ladder(int n, double max_distance) {
  PointCloud simulated, observed;
  for (int i = 1; i <= n; ++i) {
    simulated.positions.push_back({1000.0 * i, 0, 0});
    observed.positions.push_back({1000.0 * i, -1.0 * i, 0});
  }
  return compare_nearest(simulated, observed, max_distance, 1);
}

TEST(C2c, StatisticsOfOneToN) {
  const DistanceReport odd = ladder(101, 400).report.distances.value();
  EXPECT_DOUBLE_EQ(odd.mean, 51);
  EXPECT_DOUBLE_EQ(odd.median, 51);
  EXPECT_DOUBLE_EQ(odd.standard_deviation, std::sqrt(101 * 102 / 12.0));  // n (n + 1) / 12 with n - 1
  EXPECT_DOUBLE_EQ(odd.root_mean_square, std::sqrt(102 * 203 / 6.0));
  EXPECT_DOUBLE_EQ(odd.percentile_95, 96);
  EXPECT_EQ(odd.largest, 101);
  EXPECT_DOUBLE_EQ(odd.nmad, 1.482602218505602 * 25);
  const DistanceReport even = ladder(10, 400).report.distances.value();
  EXPECT_DOUBLE_EQ(even.median, 5.5);
  EXPECT_DOUBLE_EQ(even.percentile_95, 9.55);
}

TEST(C2c, BeyondMaxDistanceThereIsNoData) {
  const Comparison result = ladder(10, 4);
  EXPECT_EQ(result.report.distances->points, 10u);
  EXPECT_EQ(result.report.distances->matched, 4u);
  EXPECT_DOUBLE_EQ(result.report.distances->mean, 2.5);
  EXPECT_EQ(result.report.distances->largest, 4) << "the limit itself is within";
  for (const PointScalar& scalar : result.cloud.scalars)
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(std::isnan(scalar.values[i]), i >= 4) << scalar.name << " " << i;
  EXPECT_EQ(result.cloud.scalars[2].values[3], -4);
}

TEST(C2c, NothingMatchedIsNaNNotZero) {
  const DistanceReport report = ladder(5, 0.5).report.distances.value();
  EXPECT_EQ(report.matched, 0u);
  for (double s : {report.mean, report.median, report.standard_deviation, report.root_mean_square, report.percentile_95,
                   report.largest})
    EXPECT_TRUE(std::isnan(s));
  const DistanceReport single = ladder(5, 1).report.distances.value();
  EXPECT_EQ(single.mean, 1);
  EXPECT_TRUE(std::isnan(single.standard_deviation)) << "undefined for one point";
}

TEST(C2c, OriginsDoNotShowInTheResult) {
  const Vec3 origin{512300, 5412300, 0};
  PointCloud simulated = waves(30, 0.37, 0.2), observed = waves(33, 0.31, 0.5);
  simulated.site.origin = observed.site.origin = origin;
  // What a file in map coordinates could hold; made local, both say the same.
  const PointCloud raw_simulated = in_site_coordinates(simulated), raw_observed = in_site_coordinates(observed);
  simulated = with_origin(raw_simulated, origin);
  observed = with_origin(raw_observed, origin);
  const Comparison both_local = compare_nearest(simulated, observed, 0.4, 1);
  ASSERT_GT(both_local.report.distances->matched, 0u);
  expect_same_bits(both_local, compare_nearest(simulated, raw_observed, 0.4, 1));
  const Comparison raw = compare_nearest(raw_simulated, observed, 0.4, 1);
  expect_same_bits(both_local, raw);
  EXPECT_EQ(raw.cloud.positions, raw_simulated.positions) << "the cloud stays in its own frame";
  expect_same_bits(both_local, compare_nearest(raw_simulated, raw_observed, 0.4, 1));
}

TEST(C2c, ParticlesKeepTheDigitsThatMapCoordinatesHaveNoRoomFor) {
  const Vec3 origin{512300, 5412300, 0};
  PointCloud simulated = waves(30, 0.37, 0.2);
  simulated.site.origin = origin;
  PointCloud raw = waves(33, 0.31, 0.5);
  for (Vec3& p : raw.positions) p = p + origin;
  expect_same_bits(compare_nearest(simulated, with_origin(raw, origin), 0.4, 1),
                   compare_nearest(simulated, raw, 0.4, 1));
}

TEST(C2c, SameBitsOnAnyNumberOfThreads) {
  const PointCloud simulated = waves(60, 0.2, 0), observed = waves(71, 0.17, 1.1);
  const Comparison one = compare_nearest(simulated, observed, 0.3, 1);
  ASSERT_GT(one.report.distances->matched, 0u);
  ASSERT_LT(one.report.distances->matched, one.report.distances->points);
  expect_same_bits(one, compare_nearest(simulated, observed, 0.3, 2));
  expect_same_bits(one, compare_nearest(simulated, observed, 0.3, 3));
}

TEST(C2c, CarriesAttributesAndReplacesAnEarlierResult) {
  PointCloud simulated = plane(2, 1, {0, 0, 0});
  simulated.intensity = {1, 2, 3, 4};
  simulated.scalars = {{"displacement", "m", {4, 3, 2, 1}}, {"dx", "m", {9, 9, 9, 9}}};
  const PointCloud cloud = compare_nearest(simulated, plane(2, 1, {0, 0, 1}), 2, 1).cloud;
  std::vector<std::string> names;
  for (const PointScalar& scalar : cloud.scalars) names.push_back(scalar.name);
  EXPECT_EQ(names, (std::vector<std::string>{"distance", "dx", "dy", "dz", "displacement"}));
  EXPECT_EQ(cloud.scalars[1].values, (std::vector<double>{0, 0, 0, 0}));
  EXPECT_EQ(cloud.scalars[4].values, (std::vector<double>{4, 3, 2, 1}));
  EXPECT_EQ(cloud.intensity, simulated.intensity);
}

TEST(C2c, RefusesWhatCannotBeCompared) {
  const PointCloud good = plane(2, 1, {0, 0, 0});
  PointCloud bad = good;
  bad.positions[3][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(compare_nearest(PointCloud{}, good, 1, 1), Error);
  EXPECT_THROW(compare_nearest(good, PointCloud{}, 1, 1), Error);
  EXPECT_THROW(compare_nearest(bad, good, 1, 1), Error);
  EXPECT_THROW(compare_nearest(good, bad, 1, 1), Error);
  EXPECT_THROW(compare_nearest(good, good, 0, 1), Error);
  EXPECT_THROW(compare_nearest(good, good, std::numeric_limits<double>::quiet_NaN(), 1), Error);
}

}  // namespace
}  // namespace scarp

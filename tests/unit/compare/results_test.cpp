// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is made of a comparison: the verdict and the table.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "tools/compare/per_point_csv.hpp"
#include "tools/compare/tolerance.hpp"

namespace scarp {
namespace {

ComparisonReport sample_report() {
  ComparisonReport report;
  report.name = "slide";
  report.method = "c2c";
  report.distances.emplace();
  report.distances->points = 10;
  report.distances->matched = 8;
  report.distances->mean = -0.3;
  report.distances->median = 0.2;
  report.distances->percentile_95 = 0.9;
  report.distances->largest = 1.5;
  return report;
}

TEST(Tolerance, NoLimitIsNeverExceeded) { EXPECT_TRUE(within_tolerance(sample_report(), {}, nullptr)); }

TEST(Tolerance, TheLimitItselfIsWithin) {
  const CompareTolerance exact{
      .mean = 0.3, .median = 0.2, .percentile_95 = 0.9, .largest = 1.5, .net_volume = {}, .iou = {}};
  std::vector<std::string> exceeded;
  EXPECT_TRUE(within_tolerance(sample_report(), exact, &exceeded));
  EXPECT_TRUE(exceeded.empty());
}

TEST(Tolerance, EachExcessIsNamed) {
  const CompareTolerance tight{
      .mean = 0.25, .median = 0.1, .percentile_95 = 0.8, .largest = 1.0, .net_volume = {}, .iou = {}};
  std::vector<std::string> exceeded{"from before"};
  EXPECT_FALSE(within_tolerance(sample_report(), tight, &exceeded));
  ASSERT_EQ(exceeded.size(), 5u);
  EXPECT_EQ(exceeded[1], "slide: mean distance is -0.3 m; tolerance 0.25 m");
  EXPECT_NE(exceeded[3].find("95th percentile"), std::string::npos);
  CompareTolerance one;
  one.largest = 1.4;
  EXPECT_FALSE(within_tolerance(sample_report(), one, nullptr));
}

TEST(Tolerance, UndefinedIsAnExcess) {
  ComparisonReport report = sample_report();
  report.distances->matched = 0;
  report.distances->median = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> exceeded;
  CompareTolerance tolerance;
  tolerance.median = 1e9;
  EXPECT_FALSE(within_tolerance(report, tolerance, &exceeded));
  ASSERT_EQ(exceeded.size(), 1u);
  EXPECT_NE(exceeded[0].find("0 of 10 points matched"), std::string::npos) << exceeded[0];
}

TEST(Tolerance, AMethodWithoutDistancesExceedsIt) {
  ComparisonReport report = sample_report();
  report.distances.reset();
  CompareTolerance tolerance;
  tolerance.mean = 1e9;
  std::vector<std::string> exceeded;
  EXPECT_FALSE(within_tolerance(report, tolerance, &exceeded));
  ASSERT_EQ(exceeded.size(), 1u);
  EXPECT_EQ(exceeded[0], "slide: mean distance is not measured by method \"c2c\"; tolerance 1000000000 m");
}

TEST(Tolerance, OfVolumesAndFootprints) {
  ComparisonReport report = sample_report();
  report.groups = {{"volumes", "", {{"net", -12.5, "m3"}}}, {"footprint", "", {{"iou", 0.8}}}};
  CompareTolerance tolerance;
  tolerance.net_volume = 12.5;
  tolerance.iou = 0.8;
  EXPECT_TRUE(within_tolerance(report, tolerance, nullptr)) << "the limits themselves are within";
  tolerance.net_volume = 12;
  tolerance.iou = 0.81;
  std::vector<std::string> exceeded;
  EXPECT_FALSE(within_tolerance(report, tolerance, &exceeded));
  ASSERT_EQ(exceeded.size(), 2u);
  EXPECT_EQ(exceeded[0], "slide: net volume, m3, is -12.5; tolerance at most 12 m3");
  EXPECT_EQ(exceeded[1], "slide: overlap of the footprints (IoU) is 0.8; tolerance at least 0.81");
  report.groups = {{"footprint", "", {{"iou", std::numeric_limits<double>::quiet_NaN()}}}};
  EXPECT_FALSE(within_tolerance(report, tolerance, &exceeded)) << "neither measured nor defined";
  EXPECT_EQ(exceeded.size(), 4u);
}

TEST(PerPointCsv, WritesSiteCoordinatesAndNaN) {
  PointCloud cloud;
  cloud.site.origin = {500000, 5400000, 0};
  cloud.positions = {{1.5, 0.25, -3}, {0, 1, 2}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  cloud.scalars = {{"distance", "m", {0.1, nan}}, {"a,b \"c\"", "1", {-nan, 1e-300}}};
  EXPECT_EQ(per_point_csv(cloud),
            "x,y,z,distance,\"a,b \"\"c\"\"\"\n"
            "500001.5,5400000.25,-3,0.1,nan\n"
            "500000,5400001,2,nan,1e-300\n");
}

TEST(PerPointCsv, EveryDigitComesBack) {
  PointCloud cloud;
  for (int i = 1; i < 200; ++i) cloud.positions.push_back({std::sqrt(i), 1.0 / i, std::pow(0.3, i)});
  const std::string text = per_point_csv(cloud);
  const char* at = text.c_str() + text.find('\n');
  for (const Vec3& p : cloud.positions)
    for (double c : p) {
      char* end = nullptr;
      ASSERT_EQ(std::strtod(at + 1, &end), c);
      at = end;
    }
  EXPECT_EQ(std::string(at), "\n");
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/ingest.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A 21 x 21 terrace in map coordinates, 1 m apart, heights in feet, with faults.
PointCloud survey() {
  PointCloud cloud;
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j) cloud.positions.push_back({512300.0 + i, 5412300.0 + j, 1000});
  cloud.positions[5][2] = kNaN;
  cloud.positions[6][0] = std::numeric_limits<double>::infinity();
  cloud.positions.push_back({512310, 5412310, 1300});  // a bird
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.gps_time.push_back(static_cast<double>(i));
  return cloud;
}

ScanOptions options_with(std::vector<CleanFilter> steps) {
  ScanOptions options;
  options.name = "before";
  options.height_unit = HeightUnit::foot;
  options.clean = std::move(steps);
  return options;
}

std::string message_of(PointCloud raw, const ScanOptions& options) {
  try {
    ingest(std::move(raw), options, {512300, 5412300, 0}, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const Crop kWestHalf{{0, 0, -1000}, {10, 20, 1000}};

TEST(Ingest, AppliesEveryStepInOrder) {
  const IngestResult result =
      ingest(survey(), options_with({kWestHalf, StatisticalOutlier{4, 3.0}, VoxelThin{2.0}}), {512300, 5412300, 0}, 2);
  const IngestReport& report = result.report;
  EXPECT_EQ(report.scan, "before");
  EXPECT_EQ(report.points_read, 442u);
  EXPECT_EQ(report.not_finite, 2u);
  ASSERT_EQ(report.steps.size(), 3u);
  EXPECT_EQ(report.steps[0].filter, "crop");
  EXPECT_EQ(report.steps[0].before, 440u);
  EXPECT_EQ(report.steps[0].after, 11u * 21 - 2 + 1);
  EXPECT_EQ(report.steps[1].after, 11u * 21 - 2) << "the bird";
  EXPECT_EQ(report.steps[2].before, report.steps[1].after);
  EXPECT_EQ(report.points_kept, report.steps[2].after);
  EXPECT_EQ(report.points_kept, 6u * 11) << "one for each 2 m";
  EXPECT_EQ(result.cloud.size(), report.points_kept);
  EXPECT_EQ(result.cloud.gps_time.size(), report.points_kept);
  EXPECT_EQ(result.cloud.site.origin, (Vec3{512300, 5412300, 0}));
  for (const Vec3& p : result.cloud.positions) EXPECT_DOUBLE_EQ(p[2], 304.8);
  EXPECT_EQ(report.bounds.min, bounds(result.cloud.positions).min);
  EXPECT_EQ(report.bounds.max, bounds(result.cloud.positions).max);
  EXPECT_GE(report.bounds.min[0], 0);
  EXPECT_LE(report.bounds.max[0], 10);
}

TEST(Ingest, SameForAnyNumberOfThreads) {
  const ScanOptions options = options_with({StatisticalOutlier{4, 2.0}, VoxelThin{3.0}});
  const IngestResult one = ingest(survey(), options, {512300, 5412300, 0}, 1);
  for (int threads : {2, 3})
    EXPECT_EQ(ingest(survey(), options, {512300, 5412300, 0}, threads).cloud.positions, one.cloud.positions);
}

TEST(Ingest, SaysWhichStepRemovedTheLastPoint) {
  const std::string message = message_of(survey(), options_with({kWestHalf, Crop{{15, 0, 0}, {20, 20, 1000}}}));
  EXPECT_NE(message.find("clean step 2 (crop)"), std::string::npos) << message;
  EXPECT_NE(message.find("before"), std::string::npos) << message;
  EXPECT_NE(message.find("x 512300 to 512310"), std::string::npos) << "site coordinates: " << message;
}

TEST(Ingest, SaysWhereAFilterRefuses) {
  const std::string message = message_of(survey(), options_with({kWestHalf, StatisticalOutlier{900, 2.0}}));
  EXPECT_NE(message.find("scan \"before\": clean step 2: statistical-outlier"), std::string::npos) << message;
}

TEST(Ingest, RefusesEmptyAndUnusableClouds) {
  EXPECT_NE(message_of({}, options_with({})).find("no points"), std::string::npos);
  PointCloud nothing;
  nothing.positions.assign(3, {kNaN, 0, 0});
  EXPECT_NE(message_of(nothing, options_with({})).find("no point has finite"), std::string::npos);
  PointCloud degrees = survey();
  degrees.site.crs = "EPSG:4326";
  EXPECT_NE(message_of(degrees, options_with({})).find("degrees"), std::string::npos);
}

}  // namespace
}  // namespace scarp

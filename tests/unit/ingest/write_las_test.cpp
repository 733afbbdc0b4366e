// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/write_las.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ingest/read_las.hpp"
#include "solver/model/error.hpp"
#include "tests/support/test_data.hpp"
#include "tests/unit/ingest/las_builder.hpp"

namespace {

using scarp::Error;
using scarp::LasHeader;
using scarp::PointCloud;
using scarp::Rgb16;
using scarp::Vec3;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const std::string kWkt = "COMPD_CS[\"ETRS89 / UTM 32N + H\xC3\xB6he\",UNIT[\"metre\",1]]\r\n ";

class WriteLas : public testing::Test {
 protected:
  PointCloud round_trip(const PointCloud& cloud) {
    scarp::write_las(path_, cloud);
    header_ = scarp::read_las_header(path_);
    return scarp::read_las(path_);
  }

  std::string complaint(const PointCloud& cloud) {
    try {
      scarp::write_las(path_, cloud);
    } catch (const Error& error) {
      EXPECT_FALSE(std::filesystem::exists(path_));
      return error.what();
    }
    ADD_FAILURE() << "was written without complaint";
    return {};
  }

  scarp::test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "cloud.las";
  LasHeader header_;
};

/// Twenty thousand points, more than a block, about a UTM origin, with every attribute.
PointCloud full_cloud() {
  PointCloud cloud;
  cloud.site.origin = {500000, 5412345, 700};
  cloud.site.crs = kWkt;
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  cloud.scalars = {{"distance", "m", {}}, {"equivalent_plastic_strain", "", {}}};
  for (int i = 0; i < 20000; ++i) {
    cloud.positions.push_back({uniform(-400, 600), uniform(0, 300), uniform(-20, 90)});
    cloud.colour.push_back({static_cast<std::uint16_t>(random() % 200), 17, 255});  // dark, yet 16-bit
    cloud.intensity.push_back(static_cast<std::uint16_t>(random()));
    cloud.classification.push_back(static_cast<std::uint8_t>(random()));
    cloud.return_number.push_back(static_cast<std::uint8_t>(1 + random() % 15));
    cloud.number_of_returns.push_back(15);
    cloud.gps_time.push_back(uniform(2e8, 3e8));
    const double angle = uniform(0, 6);
    cloud.normals.push_back({std::cos(angle), 0, std::sin(angle)});
    cloud.scalars[0].values.push_back(i % 3 == 0 ? kNaN : uniform(-1, 1));
    cloud.scalars[1].values.push_back(uniform(0, 1e-12));
  }
  return cloud;
}

void expect_same_positions(const PointCloud& read, const PointCloud& written, double half_step) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i)
    for (std::size_t a = 0; a < 3; ++a)
      ASSERT_NEAR(read.positions[i][a] - written.site.origin[a], written.positions[i][a], half_step) << i;
}

TEST_F(WriteLas, EverythingComesBack) {
  const PointCloud cloud = full_cloud(), back = round_trip(cloud);
  EXPECT_EQ(header_.version_minor, 4);
  EXPECT_EQ(header_.point_format, 7);
  EXPECT_EQ(header_.count, 20000u);
  EXPECT_EQ(header_.crs, kWkt);
  EXPECT_EQ(header_.generating_software, "scarp");
  EXPECT_EQ(header_.scale, (Vec3{1e-6, 1e-6, 1e-6}));
  for (double offset : header_.offset) EXPECT_EQ(offset, std::round(offset));
  EXPECT_TRUE(header_.remarks.empty());
  // Half a step of 1e-6 m, and one unit in the last place of a northing.
  expect_same_positions(back, cloud, 0.5e-6 + 1e-9);
  EXPECT_EQ(back.site.crs, kWkt);
  EXPECT_EQ(back.colour, cloud.colour);
  EXPECT_EQ(back.intensity, cloud.intensity);
  EXPECT_EQ(back.classification, cloud.classification);
  EXPECT_EQ(back.return_number, cloud.return_number);
  EXPECT_EQ(back.number_of_returns, cloud.number_of_returns);
  EXPECT_EQ(back.gps_time, cloud.gps_time);
  EXPECT_EQ(back.normals, cloud.normals);
  ASSERT_EQ(back.scalars.size(), 2u);
  EXPECT_EQ(back.scalars[0].name, "distance");
  EXPECT_EQ(back.scalars[0].unit, "m");
  EXPECT_EQ(back.scalars[1].values, cloud.scalars[1].values);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double want = cloud.scalars[0].values[i], got = back.scalars[0].values[i];
    ASSERT_TRUE(std::isnan(want) ? std::isnan(got) : want == got);
  }
  const scarp::Box3 box = scarp::bounds(back.positions);
  EXPECT_EQ(header_.bounds.min, box.min);
  EXPECT_EQ(header_.bounds.max, box.max);
}

TEST_F(WriteLas, ReturnCountsAndFlagsInTheHeader) {
  PointCloud cloud;
  cloud.site.crs = "GEOGCS[\"x\"]";
  cloud.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  cloud.return_number = {1, 2, 1};
  cloud.number_of_returns = {2, 2, 1};
  scarp::write_las(path_, cloud);
  const std::string bytes = scarp::test::load_file(path_);
  const auto u64 = [&](std::size_t at) {
    std::uint64_t value;
    std::memcpy(&value, &bytes[at], 8);
    return value;
  };
  EXPECT_EQ(u64(247), 3u);
  EXPECT_EQ(u64(255), 2u);
  EXPECT_EQ(u64(263), 1u);
  EXPECT_EQ(bytes[6] & 16, 16);                             // the CRS is WKT
  EXPECT_EQ(bytes.substr(90, 4), std::string(4, '\0'));     // no date
  EXPECT_EQ(bytes.substr(107, 24), std::string(24, '\0'));  // legacy counts stay 0 in format 6
  EXPECT_EQ(bytes[375 + 54 + 11], '\0');                    // WKT ends with a NUL
  EXPECT_EQ(bytes.size(), 375u + 54 + 12 + 3 * 30);
}

TEST_F(WriteLas, SameCloudSameBytes) {
  scarp::write_las(path_, full_cloud());
  const std::string first = scarp::test::load_file(path_);
  scarp::write_las(path_, full_cloud());
  EXPECT_TRUE(first == scarp::test::load_file(path_));
}

TEST_F(WriteLas, EpsgGoesIntoGeoTiffKeysOfAnOlderFormat) {
  PointCloud cloud;
  cloud.site = {{400000, 5000000, 0}, "EPSG:4647"};  // projected, although its code is among the geographic ones
  cloud.positions = {{0, 0, 0}, {10, 20, 30}};
  cloud.classification = {2, 31};
  for (const bool colour : {false, true}) {
    for (const bool time : {false, true}) {
      cloud.colour = colour ? std::vector<Rgb16>{{1, 2, 3}, {4, 5, 6}} : std::vector<Rgb16>{};
      cloud.gps_time = time ? std::vector<double>{5, 6} : std::vector<double>{};
      const PointCloud back = round_trip(cloud);
      EXPECT_EQ(header_.point_format, (time ? 1 : 0) + (colour ? 2 : 0));
      EXPECT_EQ(back.site.crs, "EPSG:4647");
      EXPECT_EQ(back.colour, cloud.colour);
      EXPECT_EQ(back.gps_time, cloud.gps_time);
      EXPECT_EQ(back.classification, cloud.classification);
      expect_same_positions(back, cloud, 0.5e-6 + 1e-9);
      EXPECT_EQ(scarp::test::load_file(path_)[6] & 16, 0);
      EXPECT_EQ(scarp::test::load_file(path_)[107], 2);
    }
  }
  cloud.classification = {2, 64};
  EXPECT_EQ(round_trip(cloud).classification, cloud.classification);
  EXPECT_EQ(header_.point_format, 7);
  EXPECT_EQ(header_.crs, "EPSG:4647");
}

TEST_F(WriteLas, GeographicCodeStaysGeographic) {
  PointCloud cloud;
  cloud.site.crs = "EPSG:4326";
  cloud.positions = {{9.1, 48.7, 300}};
  EXPECT_EQ(round_trip(cloud).site.crs, "EPSG:4326");
  EXPECT_NE(scarp::test::load_file(path_).find(std::string("\x00\x08\x00\x00\x01\x00\xE6\x10", 8)), std::string::npos);
}

TEST_F(WriteLas, ScaleFollowsTheExtent) {
  PointCloud cloud;
  for (const auto& [extent, scale] : std::vector<std::pair<double, double>>{
           {1, 1e-6}, {4290, 1e-6}, {4300, 1e-5}, {42000, 1e-5}, {43000, 1e-4}, {420000, 1e-4}, {4.2e6, 1e-3}}) {
    cloud.positions = {{0, 0, 0}, {extent, -3, 0.125}};
    const PointCloud back = round_trip(cloud);
    EXPECT_EQ(header_.scale[0], scale) << extent;
    expect_same_positions(back, cloud, scale / 2 + 1e-9);
  }
}

TEST_F(WriteLas, AbsentAttributesAndAnEmptyCloud) {
  PointCloud cloud;
  cloud.positions = {{1, 2, 3}};
  const PointCloud back = round_trip(cloud);
  EXPECT_EQ(back.return_number, std::vector<std::uint8_t>{1});
  EXPECT_EQ(back.number_of_returns, std::vector<std::uint8_t>{1});
  EXPECT_TRUE(back.colour.empty());
  EXPECT_TRUE(back.intensity.empty());
  EXPECT_TRUE(back.gps_time.empty());
  EXPECT_EQ(back.site.crs, "");
  EXPECT_TRUE(round_trip(PointCloud{}).empty());
  EXPECT_TRUE(header_.bounds.empty());
}

TEST_F(WriteLas, WhatDoesNotFitIsRefusedAndNothingIsLeft) {
  PointCloud cloud;
  cloud.positions = {{0, 0, 0}, {4.3e6, 0, 0}};
  EXPECT_NE(complaint(cloud).find("extent"), std::string::npos);
  cloud.positions[1][0] = kNaN;
  EXPECT_NE(complaint(cloud).find("position of point 1"), std::string::npos);
  cloud.positions[1] = {1, 1, 1};
  cloud.site.origin = {1e17, 0, 0};
  EXPECT_NE(complaint(cloud).find("coordinate"), std::string::npos);
  cloud.site.origin = {0, 0, 0};
  cloud.return_number = {1, 16};
  EXPECT_NE(complaint(cloud).find("16 of 1"), std::string::npos);
  cloud.return_number = {1};
  EXPECT_NE(complaint(cloud).find("length"), std::string::npos);
  cloud.return_number = {};
  cloud.scalars = {{std::string(33, 'n'), "", {1, 2}}};
  EXPECT_NE(complaint(cloud).find("name"), std::string::npos);
  cloud.scalars = {{"n", std::string(27, 'u'), {1, 2}}};
  EXPECT_NE(complaint(cloud).find("unit"), std::string::npos);
  cloud.scalars = {{"n", "", {}}};
  EXPECT_NE(complaint(cloud).find("values of n"), std::string::npos);
  cloud.scalars.assign(342, {"n", "", {1, 2}});
  EXPECT_NE(complaint(cloud).find("341"), std::string::npos);
  cloud.scalars.clear();
  for (const char* crs : {"EPSG:", "EPSG:70000", "EPSG:32767", "EPSG:25832+7837", "somewhere"}) {
    cloud.site.crs = crs;
    EXPECT_NE(complaint(cloud).find("coordinate reference system"), std::string::npos) << crs;
  }
  cloud.site.crs = "[" + std::string(65534, 'w');
  EXPECT_NE(complaint(cloud).find("65534"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(WriteLas, LargestRecordStillFits) {
  PointCloud cloud;
  cloud.positions = {{0, 0, 0}};
  for (int i = 0; i < 341; ++i) cloud.scalars.push_back({"s" + std::to_string(i), "", {i + 0.5}});
  cloud.site.crs = "[" + std::string(65533, 'w');
  const PointCloud back = round_trip(cloud);
  ASSERT_EQ(back.scalars.size(), 341u);
  EXPECT_EQ(back.scalars[340].values[0], 340.5);
  EXPECT_EQ(back.site.crs, cloud.site.crs);
}

}  // namespace

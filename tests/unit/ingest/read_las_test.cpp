// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_las.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "solver/model/error.hpp"
#include "tests/support/test_data.hpp"
#include "tests/unit/ingest/las_builder.hpp"

namespace {

using scarp::Error;
using scarp::LasHeader;
using scarp::PointCloud;
using scarp::Rgb16;
using scarp::Vec3;
using scarp::test::LasBuilder;
using scarp::test::LasExtra;
using scarp::test::LasPoint;
using scarp::test::put;

class ReadLas : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& bytes) const { return memory_.hold(bytes); }
  PointCloud read(const std::string& bytes) const { return scarp::read_las(file(bytes)); }
  LasHeader header(const std::string& bytes) const { return scarp::read_las_header(file(bytes)); }

  std::string complaint(const std::string& bytes) const {
    try {
      read(bytes);
    } catch (const Error& error) {
      EXPECT_EQ(error.stage(), "ingest");
      return error.what();
    }
    ADD_FAILURE() << "was read without complaint";
    return {};
  }

  scarp::test::MemoryFile memory_;
  scarp::test::TemporaryFolder folder_;
};

LasBuilder three_points(int minor, int format) {
  LasBuilder las;
  las.minor = minor;
  las.format = format;
  las.points = {{.x = 100,
                 .y = -200,
                 .z = 3,
                 .intensity = 65535,
                 .number = 1,
                 .of = 3,
                 .classification = 2,
                 .gps_time = 1.5,
                 .red = 256,
                 .green = 2,
                 .blue = 3},
                {.x = -2147483647 - 1,
                 .y = 2147483647,
                 .z = 0,
                 .intensity = 1,
                 .number = 2,
                 .of = 3,
                 .classification = 31,
                 .flags = 4,
                 .gps_time = -2.5e8,
                 .red = 65535,
                 .green = 0,
                 .blue = 1},
                {.x = 0,
                 .y = 0,
                 .z = 0,
                 .intensity = 0,
                 .number = 7,
                 .of = 7,
                 .classification = 0,
                 .flags = 1,
                 .gps_time = 0,
                 .red = 0,
                 .green = 0,
                 .blue = 0}};
  return las;
}

TEST_F(ReadLas, EveryFormatOfEveryVersion) {
  for (int minor = 0; minor <= 4; ++minor) {
    for (int format = 0; format <= 10; ++format) {
      SCOPED_TRACE("1." + std::to_string(minor) + " format " + std::to_string(format));
      const LasBuilder las = three_points(minor, format);
      const PointCloud cloud = read(las.bytes());
      ASSERT_EQ(cloud.size(), 3u);
      EXPECT_EQ(cloud.site.origin, (Vec3{0, 0, 0}));
      EXPECT_EQ(cloud.positions[0], (Vec3{100 * 0.01 + 1000, -200 * 0.02 - 2000, 31.5}));
      EXPECT_EQ(cloud.positions[1], (Vec3{-2147483648.0 * 0.01 + 1000, 2147483647.0 * 0.02 - 2000, 30}));
      EXPECT_EQ(cloud.intensity, (std::vector<std::uint16_t>{65535, 1, 0}));
      EXPECT_EQ(cloud.classification, (std::vector<std::uint8_t>{2, 31, 0}));
      EXPECT_EQ(cloud.return_number, (std::vector<std::uint8_t>{1, 2, 7}));
      EXPECT_EQ(cloud.number_of_returns, (std::vector<std::uint8_t>{3, 3, 7}));
      if (LasBuilder::has_time(format))
        EXPECT_EQ(cloud.gps_time, (std::vector<double>{1.5, -2.5e8, 0}));
      else
        EXPECT_TRUE(cloud.gps_time.empty());
      if (LasBuilder::has_colour(format))
        EXPECT_EQ(cloud.colour, (std::vector<Rgb16>{{256, 2, 3}, {65535, 0, 1}, {0, 0, 0}}));
      else
        EXPECT_TRUE(cloud.colour.empty());
      EXPECT_TRUE(cloud.scalars.empty());
      EXPECT_TRUE(cloud.normals.empty());
    }
  }
}

TEST_F(ReadLas, WideFieldsOfFormat6) {
  LasBuilder las;
  las.minor = 4;
  las.format = 6;
  las.points = {{.number = 15, .of = 15, .classification = 255, .flags = 255}};
  const PointCloud cloud = read(las.bytes());
  EXPECT_EQ(cloud.return_number[0], 15);
  EXPECT_EQ(cloud.number_of_returns[0], 15);
  EXPECT_EQ(cloud.classification[0], 255);
}

TEST_F(ReadLas, MorePointsThanABlock) {
  LasBuilder las;
  las.format = 1;
  for (int i = 0; i < 30000; ++i) las.points.push_back({.x = i, .y = -i, .z = i * 7, .gps_time = i + 0.5});
  const PointCloud cloud = read(las.bytes());
  ASSERT_EQ(cloud.size(), 30000u);
  for (int i = 0; i < 30000; ++i) {
    const auto n = static_cast<std::size_t>(i);
    ASSERT_EQ(cloud.positions[n], (Vec3{i * 0.01 + 1000, -i * 0.02 - 2000, i * 7 * 0.5 + 30}));
    ASSERT_EQ(cloud.gps_time[n], i + 0.5);
  }
}

TEST_F(ReadLas, ZeroThroughoutMeansNotRecorded) {
  LasBuilder las;
  las.format = 1;
  las.points = {{.number = 0, .of = 0}, {.number = 0, .of = 0}};
  const PointCloud cloud = read(las.bytes());
  EXPECT_TRUE(cloud.intensity.empty());
  EXPECT_TRUE(cloud.return_number.empty());
  EXPECT_TRUE(cloud.number_of_returns.empty());
  EXPECT_TRUE(cloud.gps_time.empty());
  EXPECT_EQ(cloud.classification.size(), 2u);
}

TEST_F(ReadLas, EightBitColourIsWidened) {
  LasBuilder las;
  las.format = 2;
  las.points = {{.red = 255, .green = 128, .blue = 0}, {.red = 1}};
  EXPECT_EQ(read(las.bytes()).colour, (std::vector<Rgb16>{{65535, 128 * 257, 0}, {257, 0, 0}}));
  las.points[1].red = 256;  // one wide value in the whole file: all are 16-bit
  EXPECT_EQ(read(las.bytes()).colour, (std::vector<Rgb16>{{255, 128, 0}, {256, 0, 0}}));
}

TEST_F(ReadLas, TimeThatIsNotFiniteIsNoTime) {
  LasBuilder las;
  las.format = 1;
  las.points = {{.gps_time = std::numeric_limits<double>::infinity()}, {.gps_time = 3}};
  const PointCloud cloud = read(las.bytes());
  EXPECT_TRUE(std::isnan(cloud.gps_time[0]));
  EXPECT_EQ(cloud.gps_time[1], 3);
}

template <class T>
std::string raw(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

const std::vector<double>& scalar(const PointCloud& cloud, const std::string& name) {
  for (const scarp::PointScalar& s : cloud.scalars)
    if (s.name == name) return s.values;
  throw std::out_of_range("no scalar " + name);
}

TEST_F(ReadLas, ExtraBytesOfEveryType) {
  LasBuilder las;
  const std::vector<LasExtra> entries{{1, "u8"},  {2, "i8"},  {3, "u16"}, {4, "i16"}, {5, "u32"},
                                      {6, "i32"}, {7, "u64"}, {8, "i64"}, {9, "f32"}, {10, "f64"}};
  std::string payload;
  for (const LasExtra& e : entries) payload += e.bytes();
  las.records = {{"LASF_Spec", 4, payload}};
  las.points = {{.extra = raw<std::uint8_t>(200) + raw<std::int8_t>(-100) + raw<std::uint16_t>(60000) +
                          raw<std::int16_t>(-30000) + raw<std::uint32_t>(4000000000u) + raw<std::int32_t>(-2000000000) +
                          raw<std::uint64_t>(1ull << 63) + raw<std::int64_t>(-(1ll << 62)) + raw(0.25f) + raw(-1e300)}};
  const PointCloud cloud = read(las.bytes());
  const std::vector<double> expected{200,  -100,  60000, -30000, 4e9, -2e9, std::ldexp(1.0, 63), -std::ldexp(1.0, 62),
                                     0.25, -1e300};
  ASSERT_EQ(cloud.scalars.size(), entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    EXPECT_EQ(cloud.scalars[i].name, entries[i].name);
    EXPECT_EQ(cloud.scalars[i].values, std::vector<double>{expected[i]});
  }
}

TEST_F(ReadLas, ExtraBytesScaledWithNoDataArraysAndGaps) {
  LasBuilder las;
  las.records = {{"LASF_Spec", 4,
                  LasExtra{4, "height", 0.01, 5, raw<std::int64_t>(-9999), "unit: m"}.bytes() +
                      LasExtra{25, "triple"}.bytes() + LasExtra{9, "ratio", 1, 0, raw(-1.0)}.bytes()}};
  las.records[0].payload.insert(192, LasExtra{0, "opaque"}.bytes());
  las.records[0].payload[192 + 3] = 3;  // three bytes without a meaning
  const auto extra = [](std::int16_t height, std::uint32_t t, float ratio) {
    return raw(height) + "???" + raw(t) + raw(t + 1) + raw(t + 2) + raw(ratio) + "rest";
  };
  const float inf = std::numeric_limits<float>::infinity();
  las.points = {{.extra = extra(250, 7, 0.5f)}, {.extra = extra(-9999, 70, -1)}, {.extra = extra(0, 700, inf)}};
  const PointCloud cloud = read(las.bytes());
  ASSERT_EQ(cloud.scalars.size(), 5u);
  EXPECT_EQ(cloud.scalars[0].unit, "m");
  const std::vector<double>& height = scalar(cloud, "height");
  EXPECT_DOUBLE_EQ(height[0], 7.5);
  EXPECT_TRUE(std::isnan(height[1]));
  EXPECT_DOUBLE_EQ(height[2], 5);
  EXPECT_EQ(scalar(cloud, "triple0"), (std::vector<double>{7, 70, 700}));
  EXPECT_EQ(scalar(cloud, "triple2"), (std::vector<double>{9, 72, 702}));
  const std::vector<double>& ratio = scalar(cloud, "ratio");
  EXPECT_EQ(ratio[0], 0.5);
  EXPECT_TRUE(std::isnan(ratio[1]));
  EXPECT_TRUE(std::isnan(ratio[2]));
}

TEST_F(ReadLas, UnitNormalsAreNormalsOthersStayScalars) {
  LasBuilder las;
  std::string payload;
  for (const char* name : {"NormalX", "NormalY", "NormalZ"}) payload += LasExtra{9, name}.bytes();
  las.records = {{"LASF_Spec", 4, payload}};
  las.points = {{.extra = raw(0.6f) + raw(0.f) + raw(0.8f)}};
  PointCloud cloud = read(las.bytes());
  ASSERT_EQ(cloud.normals.size(), 1u);
  EXPECT_NEAR(cloud.normals[0][2], 0.8, 1e-7);
  EXPECT_TRUE(cloud.scalars.empty());
  las.points = {{.extra = raw(6.f) + raw(0.f) + raw(8.f)}};
  cloud = read(las.bytes());
  EXPECT_TRUE(cloud.normals.empty());
  EXPECT_EQ(cloud.scalars.size(), 3u);
}

const std::string kWkt =
    "PROJCS[\"Stra\xC3\x9F"
    "e / 32N\",UNIT[\"metre\",1]]\n";

TEST_F(ReadLas, CrsFromWktByteForByte) {
  LasBuilder las = three_points(4, 6);
  las.records = {{"LASF_Projection", 34735, scarp::test::geo_keys({{1024, 1}, {3072, 32632}})},
                 {"other", 2112, "PROJCS[\"not this one\"]"},
                 {"LASF_Projection", 2112, kWkt + std::string(3, '\0')}};
  EXPECT_EQ(read(las.bytes()).site.crs, kWkt);
  las.records.pop_back();
  EXPECT_EQ(read(las.bytes()).site.crs, "EPSG:32632");
  las.extended = {{"whatever", 7, "payload"}, {"LASF_Projection", 2112, kWkt + std::string(1, '\0')}};
  EXPECT_EQ(read(las.bytes()).site.crs, kWkt);
}

TEST_F(ReadLas, CrsFromGeoTiffKeys) {
  const auto crs = [&](const std::vector<std::pair<int, int>>& keys) {
    LasBuilder las = three_points(2, 0);
    las.records = {{"LASF_Projection", 34735, scarp::test::geo_keys(keys)}};
    return header(las.bytes()).crs;
  };
  EXPECT_EQ(crs({{1024, 1}, {2048, 4269}, {3072, 26915}}), "EPSG:26915");
  EXPECT_EQ(crs({{3072, 26915}}), "EPSG:26915");
  EXPECT_EQ(crs({{1024, 2}, {2048, 4326}}), "EPSG:4326");
  EXPECT_EQ(crs({{1024, 1}, {2048, 4269}, {3072, 32767}}), "");  // user-defined: not its geographic base
  EXPECT_EQ(crs({{1024, 1}, {2048, 4269}}), "");
  EXPECT_EQ(crs({}), "");
}

TEST_F(ReadLas, HeaderTellsWhatIsInside) {
  LasBuilder las = three_points(4, 7);
  las.software = "some \x01program";
  las.records = {{"LASF_Spec", 4, LasExtra{9, "amplitude"}.bytes()}};
  for (LasPoint& p : las.points) p.extra = raw(1.f);
  std::string bytes = las.bytes();
  LasHeader h = header(bytes);
  EXPECT_EQ(h.version_minor, 4);
  EXPECT_EQ(h.point_format, 7);
  EXPECT_FALSE(h.compressed);
  EXPECT_EQ(h.count, 3u);
  EXPECT_EQ(h.points_in_file, 3u);
  EXPECT_EQ(h.record_length, 40u);
  EXPECT_EQ(h.scale, (Vec3{0.01, 0.02, 0.5}));
  EXPECT_EQ(h.offset, (Vec3{1000, -2000, 30}));
  EXPECT_EQ(h.bounds.min, (Vec3{0, -3000, -970}));
  EXPECT_EQ(h.bounds.max, (Vec3{2000, -1000, 1030}));
  EXPECT_EQ(h.generating_software, "some ?program");
  ASSERT_EQ(h.extra_dimensions.size(), 1u);
  EXPECT_EQ(h.extra_dimensions[0].name, "amplitude");
  EXPECT_TRUE(h.remarks.empty());

  bytes[104] = static_cast<char>(7 | 0x80);
  h = header(bytes);
  EXPECT_TRUE(h.compressed);
  EXPECT_EQ(h.point_format, 7);
  EXPECT_NE(complaint(bytes).find("LAZ"), std::string::npos);

  bytes = las.bytes();
  put(bytes, 179, std::nan(""));
  EXPECT_TRUE(header(bytes).bounds.empty());
  EXPECT_EQ(header(bytes).remarks.size(), 1u);
}

TEST_F(ReadLas, FewerRecordsThanPromisedBeforeThePointsIsRemarked) {
  LasBuilder las = three_points(2, 0);
  las.records = {{"LASF_Projection", 34735, std::string(100, '\0')}};
  std::string bytes = las.bytes();
  put(bytes, 100, std::uint32_t{2});
  EXPECT_EQ(read(bytes).size(), 3u);
  EXPECT_NE(header(bytes).remarks.at(0).find("promises 2 variable length records, 1"), std::string::npos);
}

TEST_F(ReadLas, DamagedHeadersAreRefusedWithTheByte) {
  const std::string good = three_points(4, 7).bytes();
  const auto with = [&](std::size_t at, auto value) {
    std::string bytes = good;
    put(bytes, at, value);
    return complaint(bytes);
  };
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_NE(with(0, 'X').find("byte 0: not a LAS file"), std::string::npos);
  EXPECT_NE(with(24, std::uint8_t{2}).find("byte 24: LAS version: found 2.4"), std::string::npos);
  EXPECT_NE(with(25, std::uint8_t{5}).find("found 1.5; allowed: 1.0 to 1.4"), std::string::npos);
  EXPECT_NE(with(94, std::uint16_t{227}).find("byte 94: header size: found 227"), std::string::npos);
  EXPECT_NE(with(96, std::uint32_t{10}).find("byte 96: offset to the points"), std::string::npos);
  EXPECT_NE(with(96, std::uint32_t{100000}).find("truncated"), std::string::npos);
  EXPECT_NE(with(100, std::uint32_t{1069128089}).find("byte 100: number of variable length"), std::string::npos);
  EXPECT_NE(with(104, std::uint8_t{11}).find("byte 104: point format: found 11"), std::string::npos);
  EXPECT_NE(with(105, std::uint16_t{35}).find("found 35 bytes; allowed: at least 36"), std::string::npos);
  EXPECT_NE(with(131, 0.0).find("byte 131: coordinate scale: found 0"), std::string::npos);
  EXPECT_NE(with(139, inf).find("byte 139"), std::string::npos);
  EXPECT_NE(with(147, 1e308).find("byte 147"), std::string::npos);
  EXPECT_NE(with(155, -inf).find("byte 155: coordinate offset"), std::string::npos);
  EXPECT_NE(with(243, std::uint32_t{1}).find("byte 235: truncated"), std::string::npos);
  EXPECT_NE(with(247, ~std::uint64_t{0}).find("header promises 18446744073709551615 points, the file holds 3"),
            std::string::npos);
  EXPECT_NE(with(247, std::uint64_t{4}).find("header promises 4 points, the file holds 3"), std::string::npos);
}

TEST_F(ReadLas, RecordsThatDoNotFitAreRefused) {
  LasBuilder las = three_points(4, 0);
  las.records = {{"LASF_Projection", 2112, "WKT"}};
  std::string bytes = las.bytes();
  put(bytes, 375 + 20, std::uint16_t{60000});
  EXPECT_NE(complaint(bytes).find("length of variable length record 0: found 60000"), std::string::npos);

  las.records = {{"LASF_Spec", 4, LasExtra{10, "wide"}.bytes()}};  // the points have no room for it
  EXPECT_NE(complaint(las.bytes()).find("which the described extra bytes need"), std::string::npos);

  las.records.clear();
  las.extended = {{"LASF_Projection", 2112, "WKT"}};
  bytes = las.bytes();
  put(bytes, bytes.size() - 3 - 60 + 20, ~std::uint64_t{0});
  EXPECT_NE(complaint(bytes).find("length of extended record 0"), std::string::npos);
}

TEST_F(ReadLas, WhatIsNotAFileIsRefused) {
  EXPECT_THROW(scarp::read_las(folder_.path()), Error);
  EXPECT_THROW(scarp::read_las(folder_.path() / "absent.las"), Error);
  EXPECT_THROW(scarp::read_las("/dev/zero"), Error);
  EXPECT_NE(complaint("").find("not a LAS file"), std::string::npos);
}

TEST_F(ReadLas, TruncationAnywhereIsRefused) {
  LasBuilder las = three_points(4, 7);
  las.records = {{"LASF_Projection", 2112, kWkt}, {"LASF_Spec", 4, LasExtra{9, "amplitude"}.bytes()}};
  for (LasPoint& p : las.points) p.extra = raw(1.f);
  las.extended = {{"notes", 1, "text"}};
  const std::string whole = las.bytes();
  EXPECT_EQ(read(whole).size(), 3u);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(read(whole.substr(0, length)), Error) << length << " of " << whole.size();

  las.extended.clear();
  const std::string plain = las.bytes();
  for (std::size_t length = las.data_offset() + 1; length < plain.size(); ++length)
    EXPECT_NE(complaint(plain.substr(0, length)).find("truncated: header promises 3 points"), std::string::npos);
  // A bare header is how some tools store "no points"; the promise is remarked.
  const std::string bare = plain.substr(0, las.data_offset());
  EXPECT_TRUE(read(bare).empty());
  EXPECT_EQ(header(bare).count, 3u);
  EXPECT_EQ(header(bare).points_in_file, 0u);
  EXPECT_EQ(header(bare).remarks.size(), 1u);
}

TEST_F(ReadLas, RandomDamageIsReadOrRefused) {
  LasBuilder las = three_points(4, 7);
  las.records = {{"LASF_Projection", 34735, scarp::test::geo_keys({{1024, 1}, {3072, 32632}})},
                 {"LASF_Spec", 4, LasExtra{9, "amplitude"}.bytes() + LasExtra{24, "v", 0.5, 1}.bytes()}};
  for (LasPoint& p : las.points) p.extra = raw(1.f) + std::string(6, 'v');
  las.extended = {{"LASF_Projection", 2112, kWkt}};
  const std::string good = las.bytes();
  std::mt19937_64 random(20240607);
  int were_read = 0, were_refused = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::string bytes = good;
    for (int flips = 1 + static_cast<int>(random() % 4); flips > 0; --flips) {
      const std::size_t at = random() % bytes.size();
      bytes[at] = static_cast<char>(random() % 2 ? random() : bytes[at] ^ (1 << random() % 8));
    }
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    try {
      const PointCloud cloud = read(bytes);
      for (const Vec3& p : cloud.positions) ASSERT_TRUE(scarp::is_finite(p));
      ++were_read;
    } catch (const Error&) {
      ++were_refused;
    }
  }
  EXPECT_GT(were_read, 500);
  EXPECT_GT(were_refused, 500);
}

TEST_F(ReadLas, SampleFiles) {
  SCARP_NEED_DATA();
  const std::filesystem::path data = scarp::test::data_folder();
  const std::filesystem::path zoo = data / "als_truth_and_formats" / "formats";
  const std::vector<std::pair<std::filesystem::path, std::size_t>> counts{
      {zoo / "1.2-with-color.las", 1065},
      {zoo / "bad_vlr_count.las", 10},
      {zoo / "extrabytes.las", 1065},
      {zoo / "gps-time-nan.las", 1},
      {zoo / "laspy_1_4_w_evlr.las", 1000},
      {zoo / "lots_of_vlr.las", 1},
      {zoo / "mvk-thin.las", 6280},
      {zoo / "perm_1.0_0.las", 1},
      {zoo / "perm_1.0_1.las", 1},
      {zoo / "perm_1.1_0.las", 1},
      {zoo / "perm_1.2-no-points.las", 0},
      {zoo / "perm_1.2_0.las", 1},
      {zoo / "perm_1.2_1.las", 1},
      {zoo / "perm_1.2_2.las", 1},
      {zoo / "perm_1.2_3.las", 1},
      {zoo / "test1_4.las", 1000},
      {data / "multi_epoch" / "bmx" / "autzen-bmx-2010.las", 829},
      {data / "multi_epoch" / "bmx" / "autzen-bmx-2023.las", 687}};
  for (const auto& [path, count] : counts) {
    SCOPED_TRACE(path.filename());
    const PointCloud cloud = scarp::read_las(path);
    EXPECT_EQ(cloud.size(), count);
    const scarp::Box3 stated = scarp::read_las_header(path).bounds, found = scarp::bounds(cloud.positions);
    // One-point files of the zoo keep the bounds of the file that they were cut from.
    for (std::size_t a = 0; a < 3 && count > 10; ++a) {
      EXPECT_NEAR(found.min[a], stated.min[a], 0.011);
      EXPECT_NEAR(found.max[a], stated.max[a], 0.011);
    }
  }
  EXPECT_THROW(scarp::read_las(zoo / "garbage_nVariableLength.las"), Error);
}

TEST_F(ReadLas, SampleDetails) {
  SCARP_NEED_DATA();
  const std::filesystem::path data = scarp::test::data_folder();
  const std::filesystem::path zoo = data / "als_truth_and_formats" / "formats";
  EXPECT_EQ(scarp::read_las_header(zoo / "perm_1.2_3.las").crs, "EPSG:26915");
  EXPECT_EQ(scarp::read_las_header(zoo / "bad_vlr_count.las").crs, "EPSG:32617");
  EXPECT_EQ(scarp::read_las_header(zoo / "bad_vlr_count.las").remarks.size(), 1u);
  const std::string wkt = scarp::read_las_header(data / "multi_epoch" / "bmx" / "autzen-bmx-2023.las").crs;
  EXPECT_TRUE(wkt.starts_with("COMPD_CS[\"NAD83 / Oregon LCC (m)"));
  EXPECT_EQ(wkt.back(), ']');
  EXPECT_TRUE(std::isnan(scarp::read_las(zoo / "gps-time-nan.las").gps_time.at(0)));

  const PointCloud plain = scarp::read_las(zoo / "1.2-with-color.las"), extra = scarp::read_las(zoo / "extrabytes.las");
  EXPECT_EQ(plain.positions, extra.positions);
  // This file repeats its 8-bit colours in the extra bytes.
  for (const std::size_t i : {0, 7, 1000}) {
    EXPECT_EQ(scalar(extra, "Colors0")[i] * 257, extra.colour[i][0]);
    EXPECT_EQ(scalar(extra, "Colors2")[i] * 257, extra.colour[i][2]);
  }
}

}  // namespace

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_laz.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>

#include "ingest/read_las.hpp"
#include "solver/model/error.hpp"
#include "tests/support/test_data.hpp"
#include "tests/unit/ingest/las_builder.hpp"

namespace {

namespace fs = std::filesystem;
using scarp::Error;
using scarp::LazConverter;
using scarp::PointCloud;

#define SCARP_NEED_CONVERTER()                                                    \
  if (!fs::exists(converter_.script.parent_path() / "node_modules" / "laz-perf")) \
  GTEST_SKIP() << "no LAZ converter: run npm ci --prefix " << converter_.script.parent_path().string()

class ReadLaz : public testing::Test {
 protected:
  ReadLaz() : converter_(scarp::default_laz_converter()) { converter_.scratch = scratch_.path(); }
  ~ReadLaz() override { EXPECT_TRUE(fs::is_empty(scratch_.path())) << "a temporary folder was left behind"; }

  std::string complaint(const fs::path& file) const {
    try {
      scarp::read_laz(file, converter_);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
      return error.what();
    }
    ADD_FAILURE() << file << " was read without complaint";
    return {};
  }

  /// A LAZ header without LAZ data.
  fs::path hollow(std::uint32_t count = 1) const {
    scarp::test::LasBuilder las;
    las.points.resize(1);
    std::string bytes = las.bytes();
    bytes[104] = static_cast<char>(0x80);
    scarp::test::put(bytes, 107, count);
    return scarp::test::save(folder_.path() / "hollow.laz", bytes);
  }

  scarp::test::TemporaryFolder folder_, scratch_;
  LazConverter converter_;
};

TEST_F(ReadLaz, PlainLasUnderTheNameNeedsNoConverter) {
  scarp::test::LasBuilder las;
  las.points = {{.x = 5}, {.x = 6}};
  converter_.script = "/nonexistent/laz2las.mjs";
  EXPECT_EQ(scarp::read_laz(scarp::test::save(folder_.path() / "plain.laz", las.bytes()), converter_).size(), 2u);
}

TEST_F(ReadLaz, WhatIsMissingIsNamedWithTheCommand) {
  converter_.script = folder_.path() / "absent.mjs";
  EXPECT_NE(complaint(hollow()).find("absent.mjs, which does not exist"), std::string::npos);

  converter_ = scarp::default_laz_converter();
  converter_.scratch = scratch_.path();
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nonexistent", 1);
  const std::string without_node = complaint(hollow());
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(without_node.find("Node.js"), std::string::npos) << without_node;
  EXPECT_NE(without_node.find("npm ci --prefix " + converter_.script.parent_path().string()), std::string::npos);
}

TEST_F(ReadLaz, MissingPackageIsNamedWithTheCommand) {
  SCARP_NEED_CONVERTER();
  const fs::path lone = folder_.path() / "laz2las.mjs";
  fs::copy_file(converter_.script, lone);
  converter_.script = lone;
  EXPECT_NE(complaint(hollow()).find("npm ci --prefix " + folder_.path().string()), std::string::npos);
}

TEST_F(ReadLaz, DamageIsReportedWithTheReason) {
  SCARP_NEED_CONVERTER();
  EXPECT_NE(complaint(hollow()).find("cannot be decompressed: compressed, but without a LASzip record"),
            std::string::npos);
  converter_.scratch = folder_.path() / "absent";
  EXPECT_NE(complaint(hollow()).find("cannot create a temporary folder"), std::string::npos);
}

TEST_F(ReadLaz, AConverterThatRunsWildIsContained) {
  SCARP_NEED_CONVERTER();  // that is, node
  converter_.script = folder_.path() / "wild.mjs";
  scarp::test::save(converter_.script,
                    "for (let i = 0; i < 3000; ++i) process.stderr.write('x'.repeat(999) + '\\n');"
                    "process.stderr.write('laz2las: the end\\n'); process.exitCode = 2;");
  EXPECT_NE(complaint(hollow()).find("cannot be decompressed: the end"), std::string::npos);
  scarp::test::save(converter_.script, "process.kill(process.pid, 'SIGKILL'); setTimeout(() => {}, 5000);");
  EXPECT_NE(complaint(hollow()).find("stopped by signal 9"), std::string::npos);
  scarp::test::save(converter_.script, "// does nothing");
  EXPECT_NE(complaint(hollow()).find("no such file"), std::string::npos);
}

TEST_F(ReadLaz, SampleFiles) {
  SCARP_NEED_DATA();
  SCARP_NEED_CONVERTER();
  const fs::path data = scarp::test::data_folder(), als = data / "als_truth_and_formats";
  const std::vector<std::pair<fs::path, std::size_t>> counts{{als / "samp51-utm.laz", 17845},
                                                             {als / "samp53-utm.laz", 34378},
                                                             {als / "samp61-utm.laz", 35060},
                                                             {data / "rockslope_wall" / "small_mask.laz", 3065},
                                                             {data / "rockslope_wall" / "vasp_in_5k_utm33.laz", 5066},
                                                             {data / "rockslope_wall" / "vapc_in.laz", 547662}};
  for (const auto& [path, count] : counts) {
    SCOPED_TRACE(path.filename());
    const PointCloud cloud = scarp::read_laz(path, converter_);
    EXPECT_EQ(cloud.size(), count);
    const scarp::LasHeader header = scarp::read_las_header(path);
    EXPECT_TRUE(header.compressed);
    EXPECT_EQ(header.count, count);
    EXPECT_EQ(cloud.site.crs, header.crs);
    const scarp::Box3 box = scarp::bounds(cloud.positions);
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_NEAR(box.min[a], header.bounds.min[a], 1e-4);
      EXPECT_NEAR(box.max[a], header.bounds.max[a], 1e-4);
    }
  }
  EXPECT_EQ(scarp::read_las_header(als / "samp53-utm.laz").count, 34378u);
  EXPECT_EQ(scarp::read_las_header(als / "FSite5_orig-utm.laz").count, 628320u);
  const PointCloud vasp = scarp::read_laz(data / "rockslope_wall" / "vasp_in_5k_utm33.laz", converter_);
  ASSERT_EQ(vasp.scalars.size(), 1u);
  EXPECT_EQ(vasp.scalars[0].name, "point_count");
}

TEST_F(ReadLaz, PairsOfLazAndLasAgree) {
  SCARP_NEED_DATA();
  SCARP_NEED_CONVERTER();
  const fs::path zoo = scarp::test::data_folder() / "als_truth_and_formats" / "formats";
  for (const auto& [laz, las] :
       std::vector<std::pair<std::string, std::string>>{{"simple.laz", "1.2-with-color.las"},
                                                        {"laspy_extra.laz", "extrabytes.las"},
                                                        {"laspy_1_4_w_evlr.laz", "laspy_1_4_w_evlr.las"}}) {
    SCOPED_TRACE(laz);
    const PointCloud a = scarp::read_laz(zoo / laz, converter_), b = scarp::read_las(zoo / las);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.colour, b.colour);
    EXPECT_EQ(a.gps_time, b.gps_time);
    EXPECT_EQ(a.intensity, b.intensity);
    EXPECT_EQ(a.classification, b.classification);
    EXPECT_EQ(a.scalars.size(), b.scalars.size());
  }
}

TEST_F(ReadLaz, CopcHoldsThePointsOfItsLasInAnotherOrder) {
  SCARP_NEED_DATA();
  SCARP_NEED_CONVERTER();
  const fs::path zoo = scarp::test::data_folder() / "als_truth_and_formats" / "formats";
  const PointCloud copc = scarp::read_laz(zoo / "1.2-with-color.copc.laz", converter_);
  const PointCloud las = scarp::read_las(zoo / "1.2-with-color.las");
  ASSERT_EQ(copc.size(), las.size());
  EXPECT_TRUE(copc.site.crs.starts_with("COMPD_CS["));
  // The COPC was made from a reprojected copy (feet to metres): time and colour are the point's identity.
  const auto identities = [](const PointCloud& cloud) {
    std::vector<std::pair<double, scarp::Rgb16>> all;
    for (std::size_t i = 0; i < cloud.size(); ++i) all.emplace_back(cloud.gps_time[i], cloud.colour[i]);
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(identities(copc), identities(las));
}

TEST_F(ReadLaz, DamagedSamplesAreReadOrRefused) {
  SCARP_NEED_DATA();
  SCARP_NEED_CONVERTER();
  const fs::path zoo = scarp::test::data_folder() / "als_truth_and_formats" / "formats";
  const std::string good = scarp::test::load_file(zoo / "simple.laz");
  const fs::path file = folder_.path() / "damaged.laz";
  for (const std::size_t length : {std::size_t{330}, good.size() - 1})
    EXPECT_FALSE(complaint(scarp::test::save(file, good.substr(0, length))).empty());
  std::string bytes = good;
  for (std::size_t i = 400; i < 440; ++i) bytes[i] = static_cast<char>(bytes[i] ^ 0x55);
  EXPECT_NE(complaint(scarp::test::save(file, bytes)).find("damaged at point"), std::string::npos);
  bytes = good;
  scarp::test::put(bytes, 107, std::uint32_t{60000});
  EXPECT_NE(complaint(scarp::test::save(file, bytes)).find("60000 points promised in 1 chunks"), std::string::npos);
  bytes = good;
  scarp::test::put(bytes, 107, std::uint32_t{4000000000u});
  EXPECT_FALSE(complaint(scarp::test::save(file, bytes)).empty());
}

}  // namespace

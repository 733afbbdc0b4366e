// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_raster.hpp"

#include <cmath>

#include "tests/unit/ingest/format_samples.hpp"

namespace scarp {
namespace {

using test::Files;
using test::message_of;

TEST(ReadRaster, CornerIsHalfACellFromTheFirstCentreAndNorthComesFirst) {
  Files files;
  const auto path = files.put("a.asc",
                              "NCOLS 3\r\nnrows\t2\r\nXLLCORNER 597195.5\r\nyllcorner 5412345.25\r\ncellsize 2\r\n"
                              "NODATA_value -9999\r\n1 2 3\r\n4 -9999 6.5\r\n");
  files.put("a.prj", "PROJCS[\"any\"]\n");
  const Heightfield field = read_raster(path);
  EXPECT_EQ(field.columns, 3);
  EXPECT_EQ(field.rows, 2);
  EXPECT_EQ(field.x0, 597196.5);
  EXPECT_EQ(field.y0, 5412346.25);
  EXPECT_EQ(field.at(0, 0), 4);
  EXPECT_EQ(field.at(2, 1), 3);
  EXPECT_TRUE(std::isnan(field.at(1, 0)));
  EXPECT_EQ(field.site.crs, "PROJCS[\"any\"]");
  const PointCloud cloud = raster_to_cloud(field);
  EXPECT_EQ(cloud.positions, (std::vector<Vec3>{{597196.5, 5412346.25, 4},
                                                {597200.5, 5412346.25, 6.5},
                                                {597196.5, 5412348.25, 1},
                                                {597198.5, 5412348.25, 2},
                                                {597200.5, 5412348.25, 3}}));
  EXPECT_EQ(cloud.site.crs, field.site.crs);
}

TEST(ReadRaster, CentreNanNodataAndAnyLineBreaks) {
  Files files;
  const Heightfield field = read_raster(files.put(
      "a.asc", "nrows 2\nncols 2\nxllcenter 10\nyllcenter 20\ndx 5\ndy 5.0\nnodata_value nan\n1\n2 nan\n\n4"));
  EXPECT_EQ(field.x0, 10);
  EXPECT_EQ(field.y0, 20);
  EXPECT_EQ(field.cell, 5);
  EXPECT_EQ(field.at(0, 1), 1);
  EXPECT_EQ(field.at(1, 0), 4);
  EXPECT_TRUE(std::isnan(field.at(0, 0)));
  EXPECT_TRUE(field.site.crs.empty());
  // The most negative float, as different programs print it.
  const Heightfield low = read_raster(
      files.put("b.asc",
                "ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\nnodata_value -3.4028234663852886e+38\n"
                "-3.40282347e+38 7\n"));
  EXPECT_TRUE(std::isnan(low.at(0, 0)));
  EXPECT_EQ(low.at(1, 0), 7);
}

TEST(ReadRaster, ErrorsNameThePlace) {
  Files files;
  const std::string good = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n";
  const auto says = [&](const std::string& from, const std::string& to, const std::string& text) {
    std::string bytes = good;
    bytes.replace(bytes.find(from), from.size(), to);
    const auto path = files.put("a.asc", bytes);
    const std::string message = message_of([&] { read_raster(path); });
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  says("3 4\n", "3.25\n", "holds fewer values than its header promises: found 3; allowed: 4");
  says("3 4\n", "3 4 5\n", "a.asc:7: raster holds more values");
  says("3 4", "3 x", "a.asc:7:3: not a number: found 'x'");
  says("3 4", "3 inf", "a.asc:7: height in a raster: found inf; allowed: finite");
  says("ncols 2", "ncols 2147483647", "a.asc:2: raster header promises more cells than the file can hold");
  says("ncols 2", "ncols -2", "a.asc:1: header word ncols: found -2");
  says("ncols 2", "ncols 2.5", "header word ncols: found 2.5");
  says("ncols 2", "ncols two", "a.asc:1: header word ncols: found 'two'");
  says("cellsize 1", "cellsize 0", "a.asc:5: cell size of a raster: found 0");
  says("cellsize 1", "dx 1\ndy 2", "a.asc:6: cells of a raster that are not squares: found 1 x 2");
  says("cellsize 1\n", "", "without cellsize");
  says("xllcorner 0", "xllcorner 0\nxllcenter 0", "both words");
  says("xllcorner 0\n", "", "neither word; allowed: xllcorner or xllcenter");
  says("nrows 2", "ncols 2", "header word ncols is there twice");
  says("nrows 2", "rows 2", "a.asc:2:1: unknown word in the header");
  says("1 2\n3 4\n", "", "without values");
}

TEST(ReadRaster, RealFiles) {
  SCARP_NEED_DATA();
  const Heightfield bragg = read_raster(test::data_folder() / "multi_epoch/ftbragg/elevation_2004.asc");
  EXPECT_EQ(bragg.columns, 450);
  EXPECT_EQ(bragg.rows, 450);
  EXPECT_EQ(bragg.x0, 597195.5);
  EXPECT_EQ(bragg.at(0, 449), 111.649);  // the first value of the file: north-west
  EXPECT_TRUE(bragg.site.crs.starts_with("PROJCS[\"NAD_1983_HARN"));
  const Heightfield coulomb = read_raster(test::data_folder() / "isee_coulomb/DEM_CoulombOnly.asc");
  EXPECT_EQ(coulomb.columns, 1001);
  EXPECT_EQ(coulomb.x0, 1000);
  EXPECT_EQ(coulomb.at(0, 300), 1509.19125);
  const Heightfield loess = read_raster(test::data_folder() / "heifangtai_dc7/dc7_dem_1411slide.txt");
  EXPECT_EQ(loess.columns, 231);
  EXPECT_EQ(raster_to_cloud(loess).size(), 60224u);
}

}  // namespace
}  // namespace scarp

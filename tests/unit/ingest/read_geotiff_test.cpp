// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_geotiff.hpp"

#include <cmath>
#include <limits>

#include "ingest/crs_text.hpp"
#include "ingest/read_raster.hpp"
#include "tests/unit/ingest/format_samples.hpp"

namespace scarp {
namespace {

using test::Files;
using test::message_of;

TEST(ReadGeotiff, CentresNoDataAndReferenceSystem) {
  Files files;
  const Heightfield field = read_raster(files.put("any.name", test::geotiff_sample()));
  ASSERT_EQ(field.columns, 2);
  ASSERT_EQ(field.rows, 2);
  EXPECT_EQ(field.cell, 2);
  EXPECT_EQ(field.x0, 500001);
  EXPECT_EQ(field.y0, 5400001);
  EXPECT_EQ(field.at(0, 1), 1) << "the file begins in the north";
  EXPECT_EQ(field.at(1, 1), 2);
  EXPECT_TRUE(std::isnan(field.at(0, 0)));
  EXPECT_EQ(field.at(1, 0), 4);
  EXPECT_EQ(read_crs(field.site.crs).epsg, 25832) << field.site.crs;
}

TEST(ReadGeotiff, RefusesWhatIsNoRasterOfHeights) {
  Files files;
  const auto says = [&](const test::TiffChanges& change, const std::string& text) {
    const auto path = files.put("a.tif", test::geotiff_sample(change));
    const std::string message = message_of([&] { read_raster(path); });
    EXPECT_NE(message.find("a.tif: "), std::string::npos) << message;
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  says({.pixel_height = 3}, "not squares, north up: found 2 x 3");
  says({.bands = 2}, "bands of a raster of heights: found 2; allowed: 1");
  says({.last = std::numeric_limits<float>::infinity()}, "height in a raster: found inf");
  says({.georeferenced = false}, "TIFF without a georeference");
  const std::string whole = test::geotiff_sample();
  const auto cut = files.put("a.tif", whole.substr(0, 190));
  EXPECT_NE(message_of([&] { read_raster(cut); }).find("a.tif: "), std::string::npos);
}

TEST(ReadGeotiff, RealFilesInPlainAndCompressedForm) {
  SCARP_NEED_DATA();
  const auto folder = test::data_folder() / "multi_epoch/ftbragg";
  const Heightfield plain = read_raster(folder / "elevation_2016.tif");
  const Heightfield packed = read_raster(folder / "elevation_2016_deflate_pred3.tif");
  EXPECT_EQ(plain.z, packed.z);
  EXPECT_EQ(read_crs(plain.site.crs).epsg, 3358);
  // The grid of the same year's text, whose numbers have fewer digits.
  const Heightfield first = read_raster(folder / "elevation_2004.tif");
  const Heightfield text = read_raster(folder / "elevation_2004.asc");
  ASSERT_EQ(first.z.size(), text.z.size());
  EXPECT_EQ(first.x0, text.x0);
  EXPECT_EQ(first.y0, text.y0);
  for (std::size_t i = 0; i < text.z.size(); ++i) ASSERT_NEAR(first.z[i], text.z[i], 1e-3);
}

}  // namespace
}  // namespace scarp

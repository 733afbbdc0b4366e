// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_text.hpp"

#include <cmath>

#include "tests/unit/ingest/format_samples.hpp"

namespace scarp {
namespace {

using test::Files;
using test::message_of;

TEST(ReadText, EverySeparator) {
  Files files;
  const std::vector<Vec3> expected{{691234.125, 5412345.6789, 812.5}, {-1, 2e-3, 3}};
  for (std::string bytes :
       {"691234.125 5412345.6789 812.5\n-1 2e-3 3\n", "  691234.125\t5412345.6789   812.5\n-1 2e-3 3",
        "691234.125,5412345.6789,812.5\r\n-1,2e-3,3\r\n", "691234.125, 5412345.6789 ,812.5,\n-1,2e-3,3\n",
        "691234.125;5412345.6789;812.5\n\n-1;2e-3;+3\n", "# any\n// thing\n691234.125 5412345.6789 812.5\n#\n-1 2e-3 3",
        "\xEF\xBB\xBF"
        "691234.125 5412345.6789 812.5\n-1 2e-3 3\n",
        "2\n691234.125 5412345.6789 812.5\n-1 2e-3 3\n", "1\n691234.125 5412345.6789 812.5\n1\n-1 2e-3 3\n"})
    EXPECT_EQ(read_text(files.put("a.xyz", bytes)).positions, expected) << bytes;
}

TEST(ReadText, NamedColumns) {
  Files files;
  const auto cloud = read_text(
      files.put("a.csv",
                "\"Northing\",Easting [m],Elevation,R,G,B,Classification,intensity,nx,ny,nz,distance [mm],id\n"
                "2,1,3,255,0,1,2,65535,0,0,1,0.5,\n5,4,6,0,0,0,6,0,0,1,0,,9\n"));
  EXPECT_EQ(cloud.positions, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.colour[0], (Rgb16{65535, 0, 257}));
  EXPECT_EQ(cloud.classification, (std::vector<std::uint8_t>{2, 6}));
  EXPECT_EQ(cloud.intensity, (std::vector<std::uint16_t>{65535, 0}));
  EXPECT_EQ(cloud.normals[1], (Vec3{0, 1, 0}));
  ASSERT_EQ(cloud.scalars.size(), 2u);
  EXPECT_EQ(cloud.scalars[0].name, "distance");
  EXPECT_EQ(cloud.scalars[0].unit, "mm");
  EXPECT_TRUE(std::isnan(cloud.scalars[0].values[1]));
  EXPECT_TRUE(std::isnan(cloud.scalars[1].values[0]));
  EXPECT_EQ(cloud.scalars[1].values[1], 9);
}

TEST(ReadText, NamesInAComment) {
  Files files;
  const auto cloud = read_text(files.put("a.asc", "//X Y Z Height Time\n3\n1 2 3 4 5\n1 2 3 4 5\n1 2 3 4 5\n"));
  ASSERT_EQ(cloud.scalars.size(), 2u);
  EXPECT_EQ(cloud.scalars[0].name, "Height");  // a name for z only where there is no z
  EXPECT_EQ(cloud.scalars[1].values[2], 5);
  EXPECT_EQ(read_text(files.put("b.asc", "# x y z of the survey\n1 2 3\n")).size(), 1u);
}

TEST(ReadText, ColumnsWithoutNames) {
  Files files;
  const auto six = read_text(files.put("a.xyz", "1 2 3 255 0 1\n1 2 3 4 5 6\n"));
  EXPECT_EQ(six.colour[0], (Rgb16{65535, 0, 257}));
  const auto no_colour = read_text(files.put("b.xyz", "1 2 3 255 0 1\n1 2 3 4 5 256\n"));
  EXPECT_TRUE(no_colour.colour.empty());
  ASSERT_EQ(no_colour.scalars.size(), 3u);
  EXPECT_EQ(no_colour.scalars[2].name, "column_6");
  const auto pts = read_text(files.put("c.pts", "2\n1 2 3 -1035 97 59 38\n1 2 3 -2000 1 1 1\n"));
  EXPECT_EQ(pts.colour.size(), 2u);
  EXPECT_TRUE(pts.intensity.empty());
  EXPECT_EQ(pts.scalars.at(0).name, "intensity");
  EXPECT_EQ(pts.scalars[0].values, (std::vector<double>{-1035, -2000}));
  EXPECT_EQ(read_text(files.put("d.pts", "1\n1 2 3 77\n")).intensity.at(0), 77);
  EXPECT_EQ(read_text(files.put("e.xyz", "1 2 3 77\n")).scalars.at(0).name, "column_4");
}

TEST(ReadText, ErrorsNameThePlace) {
  Files files;
  const auto says = [&](const std::string& bytes, const std::string& text) {
    const auto path = files.put("a.txt", bytes);
    const std::string message = message_of([&] { read_text(path); });
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  says("1 2 3\n4 5 foo\n", "a.txt:2:5: not a number: found 'foo'");
  says("1 2 3\n4 5\n", "a.txt:2: line with another number of columns than the lines before it: found 2; allowed: 3");
  says("1,2,3\n4,5,6,7\n", "a.txt:2: line with another");
  says("1,2,3\n4,5,6,,\n", "a.txt:2: line with another");
  says("1,2,3\n4,5 5,6\n", "a.txt:2:3: decimal comma");
  says("1,5 2,5 3,5\n", "a.txt:1:3: decimal comma");
  says("691234,125\t5412345,6789\t812,5\n", "a.txt:1:8: decimal comma");
  says("1,5;2,5;3,5\n", "a.txt:1:1: decimal comma, or two kinds of separator in one line: found '1,5'");
  says("1 2\n", "too few columns");
  says("", "holds no points");
  says("x y z\n", "holds no points");
  says("# nothing\n\n", "holds no points");
  says("x y w\n1 2 3\n", "a.txt:1: no column holds z: found 'x' 'y' 'w'");
  says("x y z x\n1 2 3 4\n", "two columns have the same name");
  says("x,X,y,z\n1,2,3,4\n", "two columns hold the same coordinate");
  says("3\n1 2 3\n", "file holds fewer points than its count line promises: found 1; allowed: 3");
  says("1\n1 2 3\n4 5 6\n", "a.txt:3: file holds more points than its count line promises");
  says("1 2 3\n4 5 1e999\n", "a.txt:2:5: not a number");
  says(std::string("1 2 3\n4 \0 5\n", 12), "a.txt:2:3: not a number: found '?'");
}

TEST(ReadText, LinesAcrossTheBlocksOfTheReader) {
  Files files;
  std::string bytes;
  std::vector<Vec3> expected;
  for (int i = 0; i < 60000; ++i) {
    expected.push_back({691234.125 + i, 5412345.6789 + 0.001 * i, 1.0 / (i + 1)});
    bytes += shortest(expected[i][0]) + " " + shortest(expected[i][1]) + " " + shortest(expected[i][2]) + "\n";
  }
  ASSERT_GT(bytes.size(), std::size_t{2} << 20);
  EXPECT_EQ(read_text(files.put("a.xyz", bytes)).positions, expected);
  // One line longer than a block.
  const auto wide = read_text(files.put("b.xyz", "1 2" + std::string(3 << 20, ' ') + "3\n4 5 6\n"));
  EXPECT_EQ(wide.positions, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
}

TEST(ReadText, RealFiles) {
  SCARP_NEED_DATA();
  const auto cloud = read_text(test::data_folder() / "multi_epoch/ftbragg/points_2004.xyz");
  EXPECT_EQ(cloud.size(), 42388u);
  EXPECT_EQ(cloud.positions[0], (Vec3{597227.81, 150671.68, 108.25}));
  const auto pts = read_text(test::data_folder() / "als_truth_and_formats/formats/test.pts");
  EXPECT_EQ(pts.size(), 19u);
  EXPECT_EQ(pts.colour[0], (Rgb16{97 * 257, 59 * 257, 38 * 257}));
  EXPECT_EQ(pts.scalars.at(0).values[0], -1035);
  EXPECT_EQ(read_text(test::data_folder() / "multi_epoch/bmx/autzen-bmx-cores.txt").size(), 3u);
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_pcd.hpp"

#include <cmath>
#include <limits>

#include "ingest/lzf.hpp"
#include "tests/unit/ingest/format_samples.hpp"

namespace scarp {
namespace {

using test::Bytes;
using test::Files;
using test::message_of;

constexpr std::string_view kUtmHeader =
    "VERSION 0.7\nFIELDS X Y Z _ Intensity\nSIZE 8 8 8 1 2\nTYPE F F F U U\nCOUNT 1 1 1 3 1\nWIDTH 2\nHEIGHT 2\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA ";

double utm(int i, int axis) { return (axis == 0 ? 691234.125 : axis == 1 ? 5412345.6789 : 812.5) + 0.01 * i; }

void expect_utm(const PointCloud& cloud) {
  ASSERT_EQ(cloud.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    for (int a = 0; a < 3; ++a) EXPECT_EQ(cloud.positions[i][a], utm(i, a));
    EXPECT_EQ(cloud.intensity[i], 1000 * i);
  }
  EXPECT_TRUE(cloud.scalars.empty());
}

TEST(ReadPcd, DoublesInAsciiBinaryAndCompressed) {
  Files files;
  std::string ascii(kUtmHeader);
  Bytes binary(kUtmHeader), columns;
  ascii += "ascii\n";
  binary.text("binary\n");
  for (int i = 0; i < 4; ++i) {
    for (int a = 0; a < 3; ++a) {
      ascii += shortest(utm(i, a)) + " ";
      binary.little(utm(i, a));
    }
    ascii += "0 0 0 " + std::to_string(1000 * i) + "\n";
    binary.text("abc").little(static_cast<std::uint16_t>(1000 * i));
  }
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 4; ++i) columns.little(utm(i, a));
  columns.text("abcabcabcabc");
  for (int i = 0; i < 4; ++i) columns.little(static_cast<std::uint16_t>(1000 * i));
  const std::string block = test::compress_lzf(columns.string());
  Bytes compressed(kUtmHeader);
  compressed.text("binary_compressed\n").little(static_cast<std::uint32_t>(block.size()));
  compressed.little(static_cast<std::uint32_t>(columns.string().size())).text(block);

  expect_utm(read_pcd(files.put("a.pcd", ascii)));
  expect_utm(read_pcd(files.put("b.pcd", binary.string())));
  expect_utm(read_pcd(files.put("c.pcd", compressed.string())));
}

TEST(ReadPcd, PackedColourWhateverItsType) {
  Files files;
  const auto header = [](char type, const char* data) {
    return std::string("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F ") + type +
           "\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA " + data + "\n";
  };
  const Rgb16 expected{0xFFFF, 0x8080, 0x0101};
  // As floats both are NaN, and the second a signalling one, which a conversion would change.
  const auto quiet = Bytes(header('F', "binary")).little(1.f).little(2.f).little(3.f).little(0xFFFF8001u).string();
  const auto signalling = Bytes(header('F', "binary")).little(1.f).little(2.f).little(3.f).little(0x7F818001u).string();
  EXPECT_EQ(read_pcd(files.put("a.pcd", quiet)).colour[0], expected);
  EXPECT_EQ(read_pcd(files.put("b.pcd", signalling)).colour[0], (Rgb16{0x8181, 0x8080, 0x0101}));
  EXPECT_EQ(read_pcd(files.put("c.pcd", header('U', "ascii") + "1 2 3 16744449\n")).colour[0], expected);
  EXPECT_EQ(read_pcd(files.put("d.pcd", header('F', "ascii") + "1 2 3 4.2108e+06\n")).colour[0],
            (Rgb16{0x80 * 257, 0x80 * 257, 0xE0 * 257}));
  EXPECT_THROW(read_pcd(files.put("e.pcd", header('F', "ascii") + "1 2 3 nan\n")), Error);
}

TEST(ReadPcd, NormalsMissingPointsAndDescriptors) {
  Files files;
  const auto cloud = read_pcd(
      files.put("a.pcd",
                "# .PCD v.7\nVERSION .7\nFIELDS x y z normal_x normal_y normal_z curvature vfh\nSIZE 4 4 4 4 4 4 4 4\n"
                "TYPE F F F F F F F F\nCOUNT 1 1 1 1 1 1 1 2\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
                "1 2 3 0 0 1 0.5 7 8\nnan nan inf nan nan nan nan 7 8\n"));
  EXPECT_EQ(cloud.normals[0], (Vec3{0, 0, 1}));
  EXPECT_EQ(cloud.normals[1], (Vec3{0, 0, 0}));
  EXPECT_TRUE(std::isnan(cloud.positions[1][0]) && std::isnan(cloud.positions[1][2]));
  ASSERT_EQ(cloud.scalars.size(), 1u);
  EXPECT_EQ(cloud.scalars[0].name, "curvature");
  EXPECT_TRUE(std::isnan(cloud.scalars[0].values[1]));
}

TEST(ReadPcd, RefusesWhatItsHeaderCannotMean) {
  Files files;
  const auto says = [&](std::string header, const std::string& from, const std::string& to, const std::string& text) {
    header.replace(header.find(from), from.size(), to);
    const auto path = files.put("a.pcd", header);
    const std::string message = message_of([&] { read_pcd(path); });
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  const std::string good =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n";
  says(good, "POINTS 2", "POINTS 3", "a.pcd:7: PCD POINTS is not WIDTH times HEIGHT: found 3; allowed: 2 x 1");
  says(good, "WIDTH 2", "WIDTH -2", "a.pcd:6: PCD WIDTH: found '-2'");
  says(good, "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2", "WIDTH 4000000000\nHEIGHT 1\nPOINTS 4000000000",
       "found 4000000000; allowed: at most");
  says(good, "WIDTH 2\nHEIGHT 1", "WIDTH 9223372036854775809\nHEIGHT 2", "is not WIDTH times HEIGHT");
  says(good, "SIZE 4 4 4", "SIZE 4 4 3", "a.pcd:4: PCD type and size: found 'F 3'");
  says(good, "SIZE 4 4 4", "SIZE 4 4", "found 2; allowed: 3");
  says(good, "COUNT 1 1 1", "COUNT 1 1 99999999999", "PCD COUNT");
  says(good, "VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0 0 0", "seven numbers");
  says(good, "DATA ascii", "DATA hex", "a.pcd:10: PCD DATA: found 'hex'");
  says(good, "FIELDS x y z", "FIELDS x y w", "no column holds z");
  says(good, "4 5 6", "4.25 5", "a.pcd:12: number of values on a line of PCD data: found 2; allowed: 3");
  says(good, "4 5 6", "4 foo 6", "a.pcd:12:3: not a number: found 'foo'");
  says(good, "2 3\n4 5 6\n", "234567890 23456789\n",
       "a.pcd:11: PCD file holds fewer points than its header promises: found 1");
  says(good, "DATA ascii\n1 2 3\n4 5 6\n", "DATA binary\n12345678901234567890123", "at most 1");
  says(good, "VERSION 0.7\n", "1 2 3\n", "a.pcd:1: word that does not belong in a PCD header: found '1'");
}

TEST(Lzf, ExpandsWhatWasCompressed) {
  std::string text;
  for (int i = 0; i < 3000; ++i) text += i % 7 == 0 ? std::to_string(i * i) : std::string(i % 300, 'a');
  const std::string block = test::compress_lzf(std::string_view(text).substr(0, 20000));
  const auto expanded = expand_lzf(block, 20000);
  ASSERT_TRUE(expanded);
  EXPECT_EQ(std::string(expanded->begin(), expanded->end()), text.substr(0, 20000));
  EXPECT_LT(block.size(), 8000u);
  EXPECT_FALSE(expand_lzf(block, 19999));
  EXPECT_FALSE(expand_lzf(block, 20001));
  EXPECT_FALSE(expand_lzf(std::string("\x20\x00", 2), 3));  // a copy before anything was written
  EXPECT_FALSE(expand_lzf(std::string("\x05"
                                      "ab",
                                      3),
                          6));  // literals beyond the end
  EXPECT_FALSE(expand_lzf(std::string("\x00"
                                      "a\xE0",
                                      3),
                          10));
  EXPECT_FALSE(expand_lzf("a", std::size_t{1} << 60));
}

TEST(ReadPcd, RealFiles) {
  SCARP_NEED_DATA();
  const auto folder = test::data_folder() / "als_truth_and_formats/formats";
  const auto car = read_pcd(folder / "pcl_car6.pcd");  // binary_compressed
  EXPECT_EQ(car.size(), 10031u);
  const Box3 box = bounds(car.positions);
  EXPECT_NEAR(box.min[0], -40.168999, 1e-6);
  EXPECT_NEAR(box.max[2], -5.43, 1e-6);
  EXPECT_EQ(read_pcd(folder / "pcl_lamppost.pcd").size(), 1771u);
  EXPECT_EQ(read_pcd(folder / "pcl_sac_plane_test.pcd").normals.size(), 3283u);
  const auto autzen = read_pcd(folder / "autzen-utm.pcd");  // 16 fields of many sizes, double coordinates
  EXPECT_EQ(autzen.size(), 1065u);
  EXPECT_EQ(bounds(autzen.positions).min, (Vec3{493994.87, 4877429.62, 123.93}));
  EXPECT_EQ(autzen.colour.size(), 1065u);
  EXPECT_EQ(autzen.gps_time.size(), 1065u);
  const auto utm17 = read_pcd(folder / "utm17_space.pcd");
  EXPECT_EQ(utm17.positions.back(), (Vec3{289818.5, 4320980.59, 170.58}));
  EXPECT_THROW(read_pcd(folder / "missingheader.pcd"), Error);
}

}  // namespace
}  // namespace scarp

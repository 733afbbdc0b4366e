// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_ply.hpp"

#include <cmath>

#include "tests/unit/ingest/format_samples.hpp"

namespace scarp {
namespace {

using test::Bytes;
using test::Files;
using test::message_of;

constexpr Vec3 kUtm{691234.125, 5412345.6789, 812.5};

TEST(ReadPly, AsciiKeepsAllDigitsEvenOfFloat) {
  Files files;
  const auto cloud = read_ply(files.put("a.ply",
                                        "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 2\n"
                                        "property float x\nproperty float y\nproperty float z\nend_header\n"
                                        "691234.125 5412345.6789 812.5\n\n -1e1\t+2 nan \n"));
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.positions[0], kUtm);
  EXPECT_EQ(cloud.positions[1][0], -10);
  EXPECT_TRUE(std::isnan(cloud.positions[1][2]));
  EXPECT_EQ(cloud.site.origin, (Vec3{0, 0, 0}));
}

std::string binary_header(const std::string& format) {
  return "ply\r\nformat " + format + " 1.0\r\nobj_info any\r\nelement camera 1\r\nproperty list uchar short path\r\n" +
         "property int id\r\nelement vertex 2\r\nproperty uchar blue\r\nproperty double z\r\nproperty double x\r\n" +
         "property list uchar float neighbours\r\nproperty double y\r\nproperty uchar red\r\nproperty uchar green\r\n" +
         "property ushort intensity\r\nproperty uchar label\r\nproperty float scalar_Roughness\r\nend_header\r\n";
}

/// The same rows in either order of bytes, with CR LF in the header, lists, and an element before the vertices.
template <class Put>
std::string binary_body(Put put) {
  Bytes bytes;
  put(bytes, std::uint8_t{2}), put(bytes, std::int16_t{-3}), put(bytes, std::int16_t{4}), put(bytes, std::int32_t{7});
  for (int i = 0; i < 2; ++i) {
    put(bytes, std::uint8_t{255}), put(bytes, kUtm[2] + i), put(bytes, kUtm[0] + i);
    put(bytes, static_cast<std::uint8_t>(i));
    if (i == 1) put(bytes, 1.5f);
    put(bytes, kUtm[1] + i), put(bytes, std::uint8_t{1}), put(bytes, std::uint8_t{2});
    put(bytes, std::uint16_t{40000}), put(bytes, std::uint8_t{6}), put(bytes, 0.25f);
  }
  return bytes.string();
}

void expect_binary(const PointCloud& cloud) {
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.positions[1], (Vec3{kUtm[0] + 1, kUtm[1] + 1, kUtm[2] + 1}));
  EXPECT_EQ(cloud.colour[0], (Rgb16{257, 514, 65535}));
  EXPECT_EQ(cloud.intensity[1], 40000);
  EXPECT_EQ(cloud.classification[0], 6);
  ASSERT_EQ(cloud.scalars.size(), 1u);
  EXPECT_EQ(cloud.scalars[0].name, "Roughness");
  EXPECT_EQ(cloud.scalars[0].values, (std::vector<double>{0.25, 0.25}));
}

TEST(ReadPly, BinaryLittleEndianWithListsAndOtherElements) {
  Files files;
  expect_binary(read_ply(files.put(
      "a.ply", binary_header("binary_little_endian") + binary_body([](Bytes& b, auto value) { b.little(value); }))));
}

TEST(ReadPly, BinaryBigEndianWithListsAndOtherElements) {
  Files files;
  expect_binary(read_ply(files.put(
      "a.ply", binary_header("binary_big_endian") + binary_body([](Bytes& b, auto value) { b.big(value); }))));
}

TEST(ReadPly, ScalesOfColourAndNormals) {
  Files files;
  const std::string start =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
      "property double z\n";
  const auto real = read_ply(files.put("a.ply", start + "property float nx\nproperty float ny\nproperty float nz\n" +
                                                    "property float red\nproperty float green\nproperty float blue\n" +
                                                    "end_header\n0 0 0 0 0 2 0 0.5 1\n1 1 1 nan 0 0 1 1 1\n"));
  EXPECT_EQ(real.colour[0], (Rgb16{0, 32768, 65535}));
  EXPECT_EQ(real.normals[0], (Vec3{0, 0, 1}));
  EXPECT_EQ(real.normals[1], (Vec3{0, 0, 0}));
  const auto word = read_ply(files.put("b.ply", start + "property ushort red\nproperty ushort green\n" +
                                                    "property ushort blue\nend_header\n0 0 0 1 2 3\n1 1 1 4 5 6\n"));
  EXPECT_EQ(word.colour[1], (Rgb16{4, 5, 6}));
}

TEST(ReadPly, WhatDoesNotFitAnAttributeBecomesAScalar) {
  Files files;
  const auto cloud =
      read_ply(files.put("a.ply",
                         "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
                         "property double z\nproperty float intensity\nproperty int label\n"
                         "property uchar red\nend_header\n1 2 3 0.5 300 9\n"));
  EXPECT_TRUE(cloud.intensity.empty() && cloud.classification.empty() && cloud.colour.empty());
  ASSERT_EQ(cloud.scalars.size(), 3u);
  EXPECT_EQ(cloud.scalars[0].values[0], 0.5);
  EXPECT_EQ(cloud.scalars[1].values[0], 300);
  EXPECT_EQ(cloud.scalars[2].name, "red");
}

TEST(ReadPly, ErrorsNameThePlace) {
  Files files;
  const std::string start =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
      "property double z\nproperty uchar red\nend_header\n";
  const auto says = [&](const std::string& bytes, const std::string& text) {
    const auto path = files.put("a.ply", bytes);
    const std::string message = message_of([&] { read_ply(path); });
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  says(start + "1 2 3 4\n1 2 x3 4\n", "a.ply:10:5: not a number: found 'x3'");
  says(start + "1.25 2 3 4\n1 2 3\n", "a.ply:10: too few values");
  says(start + "1 2 3 4 5\n1 2 3 4\n", "a.ply:9: too many values");
  says(start + "1.125 2.125 3.125 4\n", "ends inside element 'vertex'");
  says(start + "1 2 3 256\n1 2 3 4\n", "property 'red': found 256; allowed: integers 0 to 255");
  says(start + "1 2 3 4\n1 2 1e999 4\n", "a.ply:10:5: not a number");
  says("ply\nformat ascii 1.0\nend_header\n", "without the element 'vertex'");
  says(
      "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n1 2 3\n",
      "found 4000000000; allowed: at most 1");
  says("ply\nformat ascii 1.0\nelement vertex -5\nend_header\n", "a.ply:3: PLY element without a count: found '-5'");
  says(
      "ply\nformat ascii 1.0\nelement nothing 99999999999\nelement vertex 0\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n",
      "at most 0");
  says("ply\nformat binary_middle_endian 1.0\n", "a.ply:2: unknown PLY format");
  says("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n", "a.ply:4: unknown PLY type: found 'quad'");
  says("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n",
       "no column holds z");
  Bytes cut(
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list int float l\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n");
  cut.little(std::int32_t{-1}).little(1.f).little(1.f).little(1.f);
  says(cut.string(), "length of a list in PLY element 'vertex': found -1");
}

TEST(ReadPly, RealFiles) {
  SCARP_NEED_DATA();
  const auto folder = test::data_folder() / "als_truth_and_formats";
  const auto cloud = read_ply(folder / "csf_sample_100k.ply");
  EXPECT_EQ(cloud.size(), 100000u);
  const Box3 box = bounds(cloud.positions);
  EXPECT_EQ(box.max, (Vec3{394790.0, 640627.5, box.max[2]}));
  EXPECT_NEAR(box.max[2], 826.447021, 1e-6);
  EXPECT_EQ(read_ply(folder / "formats/simple_text.ply").positions,
            read_ply(folder / "formats/simple_binary.ply").positions);
  EXPECT_THROW(read_ply(folder / "formats/no_vertex.ply"), Error);
}

}  // namespace
}  // namespace scarp

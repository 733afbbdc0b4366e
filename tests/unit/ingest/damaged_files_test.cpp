// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every reader takes whatever a disk, a download or a malicious sender makes of a file: it reads or throws Error.
#include <cmath>
#include <random>

#include "ingest/read_cloud.hpp"
#include "ingest/read_mesh.hpp"
#include "tests/unit/ingest/format_samples.hpp"

/// Per sample; a longer hunt can ask for more.
#ifndef SCARP_DAMAGE_TRIALS
#define SCARP_DAMAGE_TRIALS 250
#endif

namespace scarp {

std::vector<test::Sample> test::format_samples() {
  const auto ply_header = [](const std::string& format) {
    return "ply\nformat " + format + " 1.0\nelement vertex 3\nproperty double x\nproperty double y\n" +
           "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n" +
           "property list uchar int vertex_indices\nend_header\n";
  };
  Bytes little(ply_header("binary_little_endian")), big(ply_header("binary_big_endian")), columns;
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a) little.little(5412345.5 + i * a), big.big(5412345.5 + i * a);
    for (int a = 0; a < 3; ++a) little.little(std::uint8_t{200}), big.big(std::uint8_t{200});
  }
  little.little(std::uint8_t{3}), big.big(std::uint8_t{3});
  for (int i = 0; i < 3; ++i) little.little(i), big.big(i);
  const std::string pcd_header =
      "VERSION 0.7\nFIELDS x y z rgb\nSIZE 8 8 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2\n"
      "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ";
  Bytes pcd(pcd_header + "binary\n");
  for (int i = 0; i < 2; ++i) pcd.little(1.0 * i).little(2.0).little(3.f).little(0xFF102030u);
  columns.little(0.0).little(1.0).little(2.0).little(2.0).little(3.f).little(3.f).little(1u).little(2u);
  const std::string block = compress_lzf(columns.string());
  Bytes compressed(pcd_header + "binary_compressed\n");
  compressed.little(static_cast<std::uint32_t>(block.size()));
  compressed.little(static_cast<std::uint32_t>(columns.string().size())).text(block);
  Bytes stl(std::string(80, ' '));
  stl.little(1u);
  for (int i = 0; i < 12; ++i) stl.little(1.f * i);
  stl.little(std::uint16_t{0});
  return {{"ascii.ply", ply_header("ascii") + "1 2 3 4 5 6\n7 8 9 10 11 12\n1 1 1 1 1 1\n3 0 1 2\n"},
          {"little.ply", little.string()},
          {"big.ply", big.string()},
          {"ascii.pcd", pcd_header + "ascii\n1 2 3 16744449\n4 5 6 255\n"},
          {"binary.pcd", pcd.string()},
          {"compressed.pcd", compressed.string()},
          {"named.csv", "x,y,z,red,green,blue,distance [m]\n1,2,3,4,5,6,0.5\n7,8,9,10,11,12,\n"},
          {"plain.xyz", "// X Y Z R G B\n1.5 2.5 3.5 255 0 0\n-1e5 2 nan 0 0 0\n"},
          {"count.pts", "2\n1 2 3 -100 1 2 3\n4 5 6 7 8 9 10\n"},
          {"grid.asc", "ncols 2\nnrows 2\nxllcorner 5\nyllcorner 6\ncellsize 1\nnodata_value -9\n1 2\n-9 4\n"},
          {"grid.tif", geotiff_sample()},
          {"thing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf -1 -2 -3\n"},
          {"binary.stl", stl.string()},
          {"ascii.stl",
           "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
           "endfacet\nendsolid a\n"}};
}

namespace {

bool is_mesh_only(const std::string& name) { return name.ends_with(".obj") || name.ends_with(".stl"); }

/// Reads as a cloud and as a mesh; what is read must be whole. Returns whether one of them could be read.
bool read_or_refuse(const std::filesystem::path& path) {
  bool read = false;
  try {
    PointCloud cloud = read_cloud(path);
    const std::size_t n = cloud.size();
    for_each_attribute(cloud, [&](const auto& values) { EXPECT_TRUE(values.empty() || values.size() == n) << path; });
    for (const Vec3& p : cloud.positions)
      for (double c : p) EXPECT_FALSE(std::isinf(c)) << path;
    read = true;
  } catch (const Error&) {
  }
  try {
    const TriangleMesh mesh = read_mesh(path);
    for (const auto& triangle : mesh.triangles)
      for (std::uint32_t corner : triangle) EXPECT_LT(corner, mesh.vertices.size()) << path;
    read = true;
  } catch (const Error&) {
  }
  return read;
}

TEST(DamagedFiles, SamplesAreWhole) {
  test::Files files;
  for (const test::Sample& sample : test::format_samples()) {
    const auto path = files.put(sample.name, sample.bytes);
    if (is_mesh_only(sample.name))
      EXPECT_FALSE(read_mesh(path).triangles.empty()) << sample.name;
    else
      EXPECT_GE(read_cloud(path).size(), 2u) << sample.name;
  }
}

TEST(DamagedFiles, CutAnywhere) {
  test::Files files;
  for (const test::Sample& sample : test::format_samples())
    for (std::size_t size = 0; size < sample.bytes.size(); ++size)
      read_or_refuse(files.put(sample.name, std::string_view(sample.bytes).substr(0, size)));
}

TEST(DamagedFiles, BinaryDataCutAnywhereIsRefused) {
  test::Files files;
  for (const test::Sample& sample : test::format_samples()) {
    if (sample.name != "binary.pcd" && sample.name != "compressed.pcd" && sample.name != "binary.stl") continue;
    for (std::size_t size = 0; size < sample.bytes.size(); ++size)
      EXPECT_FALSE(read_or_refuse(files.put(sample.name, std::string_view(sample.bytes).substr(0, size))))
          << sample.name << " cut to " << size;
  }
}

TEST(DamagedFiles, BytesChangedAnywhere) {
  test::Files files;
  std::mt19937_64 random(20240607);
  constexpr int kTrials = SCARP_DAMAGE_TRIALS;
  for (const test::Sample& sample : test::format_samples())
    for (int trial = 0; trial < kTrials; ++trial) {
      std::string bytes = sample.bytes;
      for (std::uint64_t flips = 1 + random() % 4; flips > 0; --flips) {
        const std::size_t at = random() % bytes.size();
        switch (random() % 4) {
          case 0:
            bytes[at] = static_cast<char>(random());
            break;
          case 1:
            bytes[at] = static_cast<char>(bytes[at] ^ 1 << random() % 8);
            break;
          case 2:
            bytes[at] = "0123456789-.e\n ,"[random() % 16];
            break;
          default:
            bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 8));
            break;
        }
      }
      read_or_refuse(files.put(sample.name, bytes));
    }
}

}  // namespace
}  // namespace scarp

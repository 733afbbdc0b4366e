// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_mesh.hpp"

#include "tests/unit/ingest/format_samples.hpp"

namespace scarp {
namespace {

using test::Bytes;
using test::Files;
using test::message_of;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST(ReadMesh, PlyAsciiSplitsPolygons) {
  Files files;
  const TriangleMesh mesh = read_mesh(
      files.put("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 2\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n"
                "691234.125 5412345.6789 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n7 4 0 1 2 3\n7 3 0 1 4\n"));
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[0], (Vec3{691234.125, 5412345.6789, 0}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}}));
}

TEST(ReadMesh, PlyBinaryWithFacesBeforeVertices) {
  Files files;
  Bytes bytes(
      "ply\nformat binary_big_endian 1.0\nelement face 1\nproperty list uchar uint vertex_index\n"
      "element vertex 3\nproperty double x\nproperty double y\nproperty double z\nend_header\n");
  bytes.big(std::uint8_t{3}).big(2u).big(1u).big(0u);
  for (int i = 0; i < 9; ++i) bytes.big(i + 0.5);
  const TriangleMesh mesh = read_mesh(files.put("a.ply", bytes.string()));
  EXPECT_EQ(mesh.vertices[2], (Vec3{6.5, 7.5, 8.5}));
  EXPECT_EQ(mesh.triangles, (Triangles{{2, 1, 0}}));
}

TEST(ReadMesh, ObjWithEveryKindOfCorner) {
  Files files;
  const TriangleMesh mesh = read_mesh(files.put(
      "a.obj",
      "# a\nmtllib a.mtl\no thing\nv 691234.125 5412345.6789 1\nv 1 0 0 0.5 0.5 0.5\nv\t1 1 0\nv 0 1 0\n"
      "vt 0 0\nvn 0 0 1\nf 1 2 3 4\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 4/1/1\nf -4 -3 -1/-1/-1\n"));
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[0], (Vec3{691234.125, 5412345.6789, 1}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 1, 2}, {0, 1, 3}, {0, 1, 3}}));
}

constexpr const char* kAsciiStl =
    "solid thing\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0.1 1 -0\n  endloop\n"
    " endfacet\n FACET NORMAL 0 0 1\n  outer loop\n   vertex 1 0 -0\n   vertex 1 1 5412345.6789\n   vertex 0.1 1 0\n"
    "  endloop\n endfacet\nendsolid thing\n";

TEST(ReadMesh, StlSharesEqualVertices) {
  Files files;
  const TriangleMesh ascii = read_mesh(files.put("a.stl", kAsciiStl));
  EXPECT_EQ(ascii.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0.1, 1, 0}, {1, 1, 5412345.6789}}));
  EXPECT_EQ(ascii.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}}));
  Bytes bytes("solid, although it is binary");  // seen in the wild
  bytes.text(std::string(80 - bytes.string().size(), ' ')).little(2u);
  for (const auto& triangle : ascii.triangles) {
    for (int a = 0; a < 3; ++a) bytes.little(0.f);
    for (std::uint32_t corner : triangle)
      for (int a = 0; a < 3; ++a) bytes.little(static_cast<float>(ascii.vertices[corner][a]));
    bytes.little(std::uint16_t{0});
  }
  const TriangleMesh binary = read_mesh(files.put("b.stl", bytes.string()));
  EXPECT_EQ(binary.triangles, ascii.triangles);
  EXPECT_EQ(binary.vertices[2], (Vec3{0.1f, 1, 0}));
}

TEST(ReadMesh, ErrorsNameThePlace) {
  Files files;
  const auto says = [&](const std::string& name, const std::string& bytes, const std::string& text) {
    const auto path = files.put(name, bytes);
    const std::string message = message_of([&] { read_mesh(path); });
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  says("a.obj", v + "f 1 2 4\n", "a.obj:4: face names a vertex that is not there: found 4; allowed: 1 to 3");
  says("a.obj", v + "f 1 2 -4\n", "a.obj:4: face names a vertex");
  says("a.obj", v + "f 1 2 0\n", "a.obj:4: corner of a face: found '0'");
  says("a.obj", v + "f 1 2 1.5\n", "corner of a face");
  says("a.obj", v + "f 1 2\n", "a.obj:4: corners of a face: found 2; allowed: at least 3");
  says("a.obj", "v 1 2\n", "a.obj:1: vertex: found 'v 1 2'");
  says("a.obj", "v 1 2 x\n", "a.obj:1:7: not a number: found 'x'");
  says("a.obj", "v 1 2 nan\n", "finite coordinates");
  says("a.obj", v, "mesh without triangles");
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n";
  says("a.ply", ply + "3 0 1 3\n", "a.ply:13: face names a vertex that is not there: found 3");
  says("a.ply", ply + "3 0 1 -1\n", "found -1");
  says("a.ply", ply + "200 0 1 2\n", "length of a list in PLY element 'face': found 200");
  says("a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n", "without the element 'face'");
  const std::string stl = kAsciiStl;
  says("a.stl", stl.substr(0, stl.size() - 15), "without endsolid");
  says("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\nendsolid\n",
       "a.stl:6: corners of a triangle: found 1");
  says("a.stl", "solid a\nvertex 0 0 z\n", "a.stl:2:");
  says("a.stl", Bytes(std::string(80, ' ')).little(4000000000u).text("abc").string(), "size of a binary STL file");
  says("a.stl", "", "is empty");
  says("a.off", "OFF\n", "mesh format not known: found '.off'; allowed: PLY, OBJ or STL");
}

TEST(ReadMesh, RealFile) {
  SCARP_NEED_DATA();
  const TriangleMesh mesh = read_mesh(test::data_folder() / "als_truth_and_formats/formats/mesh.ply");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {1, 2, 3}}));
}

}  // namespace
}  // namespace scarp

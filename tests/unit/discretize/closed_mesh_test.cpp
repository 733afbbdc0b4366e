// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/closed_mesh.hpp"

#include <algorithm>
#include <numbers>

#include "tests/unit/discretize/scene.hpp"

namespace scarp {
namespace {

using test::Scene;

/// Oracle: the winding number of a closed mesh about p, as the sum of signed solid angles (van Oosterom and Strackee
/// 1983) over 4 pi.
double winding_number(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

TriangleMesh cube(Vec3 low, Vec3 high) {
  TriangleMesh mesh;
  for (int v = 0; v < 8; ++v)
    mesh.vertices.push_back({v & 1 ? high[0] : low[0], v & 2 ? high[1] : low[1], v & 4 ? high[2] : low[2]});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Torus about an axis tilted out of z, so that columns cross it up to four times.
TriangleMesh torus(double big, double small, int n, int m) {
  TriangleMesh mesh;
  const double c = std::cos(1.1), s = std::sin(1.1);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
      const double r = big + small * std::cos(v);
      const Vec3 p{r * std::cos(u), r * std::sin(u), small * std::sin(v)};
      mesh.vertices.push_back({p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]});
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % n) * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

TriangleMesh join(TriangleMesh a, const TriangleMesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

Scene with_mesh(TriangleMesh mesh, double cell) {
  Scene scene(3, cell);
  scene.meshes["m.ply"] = std::move(mesh);
  scene.body("wall", MeshVolume{{"m.ply"}});
  return scene;
}

TEST(ClosedMesh, ACubeIsABox) {
  Scene boxes(3, 0.25);
  boxes.body("wall", test::box({0.25, 0.5, 1}, {1.5, 2, 1.75}));
  const Model model = with_mesh(cube({0.25, 0.5, 1}, {1.5, 2, 1.75}), 0.25).build();
  test::expect_same_bits(model, boxes.build());
  EXPECT_NEAR(model.volumes[0].input_volume, 1.25 * 1.5 * 0.75, 1e-15);
  EXPECT_EQ(model.volumes[0].relative_difference(), 0);
  EXPECT_FALSE(model.volumes[0].self_intersecting);
}

TEST(ClosedMesh, LinesThroughVerticesEdgesAndWallsCrossEvenly) {
  // Every corner, edge and wall lies on a column of sub-cell centres: a box owns its lower faces, and so does this.
  Scene boxes(3, 1);
  boxes.body("wall", test::box({0.25, 0.25, 0.25}, {2.25, 3.25, 4.75}));
  test::expect_same_bits(with_mesh(cube({0.25, 0.25, 0.25}, {2.25, 3.25, 4.75}), 1).build(), boxes.build());
  // An octahedron with its apex and its edges right above columns.
  TriangleMesh octahedron{
      {{2.25, 2.25, 5}, {2.25, 2.25, 0}, {0.25, 2.25, 2.5}, {4.25, 2.25, 2.5}, {2.25, 0.25, 2.5}, {2.25, 4.25, 2.5}},
      {{0, 3, 5}, {0, 5, 2}, {0, 2, 4}, {0, 4, 3}, {1, 5, 3}, {1, 2, 5}, {1, 4, 2}, {1, 3, 4}},
      {}};
  const Model model = with_mesh(octahedron, 1).build();
  EXPECT_NEAR(model.volumes[0].input_volume, 8.0 * 5 / 3, 1e-12);
  EXPECT_NEAR(model.volumes[0].relative_difference(), 0, 0.03);
}

TEST(ClosedMesh, PointsAreThoseWithTheWindingNumberOne) {
  const TriangleMesh meshes[] = {torus(1, 0.4, 40, 24),
                                 {{{0, 0, 0}, {1.7, 0.2, 0.1}, {0.3, 1.9, 0.2}, {0.4, 0.5, 2.1}},
                                  {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                                  {}}};
  for (const TriangleMesh& mesh : meshes) {
    const MeshSolid solid = close_mesh(mesh, "b", "f");
    Domain domain{3, 0.25, {-4, -4, -4}, {4, 4, 4}, {}};
    const SubLattice grid = lay_lattice(domain, BodyOptions{}, {"b", solid.bounds, solid.volume});
    const Columns columns = fill(solid, grid, 1);
    int inside = 0;
    for (std::int32_t j = 0; j < grid.y.count; ++j)
      for (std::int32_t i = 0; i < grid.x.count; ++i)
        for (std::int32_t k = 0; k < grid.up.count; ++k) {
          const double winding = winding_number(solid.mesh, grid.point(i, j, k));
          ASSERT_NEAR(winding, std::round(winding), 1e-9);
          ASSERT_EQ(columns.contains(grid.column(i, j), k), std::round(winding) == 1);
          inside += std::round(winding) == 1;
        }
    EXPECT_EQ(columns.points(), static_cast<std::size_t>(inside));
    EXPECT_GT(inside, 100);
  }
}

TEST(ClosedMesh, ATorusHasItsVolume) {
  const Model model = with_mesh(torus(1, 0.4, 200, 100), 0.05).build();
  const double exact = 2 * std::numbers::pi * std::numbers::pi * 0.16;
  EXPECT_NEAR(model.volumes[0].input_volume / exact, 1, 1e-3);
  EXPECT_LT(std::abs(model.volumes[0].relative_difference()), 1e-3);
}

TEST(ClosedMesh, AnyOrientationOfTheTrianglesWillDo) {
  const TriangleMesh right = torus(1, 0.4, 24, 12);
  const Model model = with_mesh(right, 0.2).build();
  TriangleMesh inside_out = right, mixed = right;
  for (auto& t : inside_out.triangles) std::swap(t[1], t[2]);
  for (std::size_t t = 0; t < mixed.triangles.size(); t += 3) std::swap(mixed.triangles[t][0], mixed.triangles[t][2]);
  for (const TriangleMesh& odd : {inside_out, mixed}) {
    const Model other = with_mesh(odd, 0.2).build();
    EXPECT_EQ(other.particles.reference_position, model.particles.reference_position);
    EXPECT_NEAR(other.volumes[0].input_volume, model.volumes[0].input_volume, 1e-12);
  }
}

TEST(ClosedMesh, ShellsWithinShellsAreHollows) {
  // Both shells outwards: the inner one must be turned, or its volume would be added.
  const Model model = with_mesh(join(cube({0, 0, 0}, {4, 4, 4}), cube({1, 1, 1}, {3, 3, 3})), 0.5).build();
  EXPECT_NEAR(model.volumes[0].input_volume, 64 - 8, 1e-12);
  EXPECT_NEAR(model.volumes[0].particle_volume, 64 - 8, 1e-12);
  // Two solids that touch along an edge: closed, though four triangles share it.
  const Model touching = with_mesh(join(cube({0, 0, 0}, {1, 1, 1}), cube({1, 1, 0}, {2, 2, 1})), 0.5).build();
  EXPECT_NEAR(touching.volumes[0].input_volume, 2, 1e-12);
  EXPECT_NEAR(touching.volumes[0].particle_volume, 2, 1e-12);
}

TEST(ClosedMesh, SelfIntersectionIsReported) {
  const Model model = with_mesh(join(cube({0, 0, 0}, {2, 2, 2}), cube({1.1, 1.1, 1.1}, {3, 3, 3})), 0.5).build();
  EXPECT_TRUE(model.volumes[0].self_intersecting);
}

TEST(ClosedMesh, RepeatedVerticesAreMadeOne) {
  const TriangleMesh shared = torus(1, 0.4, 24, 12);
  TriangleMesh soup;
  for (const auto& t : shared.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.vertices.size());
    for (std::uint32_t v : t) soup.vertices.push_back(shared.vertices[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  soup.triangles.push_back({0, 0, 1});
  EXPECT_EQ(with_mesh(soup, 0.2).build().particles.reference_position,
            with_mesh(shared, 0.2).build().particles.reference_position);
}

TEST(ClosedMesh, OpenAndBrokenMeshesAreRefused) {
  TriangleMesh open = cube({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  const std::string text = test::refusal(with_mesh(open, 0.5));
  EXPECT_NE(text.find("3 border edges"), std::string::npos) << text;
  EXPECT_NE(text.find("m.ply"), std::string::npos) << text;
  TriangleMesh wild = cube({0, 0, 0}, {1, 1, 1});
  wild.triangles[3][1] = 99;
  EXPECT_NE(test::refusal(with_mesh(wild, 0.5)).find("vertex 99"), std::string::npos);
  wild = cube({0, 0, 0}, {1, 1, 1});
  wild.vertices[5][2] = INFINITY;
  EXPECT_NE(test::refusal(with_mesh(wild, 0.5)).find("vertex 5"), std::string::npos);
  EXPECT_NE(test::refusal(with_mesh({}, 0.5)).find("no triangle"), std::string::npos);
  // Closed and flat: both sides of one triangle.
  EXPECT_NE(test::refusal(with_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}, {}}, 0.5)), "");
  // One-sided: a projective plane of six vertices has an even count at every edge and no inside.
  TriangleMesh projective;
  for (int v = 0; v < 6; ++v) projective.vertices.push_back({std::cos(v * 2.0), std::sin(v * 3.0), 0.3 * v});
  projective.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                          {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  EXPECT_NE(test::refusal(with_mesh(projective, 0.5)).find("oriented"), std::string::npos);
}

}  // namespace
}  // namespace scarp

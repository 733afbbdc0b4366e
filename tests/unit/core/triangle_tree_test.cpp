// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/triangle_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "solver/model/error.hpp"
#include "tests/support/sample_meshes.hpp"

namespace scarp {
namespace {

using test::cube;
using test::scattered;
using test::spike;
using test::terrain;

double signed_distance(const TriangleTree& tree, const Vec3& p) {
  const auto closest = tree.closest(p, INFINITY);
  const double distance = std::sqrt(closest->squared_distance);
  return tree.side(p, *closest) < 0 ? -distance : distance;
}

TEST(TriangleTree, DistancesToACubeAreExact) {
  const TriangleTree tree(cube());
  EXPECT_EQ(tree.border_edges(), 0u);
  EXPECT_EQ(tree.bad_edges(), 0u);
  for (const Vec3& p : scattered(3000, {-1, -1, -1}, {2, 2, 2}, 1)) {
    Vec3 outside{0, 0, 0};
    double inside = INFINITY;
    for (std::size_t a = 0; a < 3; ++a) {
      outside[a] = std::max({-p[a], p[a] - 1, 0.0});
      inside = std::min({inside, p[a], 1 - p[a]});
    }
    const double expected = norm(outside) > 0 ? norm(outside) : -inside;
    ASSERT_NEAR(signed_distance(tree, p), expected, 1e-14);
  }
}

TEST(TriangleTree, SignsAreRightBeyondEdgesAndVertices) {
  const TriangleTree tree(cube());
  EXPECT_NEAR(signed_distance(tree, {-0.5, -0.5, -0.5}), std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(signed_distance(tree, {0.5, -0.5, -0.5}), std::sqrt(0.5), 1e-15);
  // Around the tip of a spike the nearest point is the tip, or an edge, for all that is outside.
  const TriangleTree sharp(spike());
  for (const Vec3& p : scattered(2000, {-0.7, -1, 4.5}, {1.3, 1, 6}, 2)) {
    // Inside where it is below all four slanted faces.
    bool inside = true;
    const TriangleMesh mesh = spike();
    for (const auto& t : mesh.triangles) {
      const Vec3 n = cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
      inside = inside && dot(n, p - mesh.vertices[t[0]]) < 0;
    }
    ASSERT_EQ(signed_distance(sharp, p) < 0, inside);
  }
}

TEST(TriangleTree, FindsWhatLookingAtEveryTriangleFinds) {
  const TriangleMesh mesh = terrain(17);
  const TriangleTree tree(mesh);
  for (const Vec3& p : scattered(500, {-3, -3, -5}, {20, 20, 6}, 3)) {
    double best = INFINITY;
    for (const auto& t : mesh.triangles)
      best = std::min(
          best, closest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]).squared_distance);
    const auto found = tree.closest(p, INFINITY);
    ASSERT_EQ(found->squared_distance, best);
    EXPECT_FALSE(tree.closest(p, std::sqrt(best) * (1 - 1e-12)).has_value());
    EXPECT_TRUE(tree.closest(p, std::sqrt(best) * (1 + 1e-12)).has_value());
  }
}

TEST(TriangleTree, TheClosestPointOfATriangleIsNearerThanSamplesOfIt) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<Vec3> v = scattered(4, {0, 0, 0}, {1, 1, 1}, seed);
    const ClosestPoint found = closest_on_triangle(v[3], v[0], v[1], v[2]);
    const double distance = norm(v[3] - found.point);
    EXPECT_NEAR(distance * distance, found.squared_distance, 1e-15);
    double nearest = INFINITY;
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j <= 60 - i; ++j) {
        const double s = i / 60.0, t = j / 60.0;
        nearest = std::min(nearest, norm(v[3] - (v[0] + s * (v[1] - v[0]) + t * (v[2] - v[0]))));
      }
    EXPECT_LE(distance, nearest + 1e-14);
    EXPECT_GE(distance, nearest - 0.02);
  }
}

TEST(TriangleTree, KnowsBordersAndBadEdges) {
  const TriangleTree tree(terrain(4));
  EXPECT_EQ(tree.border_edges(), 16u);
  EXPECT_TRUE(tree.on_border(*tree.closest({-2, 1.5, 0}, INFINITY)));
  EXPECT_TRUE(tree.on_border(*tree.closest({-2, -2, 0}, INFINITY)));
  EXPECT_FALSE(tree.on_border(*tree.closest({1.7, 2.4, -1}, INFINITY)));
  TriangleMesh turned = cube();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_EQ(TriangleTree(turned).bad_edges(), 3u);
}

TEST(TriangleTree, LeavesOutTrianglesWithoutArea) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({0, 1, 1});
  const TriangleTree tree(mesh);
  EXPECT_EQ(tree.triangles_left_out(), 2u);
  EXPECT_NEAR(signed_distance(tree, {0.5, -1, 0}), 1, 1e-15);
}

TEST(TriangleTree, RefusesWhatIsNoMesh) {
  EXPECT_THROW(TriangleTree{TriangleMesh{}}, Error);
  TriangleMesh mesh = cube();
  mesh.triangles[3][1] = 8;
  EXPECT_THROW(TriangleTree{mesh}, Error);
  mesh = cube();
  mesh.vertices[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(TriangleTree{mesh}, Error);
  mesh = cube();
  mesh.triangles = {{0, 0, 0}};
  EXPECT_THROW(TriangleTree{mesh}, Error);
}

}  // namespace
}  // namespace scarp

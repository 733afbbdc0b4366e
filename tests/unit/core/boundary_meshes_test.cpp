// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "solver/core/triangle_tree.hpp"
#include "solver/model/mesh.hpp"

namespace scarp {
namespace {

using std::numbers::pi;

/// Inside the triangles, by the divergence theorem; closed and oriented meshes only.
double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
  return sum;
}

void expect_closed(const TriangleMesh& mesh) {
  const TriangleTree tree(mesh);
  EXPECT_EQ(tree.border_edges(), 0u);
  EXPECT_EQ(tree.bad_edges(), 0u);
  EXPECT_EQ(tree.triangles_left_out(), 0u);
}

TEST(BoundaryMeshes, OfABoxIsExact) {
  const TriangleMesh mesh = box_mesh({{1, 2, 3}, {2, 4, 6}});
  expect_closed(mesh);
  EXPECT_NEAR(volume(mesh), 6, 1e-13);
}

TEST(BoundaryMeshes, OfASphereIsWithinTheSagitta) {
  for (double sagitta : {0.05, 0.002}) {
    const TriangleMesh mesh = sphere_mesh({1, 2, 3}, 0.5, sagitta);
    expect_closed(mesh);
    for (const Vec3& v : mesh.vertices) EXPECT_NEAR(norm(v - Vec3{1, 2, 3}), 0.5, 1e-14);
    // Edges along a circle are within the sagitta, triangles between two of them within twice that.
    double lowest = 1;
    for (const auto& t : mesh.triangles) {
      const Vec3 middle = (1.0 / 3) * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
      lowest = std::min(lowest, norm(middle - Vec3{1, 2, 3}));
    }
    EXPECT_GT(lowest, 0.5 - 2 * sagitta);
    EXPECT_LT(volume(mesh), 4.0 / 3 * pi * 0.125);
    EXPECT_GT(volume(mesh), 4.0 / 3 * pi * std::pow(0.5 - 2 * sagitta, 3));
  }
}

TEST(BoundaryMeshes, PrismOfACircleKnowsTheDistanceInThePlane) {
  const double sagitta = 1e-4;
  const TriangleTree tree(prism_mesh(circle_outline({1, 2}, 0.5, sagitta), 0.05));
  EXPECT_EQ(tree.bad_edges(), 0u);
  for (double angle = 0.1; angle < 6; angle += 0.37)
    for (double r : {0.3, 0.45, 0.55, 0.8}) {
      const Vec3 p{1 + r * std::cos(angle), 2 + r * std::sin(angle), 0};
      const auto closest = tree.closest(p, 1);
      ASSERT_TRUE(closest.has_value());
      EXPECT_FALSE(tree.on_border(*closest));
      EXPECT_NEAR(closest->point[2], 0, 1e-15);
      EXPECT_NEAR(std::sqrt(closest->squared_distance), std::abs(r - 0.5), sagitta);
      EXPECT_EQ(tree.side(p, *closest) > 0, r > 0.5);
    }
}

}  // namespace
}  // namespace scarp

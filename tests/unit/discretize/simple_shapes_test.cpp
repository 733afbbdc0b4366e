// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/simple_shapes.hpp"

#include <numbers>
#include <set>

#include "tests/unit/discretize/scene.hpp"

namespace scarp {
namespace {

using test::box;
using test::Scene;

TEST(SimpleShapes, AnAlignedBoxHasNoDifferenceInVolume) {
  Scene scene(3, 0.1);
  scene.body("b", box({0.1, -0.2, 0.3}, {0.7, 0.1, 0.4}));
  const Model model = scene.build();
  EXPECT_EQ(model.particles.size(), 6u * 3 * 1 * 8);
  EXPECT_NEAR(model.volumes[0].relative_difference(), 0, 1e-14);
  EXPECT_NEAR(model.volumes[0].input_volume, 0.6 * 0.3 * 0.1, 1e-15);
  EXPECT_EQ(model.volumes[0].cells, 18u);
  EXPECT_EQ(model.volumes[0].full_cells, 18u);
  EXPECT_EQ(model.bodies[0].lattice.cells, (std::array<std::int32_t, 3>{6, 3, 1}));
  double mass = 0;
  for (double m : model.particles.mass) mass += m;
  EXPECT_NEAR(mass, 0.018 * 2000, 1e-12);
}

TEST(SimpleShapes, ABoxInPlaneStrainIgnoresZ) {
  Scene scene(2, 0.5);
  scene.body("b", box({0, 0, 7}, {2, 1, 7}));
  const Model model = scene.build();
  EXPECT_EQ(model.particles.size(), 4u * 2 * 4);
  EXPECT_TRUE(model.bodies[0].lattice.flat());
  EXPECT_EQ(model.domain.max, (Vec3{2, 1, 0}));
  EXPECT_DOUBLE_EQ(model.volumes[0].particle_volume, 2.0);
  for (const Vec3& x : model.particles.reference_position) EXPECT_EQ(x[2], 0);
}

// 40 x 40 cells with 2 x 2 points: 1,624 points of two disks is the published count of this problem.
TEST(SimpleShapes, TheTwoDisksHaveThePublishedNumberOfPoints) {
  Scene scene(2, 0.025);
  scene.scenario.domain.min = Vec3{0, 0, 0};
  scene.scenario.domain.max = Vec3{1, 1, 0};
  scene.body("left", DiskVolume{{{0.2, 0.2, 0}, 0.2}}).velocity = {0.1, 0.1, 0};
  scene.body("right", DiskVolume{{{0.8, 0.8, 0}, 0.2}}).velocity = {-0.1, -0.1, 0};
  const Model model = scene.build();
  EXPECT_EQ(model.particles.size(), 1624u);
  EXPECT_EQ(model.bodies[1].begin, 812u);
  EXPECT_NEAR(model.volumes[0].input_volume, std::numbers::pi * 0.04, 1e-15);
  EXPECT_EQ(model.particles.velocity[0], (Vec3{0.1, 0.1, 0}));
  EXPECT_EQ(model.particles.velocity[812], (Vec3{-0.1, -0.1, 0}));
  EXPECT_EQ(model.particles.body[811], 0);
  EXPECT_EQ(model.particles.body[812], 1);
}

// The slump of the validation: 110 x 35 cells of 1 m with 3 x 3 points give the published 21,840.
TEST(SimpleShapes, TheSlumpHasThePublishedNumberOfPoints) {
  Scene scene(2, 1);
  scene.body("slope", PolygonVolume{{{0, 0}, {110, 0}, {110, 15}, {48.75, 15}, {28.75, 35}, {0, 35}}}).points_per_cell =
      9;
  const Model model = scene.build();
  EXPECT_EQ(model.particles.size(), 21840u);
  EXPECT_DOUBLE_EQ(model.volumes[0].input_volume, 110 * 15 + 20 * 28.75 + 200);
}

TEST(SimpleShapes, ASphereIsRightWithinItsStaircase) {
  for (double h : {0.2, 0.1, 0.05}) {
    Scene scene(3, h);
    scene.body("s", SphereVolume{{{0.03, -0.01, 0.02}, 1}});
    const Model model = scene.build();
    const double sub = h / 2;
    // Lattice points in a smooth convex body: the error falls like sub^1.5 or faster.
    EXPECT_LT(std::abs(model.volumes[0].relative_difference()), 0.5 * std::pow(sub, 1.5)) << h;
    std::size_t inside = 0;
    for (const Vec3& x : model.particles.reference_position) inside += norm(x - Vec3{0.03, -0.01, 0.02}) < 1;
    EXPECT_EQ(inside, model.particles.size());
  }
}

TEST(SimpleShapes, ASphereIsSymmetricThoughPointsLieOnItsBorder) {
  Scene scene(3, 1);  // sub-cell centres at odd quarters: (2.25, 0.75, 0.25) etc. hit radius^2 = 5.6875 exactly
  scene.body("s", SphereVolume{{{0, 0, 0}, std::sqrt(5.6875)}});
  const Model model = scene.build();
  std::set<Vec3> points(model.particles.reference_position.begin(), model.particles.reference_position.end());
  for (const Vec3& p : points) EXPECT_TRUE(points.count({-p[0], p[1], -p[2]}) && points.count({p[1], p[2], p[0]}));
}

TEST(SimpleShapes, BodiesThatShareAFaceShareNoPoint) {
  // The shared face runs through sub-cell centres.
  Scene scene(2, 1);
  scene.body("lower", box({0, 0, 0}, {4, 1.25, 0}));
  scene.body("upper", box({0, 1.25, 0}, {4, 3, 0}));
  scene.body("wedge", PolygonVolume{{{0, 5}, {4, 5}, {4, 3}, {0, 3}}});
  const Model model = scene.build();
  std::set<Vec3> points(model.particles.reference_position.begin(), model.particles.reference_position.end());
  EXPECT_EQ(points.size(), 4u * 5 * 4);
  EXPECT_EQ(model.particles.size(), points.size());
}

TEST(SimpleShapes, AConcavePolygonIsFilledByItsOwnRule) {
  // A comb of three teeth: several spans per column and per row.
  const std::vector<Vec2> comb{{0, 0}, {5, 0}, {5, 3},   {4, 3.1}, {4, 1}, {3, 1.2}, {3, 2.9},
                               {2, 3}, {2, 1}, {1, 0.9}, {1, 3},   {0, 3}, {0, 0}};
  Scene scene(2, 0.05);
  scene.body("comb", PolygonVolume{comb});
  const Model model = scene.build();
  double area = 0;
  for (std::size_t i = 0; i + 1 < comb.size(); ++i)
    area += 0.5 * (comb[i][0] * comb[i + 1][1] - comb[i + 1][0] * comb[i][1]);
  EXPECT_NEAR(model.volumes[0].input_volume, area, 1e-13);
  EXPECT_NEAR(model.volumes[0].relative_difference(), 0, 2e-3);
  const PlanPolygon polygon(comb, "comb");
  for (const Vec3& x : model.particles.reference_position) EXPECT_TRUE(polygon.contains(x[0], x[1]));
}

TEST(SimpleShapes, AnyEmptyNeighbourMakesASurface) {
  Scene scene(3, 1);
  scene.body("b", box({0, 0, 0}, {4, 3, 2}));
  const Model model = scene.build();
  std::size_t flagged = 0;
  for (std::uint8_t s : model.particles.surface) flagged += s;
  EXPECT_EQ(flagged, 8u * 6 * 4 - 6u * 4 * 2);
  Scene plane(2, 1);
  plane.body("b", box({0, 0, 0}, {4, 3, 0}));
  flagged = 0;
  for (std::uint8_t s : plane.build().particles.surface) flagged += s;
  EXPECT_EQ(flagged, 8u * 6 - 6u * 4);
}

TEST(SimpleShapes, WhatHasNoMeaningIsRefused) {
  const auto refused = [](int dimension, Volume volume) {
    Scene scene(dimension, 1);
    scene.body("odd", std::move(volume));
    const std::string text = test::refusal(scene);
    EXPECT_TRUE(text.empty() || text.find("'odd'") != std::string::npos) << text;
    return text;
  };
  EXPECT_NE(refused(3, DiskVolume{{{0, 0, 0}, 1}}).find("2D"), std::string::npos);
  EXPECT_NE(refused(2, SphereVolume{{{0, 0, 0}, 1}}).find("3D"), std::string::npos);
  EXPECT_NE(refused(3, PolygonVolume{{{0, 0}, {1, 0}, {1, 1}}}).find("2D"), std::string::npos);
  EXPECT_NE(refused(2, MeshVolume{{"a.ply"}}).find("3D"), std::string::npos);
  EXPECT_NE(refused(2, test::sunk_by(1)).find("3D"), std::string::npos);
  EXPECT_NE(refused(3, box({0, 0, 0}, {1, 1, 0})).find("along z"), std::string::npos);
  EXPECT_NE(refused(2, PolygonVolume{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}).find("simple"), std::string::npos);
  EXPECT_NE(refused(2, PolygonVolume{{{0, 0}, {2, 2}}}).find("3 corners"), std::string::npos);
  EXPECT_NE(refused(2, PolygonVolume{{{0, 0}, {1, 1}, {2, 2}}}), "");
  EXPECT_NE(refused(2, PolygonVolume{{{0, 0}, {1, NAN}, {2, 2}}}).find("finite"), std::string::npos);
  EXPECT_NE(refused(3, SphereVolume{{{0, 0, 0}, -1}}).find("radius"), std::string::npos);
  EXPECT_EQ(refused(3, SphereVolume{{{0, 0, 0}, 1}}), "");
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/gridding.hpp"

#include <tuple>

#include "tests/unit/discretize/scene.hpp"

namespace scarp {
namespace {

using test::box;
using test::refusal;
using test::Scene;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Axis, CountsExactlyWhatItsPositionsSay) {
  for (double origin : {0.0, -3.7, 1234.1})
    for (int per_cell : {1, 2, 3}) {
      const Axis axis = Axis::centres(origin, 0.1, 20, per_cell);
      for (int n = -5; n < 70; ++n)
        for (double off : {0.0, 1e-17, 0.013}) {
          const double v = axis.at(n) + off;
          std::int32_t slow = 0;
          while (slow < axis.count && axis.at(slow) < v) ++slow;
          EXPECT_EQ(axis.first_at_or_above(v), slow);
        }
      EXPECT_EQ(axis.first_at_or_above(-1e300), 0);
      EXPECT_EQ(axis.first_at_or_above(1e300), axis.count);
    }
}

TEST(Gridding, BodiesBoundsGrowToWholeCells) {
  Scene scene(3, 0.5);
  scene.body("b", box({-0.7, 0.5, 0.1}, {0.9, 1.0, 0.2}));
  scene.scenario.domain.boundary.z_min = Condition::fixed;
  scene.scenario.domain.boundary.x_max = Condition::roller;
  const Model model = scene.build();
  EXPECT_EQ(model.domain.min, (Vec3{-1, 0.5, 0}));
  EXPECT_EQ(model.domain.max, (Vec3{1, 1, 0.5}));
  EXPECT_EQ(model.domain.faces, (std::array<Face, 6>{Condition::free, Condition::roller, Condition::free,
                                                     Condition::free, Condition::fixed, Condition::free}));
  EXPECT_EQ(model.bodies[0].lattice.cells, (std::array<std::int32_t, 3>{4, 1, 1}));
}

TEST(Gridding, LatticeNodesAreWholeCellsFromTheDomain) {
  Scene scene(3, 0.4);
  scene.scenario.domain.min = Vec3{0.1, 0.2, -0.3};
  scene.scenario.domain.max = Vec3{4.1, 4.2, 3.7};
  scene.body("own", box({1.25, 1.3, 1.4}, {2.2, 2.3, 2.4})).cell = 0.1;
  scene.body("common", box({1.25, 1.3, 1.4}, {2.2, 2.3, 2.4}));
  const Model model = scene.build();
  for (const Body& body : model.bodies)
    for (int a = 0; a < 3; ++a) {
      const double cells = (body.lattice.origin[a] - model.domain.min[a]) / body.lattice.cell;
      EXPECT_NEAR(cells, std::round(cells), 1e-9);
    }
  EXPECT_EQ(model.bodies[0].lattice.cell, 0.1);
  EXPECT_EQ(model.bodies[1].lattice.cell, 0.4);
}

TEST(Gridding, PointsStandInOrderAtTheCentresOfSubCells) {
  Scene scene(3, 1);
  scene.body("b", SphereVolume{{{2.2, 2.1, 2.3}, 1.9}}).points_per_cell = 27;
  scene.body("c", box({5, 0, 0}, {7, 2, 2}));
  const Model model = scene.build();
  const auto key = [&](const Body& body, std::size_t p, int n) {
    const Vec3 x = model.particles.reference_position[p] - body.lattice.origin;
    std::array<int, 3> cell, sub;
    for (int a = 0; a < 3; ++a) {
      cell[a] = static_cast<int>(std::floor(x[a]));
      const double within = (x[a] - cell[a]) * n;
      sub[a] = static_cast<int>(std::floor(within));
      EXPECT_NEAR(within, sub[a] + 0.5, 1e-12);
    }
    return std::make_tuple(cell[2], cell[1], cell[0], sub[2], sub[1], sub[0]);
  };
  for (const Body& body : model.bodies)
    for (std::size_t p = body.begin; p < body.end; ++p) {
      EXPECT_EQ(model.particles.id[p], static_cast<std::int64_t>(p));
      const int n = body.name == "b" ? 3 : 2;
      if (p == body.begin) continue;
      EXPECT_LT(key(body, p - 1, n), key(body, p, n));
    }
}

TEST(Gridding, SayNoToABodyOutsideTheDomainInTheSitesCoordinates) {
  Scene scene(3, 1);
  scene.site.origin = {500000, 4100000, 0};
  scene.scenario.domain.max = Vec3{10, 10, 5};
  scene.body("wall", box({0, 0, 0}, {4, 12.5, 3}));
  const std::string text = refusal(scene);
  EXPECT_TRUE(has(text, "'wall'") && has(text, "highest y") && has(text, "4100012.5")) << text;
  scene.scenario.domain.max = Vec3{10, 13, 5};
  EXPECT_EQ(refusal(scene), "");
  scene.scenario.domain.min = Vec3{0.5, 0, 0};
  EXPECT_TRUE(has(refusal(scene), "lowest x"));
}

TEST(Gridding, RefusesAbsurdLatticesBeforeItAllocates) {
  const auto with_cell = [](double cell, Volume volume, int points = 0) {
    Scene scene(3, 1);
    BodyOptions& body = scene.body("b", std::move(volume));
    body.cell = cell;
    body.points_per_cell = points;
    return refusal(scene);
  };
  EXPECT_TRUE(has(with_cell(1e-4, box({0, 0, 0}, {9, 9, 9})), "about 5.83e+15 "));
  EXPECT_TRUE(has(with_cell(1e-300, box({0, 0, 0}, {9, 9, 9})), "too many"));
  EXPECT_TRUE(has(with_cell(1e-4, box({0, 0, 0}, {9, 9, 1e-4})), "too many"));
  EXPECT_TRUE(has(with_cell(1e-9, box({0, 0, 0}, {1e-9, 1e-9, 9})), "too many"));
  EXPECT_TRUE(has(with_cell(0.5, box({0, 0, 0}, {1e30, 1, 1})), "2^31"));
  EXPECT_TRUE(has(with_cell(1, box({0, 0, 0}, {1, 1, 1}), 4), "cube"));
  EXPECT_TRUE(has(with_cell(0, box({0, 0, 0}, {1, 1, 1})), "above 0"));
  EXPECT_EQ(with_cell(1, box({0, 0, 0}, {1, 1, 1}), 64), "");
}

TEST(Gridding, ABodyWithoutAPointIsRefused) {
  Scene scene(3, 1);
  scene.body("sliver", box({0.3, 0, 0}, {0.4, 1, 1}));
  const std::string text = refusal(scene);
  EXPECT_TRUE(has(text, "'sliver'") && has(text, "cells of 1 m") && has(text, "x 1 x 1 m")) << text;
}

TEST(Gridding, DomainsThatAreNoWholeNumberOfCellsAreRefused) {
  Scene scene(2, 0.3);
  scene.scenario.domain.min = Vec3{0, 0, 0};
  scene.scenario.domain.max = Vec3{1, 0.9, 0};
  scene.body("b", box({0, 0, 0}, {0.6, 0.6, 0}));
  EXPECT_TRUE(has(refusal(scene), "along x"));
  scene.scenario.domain.max = Vec3{0.9, 0.9, 0};
  EXPECT_EQ(refusal(scene), "");
  scene.scenario.bodies[0].cell = 0.2;  // 4.5 cells from face to face
  EXPECT_EQ(refusal(scene), "");
  scene.scenario.domain.boundary.y_max = Condition::roller;
  EXPECT_TRUE(has(refusal(scene), "upper y"));
  scene.scenario.bodies[0].velocity = {0, 0, 1};
  EXPECT_TRUE(has(refusal(scene), "out of the plane"));
}

TEST(Gridding, IsolatedPointsAreCounted) {
  Scene scene(2, 1);
  // A needle whose tip reaches one sub-cell centre two cells beyond the rest.
  scene.body(
      "b",
      PolygonVolume{{{0, 0}, {2, 0}, {2, 2}, {3.7, 2.24}, {4.1, 2.24}, {4.1, 2.26}, {3.7, 2.26}, {1.9, 2.01}, {0, 2}}});
  const Model model = scene.build();
  EXPECT_EQ(model.volumes[0].particles, 17u);
  EXPECT_EQ(model.volumes[0].isolated_particles, 1u);
  EXPECT_EQ(model.volumes[0].cells, 5u);
  EXPECT_EQ(model.volumes[0].full_cells, 4u);
}

}  // namespace
}  // namespace scarp

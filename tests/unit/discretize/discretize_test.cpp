// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/discretize.hpp"

#include <algorithm>

#include "tests/unit/discretize/scene.hpp"

namespace scarp {
namespace {

using test::above_plane;
using test::grid_scan;
using test::random_scan;
using test::refusal;
using test::Scene;
using test::sunk_by;

double hill(double x, double y) { return 6 + 2 * std::sin(0.5 * x) + 0.3 * y; }

/// A bit of everything, with colours, classes and all rules.
Scene busy_scene() {
  Scene scene(3, 0.5);
  scene.material("rock", 2600);
  scene.material("brick", 1800);
  PointCloud scan = random_scan(3000, 10, 21, hill);
  for (const Vec3& p : scan.positions) {
    scan.colour.push_back({static_cast<std::uint16_t>(p[0] * 6000), 65535, static_cast<std::uint16_t>(257 * 9)});
    scan.classification.push_back(p[0] > 6 ? 6 : 2);
  }
  scene.scans["scan"] = std::move(scan);
  BodyOptions& slide = scene.body("slide", sunk_by(2.2));
  scene.surfaces["bedrock.asc"] = {3, 3, 6.0, -1, -1, {4, 5, 6, 4, 5, 6, 4, 5, 6}, {}};
  slide.materials = {BelowRule{{"bedrock.asc"}, "rock"}, ClassRule{6, "brick"},
                     PrismRule{{{0, 0}, {3, 0}, {0, 3}}, "rock"}, BoxRule{{{1, 1, 0}, {2, 2, 99}}, "soil"}};
  BodyOptions& ball = scene.body("ball", SphereVolume{{{15, 5, 8}, 1.3}});
  ball.cell = 0.25;
  ball.material = "rock";
  ball.velocity = {1, 2, 3};
  return scene;
}

TEST(Discretize, HasTheSameBitsForAnyNumberOfThreads) {
  const Scene scene = busy_scene();
  const Model one = scene.build(1);
  for (int threads : {2, 3}) test::expect_same_bits(one, scene.build(threads));
}

TEST(Discretize, BodiesKnowTheirBoundary) {
  Scene solid(3, 0.5);
  solid.body("box", test::box({0, 0, 0}, {1, 2, 3}));
  solid.body("ball", SphereVolume{{{5, 5, 5}, 1}});
  solid.meshes["box.ply"] = box_mesh({{8, 8, 8}, {9, 9, 9}});
  solid.body("mesh", MeshVolume{{"box.ply"}});
  solid.scans["scan"] = grid_scan(4, 0, 4, hill);
  solid.body("ground", sunk_by(2));
  Scene flat(2, 0.5);
  flat.body("box", test::box({0, 0, 0}, {1, 2, 0}));
  flat.body("disk", DiskVolume{{{5, 5, 0}, 1}});
  flat.body("polygon", PolygonVolume{{{7, 0}, {9, 0}, {8, 2}}});
  for (const Scene& scene : {solid, flat}) {
    const Model model = scene.build();
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const Body& body = model.bodies[b];
      if (body.name == "ground") {
        EXPECT_TRUE(body.boundary.triangles.empty());
        continue;
      }
      // By the divergence theorem; of a prism, which has no ends, from the flux through its sides alone.
      double volume = 0;
      for (const auto& t : body.boundary.triangles) {
        const auto& v = body.boundary.vertices;
        const Vec3 area = 0.5 * cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]);
        volume += dot(area, v[t[0]]) / scene.scenario.domain.dimension;
      }
      if (scene.scenario.domain.dimension == 2) volume /= 2 * body.boundary.vertices[1][2];
      EXPECT_NEAR(volume, model.volumes[b].input_volume, body.name == "ball" ? 0.02 : 0.01) << body.name;
    }
  }
}

TEST(Discretize, RulesGoByPointAndLaterOnesWin) {
  const Scene scene = busy_scene();
  const Model model = scene.build(2);
  ASSERT_EQ(model.materials.size(), 3u);
  EXPECT_EQ(model.materials[0].name, "brick");
  EXPECT_EQ(model.materials[2].name, "soil");
  const PointCloud& scan = scene.scans.at("scan");
  const Body& slide = model.bodies[0];
  for (std::size_t p = slide.begin; p < slide.end; ++p) {
    const Vec3& x = model.particles.reference_position[p];
    int expected = x[2] < 4 + (x[0] + 1) / 6 ? 1 : 2;
    const std::size_t colour_of = static_cast<std::size_t>(
        std::find_if(scan.colour.begin(), scan.colour.end(),
                     [&](const Rgb16& c) { return (c[0] + 128) / 257 == model.particles.colour[p][0]; }) -
        scan.colour.begin());
    if (std::abs(x[0] - 6) < 0.6) continue;  // the class of the nearest point may be either
    if (x[0] > 6) expected = 0;
    if (x[0] + x[1] < 3) expected = 1;
    if (x[0] > 1 && x[0] < 2 && x[1] > 1 && x[1] < 2) expected = 2;
    EXPECT_EQ(model.particles.material[p], expected) << x[0] << " " << x[1] << " " << x[2];
    ASSERT_LT(colour_of, scan.size());
    EXPECT_NEAR(model.particles.colour[p][0] * 257 / 6000.0, x[0], 0.7);
    EXPECT_EQ(model.particles.colour[p][1], 255);
    EXPECT_EQ(model.particles.colour[p][2], 9);
    const double density = expected == 0 ? 1800 : expected == 1 ? 2600 : 2000;
    EXPECT_DOUBLE_EQ(model.particles.mass[p], density * 0.5 * 0.5 * 0.5 / 8);
  }
  double sum = 0;
  for (const auto& [name, volume] : model.volumes[0].volume_by_material) sum += volume;
  EXPECT_EQ(model.volumes[0].volume_by_material.size(), 3u);
  EXPECT_NEAR(sum, model.volumes[0].particle_volume, 1e-10);
  EXPECT_EQ(model.volumes[0].points_beside_rule_surface, 0u);
  ASSERT_EQ(model.volumes[1].volume_by_material.size(), 1u);
  EXPECT_EQ(model.volumes[1].volume_by_material[0].first, "rock");
}

TEST(Discretize, ASteepFaceTakesTheColourOfItsOwnPoints) {
  // A step with red points above, green ones on the face and blue ones below.
  PointCloud scan;
  for (int n = 0; n <= 16; ++n) {
    const double y = 0.5 * n;
    for (double x : {0.0, 2.0, 4.0}) scan.positions.push_back({x, y, 6}), scan.colour.push_back({65535, 0, 0});
    for (double z : {5.0, 4.0, 3.0})
      scan.positions.push_back({4.1 - 0.01 * z, y, z}), scan.colour.push_back({0, 65535, 0});
    for (double x : {4.11, 6.0, 8.0}) scan.positions.push_back({x, y, 2}), scan.colour.push_back({0, 0, 65535});
  }
  Scene scene(3, 1);
  scene.scans["scan"] = scan;
  scene.body("b", above_plane(0));
  const Model model = scene.build();
  const auto colour_at = [&](Vec3 x) {
    for (std::size_t p = 0; p < model.particles.size(); ++p)
      if (norm(model.particles.reference_position[p] - x) < 1e-9) return model.particles.colour[p];
    return Rgb8{1, 1, 1};
  };
  EXPECT_EQ(colour_at({3.75, 4.25, 5.75}), (Rgb8{255, 0, 0}));
  EXPECT_EQ(colour_at({3.75, 4.25, 3.25}), (Rgb8{0, 255, 0}));  // on the face
  EXPECT_EQ(colour_at({1.75, 4.25, 0.25}), (Rgb8{255, 0, 0}));  // deep below the top
  EXPECT_EQ(colour_at({6.25, 4.25, 0.25}), (Rgb8{0, 0, 255}));
}

TEST(Discretize, PointsBesideARulesRasterAreCounted) {
  Scene scene(3, 1);
  scene.material("rock", 2600);
  scene.body("b", test::box({0, 0, 0}, {4, 4, 2})).materials = {BelowRule{{"half.asc"}, "rock"}};
  scene.surfaces["half.asc"] = {2, 2, 10.0, -8, -3, {1, 1, 1, 1}, {}};  // covers x < 2
  const Model model = scene.build();
  EXPECT_EQ(model.volumes[0].points_beside_rule_surface, 4u * 8 * 4);
  EXPECT_DOUBLE_EQ(model.volumes[0].volume_by_material[0].second, 8);
}

TEST(Discretize, RulesThatCannotHoldAreRefused) {
  const auto refused = [](int dimension, MaterialRule rule, Volume volume = test::box({0, 0, 0}, {1, 1, 1})) {
    Scene scene(dimension, 0.5);
    scene.scans["scan"] = grid_scan(2, 0, 2, hill);
    scene.body("b", std::move(volume)).materials = {std::move(rule)};
    return refusal(scene);
  };
  EXPECT_NE(refused(3, ClassRule{2, "soil"}).find("from a scan"), std::string::npos);
  EXPECT_NE(refused(3, ClassRule{2, "soil"}, sunk_by(1)).find("classified"), std::string::npos);
  EXPECT_NE(refused(3, BelowRule{{"a.asc"}, "soil"}).find("a.asc"), std::string::npos);
  EXPECT_NE(refused(2, BelowRule{{"a.asc"}, "soil"}).find("three dimensions"), std::string::npos);
  EXPECT_NE(refused(3, BoxRule{{{0, 0, 0}, {1, 1, 1}}, "sand"}).find("rule 1: unknown material: found 'sand'"),
            std::string::npos);
  EXPECT_NE(refused(3, PrismRule{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, "soil"}).find("prism"), std::string::npos);
  Scene scene(3, 1);
  EXPECT_NE(refusal(scene).find("at least one body"), std::string::npos);
  scene.body("b", test::box({0, 0, 0}, {1, 1, 1})).material = "sand";
  EXPECT_NE(refusal(scene).find("soil"), std::string::npos);
}

TEST(Discretize, TheBaseHoldsThePlaneBelow) {
  Scene scene(3, 1);
  scene.scans["scan"] = grid_scan(4, 0, 4, [](double, double) { return 3.0; });
  scene.body("b", above_plane(0));
  Model model = scene.build();
  ASSERT_EQ(model.bodies[0].held.size(), 1u);
  const NodeSet& base = model.bodies[0].held[0];
  EXPECT_EQ(base.name, "base");
  EXPECT_EQ(base.condition, Condition::fixed);
  EXPECT_EQ(base.axis, -1);
  ASSERT_EQ(base.nodes.size(), 25u);
  for (std::int32_t n = 0; n < 25; ++n) EXPECT_EQ(base.nodes[n], (std::array<std::int32_t, 3>{n % 5, n / 5, 0}));

  // The base runs through the cells at 0.6: their bottom nodes hold, the ones above do not.
  scene.scenario.domain.min = Vec3{0, 0, 0};
  ScanVolume volume = above_plane(0.6);
  volume.base = Condition::roller;
  scene.scenario.bodies[0].volume = volume;
  model = scene.build();
  EXPECT_EQ(model.bodies[0].held[0].nodes.size(), 25u);
  EXPECT_EQ(model.bodies[0].held[0].condition, Condition::roller);
  EXPECT_EQ(model.bodies[0].held[0].axis, 2);
  // At 0.9 no point is left in the lowest cells; the next nodes at 1 are above the base and hold all the same.
  volume.base_elevation = 0.9;
  scene.scenario.bodies[0].volume = volume;
  model = scene.build();
  ASSERT_EQ(model.bodies[0].held[0].nodes.size(), 25u);
  EXPECT_EQ(model.bodies[0].held[0].nodes[0][2], 1);
  volume.base = Condition::free;
  scene.scenario.bodies[0].volume = volume;
  EXPECT_TRUE(scene.build().bodies[0].held.empty());
}

TEST(Discretize, TheSkirtIsHeldWhereAsked) {
  Scene scene(3, 1);
  scene.scans["scan"] = grid_scan(8, 0, 4, [](double, double) { return 2.0; });
  ScanVolume volume;
  volume.scan = "scan";
  volume.base_elevation = 0;
  volume.base = Condition::free;
  volume.hold_skirt = true;
  scene.body("slab", volume);
  const Model model = scene.build();
  ASSERT_EQ(model.bodies[0].held.size(), 1u);
  const NodeSet& skirt = model.bodies[0].held[0];
  EXPECT_EQ(skirt.name, "skirt");
  EXPECT_EQ(skirt.condition, Condition::fixed);
  // Of 5 x 5 nodes in plan the 16 on the border, in three layers.
  ASSERT_EQ(skirt.nodes.size(), 48u);
  for (const auto& node : skirt.nodes) EXPECT_TRUE(node[0] == 0 || node[0] == 4 || node[1] == 0 || node[1] == 4);
}

TEST(Discretize, ASunkenBaseHoldsEveryColumnAndNothingAboveIt) {
  Scene scene(3, 0.5);
  scene.scans["scan"] = random_scan(2000, 12, 22, [](double x, double y) { return 20 + 1.2 * x - 0.4 * y; });
  scene.body("b", sunk_by(3));
  const Model model = scene.build();
  const Body& body = model.bodies[0];
  const auto& nodes = body.held[0].nodes;
  EXPECT_TRUE(std::is_sorted(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) {
    return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
  }));
  const auto held = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
    return std::find(nodes.begin(), nodes.end(), std::array<std::int32_t, 3>{i, j, k}) != nodes.end();
  };
  const auto node = [&](const auto& n) { return body.lattice.origin + 0.5 * Vec3{n[0] * 1.0, n[1] * 1.0, n[2] * 1.0}; };
  for (const auto& n : nodes) {
    const Vec3 x = node(n);
    // At or below the base, or the bottom of a lowest cell, which is at most a cell and the slope across it higher.
    EXPECT_LE(x[2], 17 + 1.2 * x[0] - 0.4 * x[1] + 1.6 * 0.5 + 0.5);
  }
  std::vector<int> lowest(body.lattice.cells[0] * body.lattice.cells[1], 1 << 30);
  for (const Vec3& p : model.particles.reference_position) {
    const Vec3 c = 2.0 * (p - body.lattice.origin);
    int& low = lowest[static_cast<int>(c[1]) * body.lattice.cells[0] + static_cast<int>(c[0])];
    low = std::min(low, static_cast<int>(c[2]));
  }
  for (std::int32_t j = 0; j < body.lattice.cells[1]; ++j)
    for (std::int32_t i = 0; i < body.lattice.cells[0]; ++i) {
      const int k = lowest[j * body.lattice.cells[0] + i];
      ASSERT_LT(k, 1 << 30);
      EXPECT_TRUE(held(i, j, k) && held(i + 1, j, k) && held(i, j + 1, k) && held(i + 1, j + 1, k));
    }
}

// Coordinates that are whole multiples of 2^-10 m can be moved by whole metres without rounding: then everything but
// the place must agree. This is what localising a survey in UTM coordinates does.
TEST(Discretize, AMovedScanGivesTheSameModelElsewhere) {
  Scene here = busy_scene();
  here.scenario.bodies.resize(1);
  here.scenario.bodies[0].volume = sunk_by(2.25);
  here.scenario.bodies[0].materials.clear();
  for (Vec3& p : here.scans["scan"].positions)
    for (double& x : p) x = std::round(x * 1024) / 1024;
  Scene there = here;
  const Vec3 shift{512000, 4100096, 256};
  for (Vec3& p : there.scans["scan"].positions) p = p + shift;
  const Model a = here.build(), b = there.build();
  ASSERT_EQ(a.particles.size(), b.particles.size());
  EXPECT_NEAR(a.volumes[0].input_volume, b.volumes[0].input_volume, 1e-9 * a.volumes[0].input_volume);
  for (std::size_t p = 0; p < a.particles.size(); ++p)
    ASSERT_EQ(a.particles.reference_position[p] + shift, b.particles.reference_position[p]);
  EXPECT_EQ(a.particles.surface, b.particles.surface);
  EXPECT_EQ(a.bodies[0].held[0].nodes, b.bodies[0].held[0].nodes);
  // The same survey, localised: nothing at all may differ.
  for (Vec3& p : there.scans["scan"].positions) p = p - shift;
  there.site.origin = shift;
  test::expect_same_bits(a, there.build());
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/terrain_solid.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "discretize/plan_integral.hpp"
#include "tests/unit/discretize/scene.hpp"

namespace scarp {
namespace {

using test::above_plane;
using test::grid_scan;
using test::random_scan;
using test::Scene;
using test::sunk_by;

Scene terrain(double cell, PointCloud scan, ScanVolume volume) {
  Scene scene(3, cell);
  scene.scans["scan"] = std::move(scan);
  scene.body("slide", std::move(volume));
  return scene;
}

double dune(double x, double y) { return 5 + std::sin(0.9 * x) * std::cos(0.7 * y) + 0.1 * x; }

TEST(TerrainSolid, AFlatSlabIsExactInEveryNumber) {
  const Model model = terrain(1, grid_scan(4, 0, 8, [](double, double) { return 3.0; }), above_plane(0)).build();
  const VolumeReport& report = model.volumes[0];
  EXPECT_DOUBLE_EQ(report.input_volume, 192);
  EXPECT_DOUBLE_EQ(report.particle_volume, 192);
  EXPECT_DOUBLE_EQ(report.plan_area, 64);
  EXPECT_DOUBLE_EQ(report.mean_thickness_in_cells, 3);
  EXPECT_EQ(report.full_cells, 192u);
  std::size_t flagged = 0;
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    flagged += model.particles.surface[p];
    EXPECT_EQ(model.particles.surface[p] != 0, model.particles.reference_position[p][2] > 2.5);
  }
  EXPECT_EQ(flagged, 256u);
}

TEST(TerrainSolid, VolumesOverATiltedPlaneAreExact) {
  // z = 1 + x/2 - y/4 over [0, 8]^2, random TIN: the prism integrals have closed forms.
  const auto plane = [](double x, double y) { return 1 + x / 2 - y / 4; };
  const PointCloud scan = random_scan(500, 8, 7, plane);
  EXPECT_NEAR(terrain(1, scan, above_plane(-2)).build().volumes[0].input_volume, 64 * (1 + 2 - 1 + 2), 1e-11);
  EXPECT_NEAR(terrain(1, scan, sunk_by(1.5)).build().volumes[0].input_volume, 96, 1e-11);
  // Base inside the surface's range, z = 3: positive part of (x/2 - y/4 - 2), which vanishes at x = 4 + y/2.
  // Integral over x from 4 + y/2 to 8 is (4 - y/2)^2 / 4; over y it is (4^3 - 0) * 2 / 12.
  EXPECT_NEAR(terrain(1, scan, above_plane(3)).build().volumes[0].input_volume, 64.0 / 6, 1e-12);
}

TEST(TerrainSolid, TheCentreInRuleHasNoBias) {
  const auto plane = [](double x, double y) { return 1.2345 + 0.377 * x - 0.219 * y; };
  const PointCloud scan = random_scan(300, 5, 8, plane);
  Scene scene = terrain(0.1, scan, above_plane(-1.05));
  scene.scenario.domain.min = Vec3{-0.063, -0.021, -2.2};  // no tilted face meets the lattice by chance
  EXPECT_LT(std::abs(scene.build().volumes[0].relative_difference()), 1e-3);
  scene.scenario.bodies[0].volume = sunk_by(1.003);
  EXPECT_LT(std::abs(scene.build().volumes[0].relative_difference()), 1e-3);
  // A level base between the sub-cells is off by the same part of a sub-cell, at most half, in every column.
  scene.scenario.bodies[0].volume = above_plane(-1.03);
  const VolumeReport report = scene.build().volumes[0];
  EXPECT_NEAR(report.particle_volume - report.input_volume, 0.02 * 25, 1e-3 * report.input_volume);
}

TEST(TerrainSolid, ADuneIsRightWithinItsStaircase) {
  const PointCloud scan = random_scan(4000, 8, 9, dune);
  for (double h : {0.8, 0.4, 0.2}) {
    const VolumeReport report = terrain(h, scan, above_plane(0)).build().volumes[0];
    EXPECT_LT(std::abs(report.relative_difference()), 0.01 * h) << h;
    EXPECT_NEAR(report.input_volume / (8 * 8 * 5.5), 1, 0.1);
  }
}

// Every sub-cell of the lattice against a search of its triangle.
TEST(TerrainSolid, PointsAreThoseBelowTheirTriangle) {
  const PointCloud scan = random_scan(300, 8, 10, dune);
  const TerrainSolid solid = close_terrain(above_plane(4.8), scan, nullptr, "b", 1);
  Domain domain{3, 0.5, {0, 0, 0}, {8, 8, 8}, {}};
  BodyOptions options;
  const SubLattice grid = lay_lattice(domain, options, {"b", solid.bounds, solid.volume});
  const Columns columns = fill(solid, grid, 1);
  for (std::int32_t j = 0; j < grid.y.count; ++j)
    for (std::int32_t i = 0; i < grid.x.count; ++i) {
      const double x = grid.x.at(i), y = grid.y.at(j);
      double top = NAN;
      for (std::size_t t = 0; t < solid.tin.triangles.size(); ++t) {
        const auto c = solid.tin.corners(t);
        double w[3], sum = 0;
        for (int a = 0; a < 3; ++a) {
          const Vec3 &p = c[(a + 1) % 3], &q = c[(a + 2) % 3];
          sum += w[a] = (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
        }
        if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) top = (w[0] * c[0][2] + w[1] * c[1][2] + w[2] * c[2][2]) / sum;
      }
      ASSERT_NEAR(columns.top[grid.column(i, j)], top, 1e-12);
      for (std::int32_t k = 0; k < grid.up.count; ++k)
        EXPECT_EQ(columns.contains(grid.column(i, j), k), grid.up.at(k) >= 4.8 && grid.up.at(k) < top);
    }
}

TEST(TerrainSolid, NoColumnFallsThroughASeam) {
  // Scan points right on the columns and rows: each line runs through vertices and along edges.
  const Model model =
      terrain(1, grid_scan(32, 0.25, 16, [](double x, double y) { return 4 + 0.01 * x * y; }), sunk_by(2)).build();
  std::set<Vec2> columns;
  for (const Vec3& p : model.particles.reference_position) columns.insert({p[0], p[1]});
  EXPECT_EQ(columns.size(), 32u * 32);
}

TEST(TerrainSolid, OutlinesCutExactly) {
  const auto plane = [](double x, double y) { return 10 + 0.3 * x + 0.2 * y; };
  const PointCloud scan = random_scan(2000, 10, 11, plane);
  const auto volume_within = [&](std::vector<Vec2> outline) {
    ScanVolume volume = above_plane(0);
    volume.outline = std::move(outline);
    return terrain(0.5, scan, volume).build().volumes[0];
  };
  // Under a plane a polygon's volume is its area times the height at its centroid.
  const VolumeReport convex = volume_within({{2, 2}, {7, 3}, {4, 8}});
  const double triangle = 0.5 * (5 * 6 - 2 * 1);
  EXPECT_NEAR(convex.plan_area, triangle, 1e-12);
  EXPECT_NEAR(convex.input_volume, triangle * plane(13.0 / 3, 13.0 / 3), 1e-10);
  EXPECT_LT(std::abs(convex.relative_difference()), 0.02);
  // A U, clockwise and closed by hand: 8 x 8 less a notch of 4 x 6.
  const VolumeReport concave = volume_within({{1, 1}, {1, 9}, {3, 9}, {3, 3}, {7, 3}, {7, 9}, {9, 9}, {9, 1}, {1, 1}});
  EXPECT_NEAR(concave.plan_area, 64 - 24, 1e-12);
  EXPECT_NEAR(concave.input_volume, 64 * plane(5, 5) - 24 * plane(5, 6), 1e-10);
  EXPECT_LT(std::abs(concave.relative_difference()), 1e-2);
  // Wider than the scan: what counts is where both are.
  const VolumeReport wide = volume_within({{-5, -5}, {15, -5}, {15, 5}, {-5, 5}});
  EXPECT_NEAR(wide.plan_area, 50, 1e-12);
  EXPECT_NEAR(wide.input_volume, 50 * plane(5, 2.5), 1e-10);
}

TEST(TerrainSolid, AnOutlineWithManyCornersAgreesWithItsArea) {
  // A star of 2,000 corners, in a TIN of triangles much smaller and much larger than its edges.
  std::vector<Vec2> star;
  double area = 0;
  for (int n = 0; n < 2000; ++n) {
    const double angle = 2 * M_PI * n / 2000, r = 3 + std::cos(7 * angle) + (n % 2) * 0.3;
    star.push_back({5 + r * std::cos(angle), 5 + r * std::sin(angle)});
  }
  for (std::size_t n = 0; n < star.size(); ++n) {
    const Vec2 &p = star[n], &q = star[(n + 1) % star.size()];
    area += 0.5 * (p[0] * q[1] - q[0] * p[1]);
  }
  for (int points : {4, 20000}) {
    const PointCloud scan = random_scan(points, 10, 12, [](double, double) { return 2.0; });
    const PlanIntegral integral = integrate_tin(triangulate(scan.positions, 0), PlanPolygon(star, "star"), 0.5, 2);
    EXPECT_NEAR(integral.area, area, 1e-10);
    EXPECT_NEAR(integral.volume, 1.5 * area, 1e-10);
  }
}

TEST(TerrainSolid, BoundsAreThoseOfTheCutSurface) {
  // The scan rises to 100 m outside the outline, which must not count for the body's extent.
  PointCloud scan = grid_scan(20, 0, 10, [](double x, double y) { return x > 6 ? 100.0 : 1 + 0.1 * x + 0.1 * y; });
  ScanVolume volume = above_plane(0);
  volume.outline = {{1, 1}, {5.3, 2}, {5.3, 7}, {2, 5}};
  Scene scene = terrain(0.5, scan, volume);
  scene.scenario.domain.min = Vec3{1, 1, 0};
  scene.scenario.domain.max = Vec3{5.5, 7, 2.5};
  const Model model = scene.build();
  const TerrainSolid solid = close_terrain(volume, scan, nullptr, "b", 1);
  EXPECT_NEAR(solid.bounds.max[2], 1 + 0.53 + 0.7, 1e-12);
  EXPECT_NEAR(solid.bounds.min[0], 1, 1e-12);
  EXPECT_NEAR(solid.bounds.max[0], 5.3, 1e-12);
  EXPECT_NEAR(solid.bounds.max[1], 7, 1e-12);
  EXPECT_EQ(solid.bounds.min[2], 0);
}

TEST(TerrainSolid, LongBorderTrianglesArePeeledFromOutside) {
  // Two patches 10 m apart and a hole of 3 m inside the first: the bridge goes, the hole stays covered.
  PointCloud scan;
  for (int j = 0; j <= 10; ++j)
    for (int i = 0; i <= 10; ++i)
      for (double shift : {0.0, 20.0})
        if (shift > 0 || std::max(std::abs(i - 5), std::abs(j - 5)) >= 2)
          scan.positions.push_back({shift + i, static_cast<double>(j), 2});
  ScanVolume volume = above_plane(0);
  EXPECT_DOUBLE_EQ(close_terrain(volume, scan, nullptr, "b", 1).plan_area, 300);
  volume.longest_edge = 2;
  EXPECT_DOUBLE_EQ(close_terrain(volume, scan, nullptr, "b", 1).plan_area, 200);
  volume.longest_edge = 0.5;
  EXPECT_NE(test::refusal(terrain(1, scan, volume)).find("longest_edge"), std::string::npos);
}

TEST(TerrainSolid, OfPointsAtOnePlaceTheHighestCountsInAnyOrder) {
  PointCloud scan = grid_scan(8, 0, 8, [](double, double) { return 1.0; });
  const std::size_t count = scan.size();
  for (std::size_t i = 0; i < count; ++i) {
    scan.positions.push_back(scan.positions[i] + Vec3{0, 0, 2});
    scan.positions.push_back(scan.positions[i] + Vec3{0, 0, -3});
  }
  const Model model = terrain(1, scan, above_plane(0)).build();
  EXPECT_DOUBLE_EQ(model.volumes[0].input_volume, 192);
  std::reverse(scan.positions.begin(), scan.positions.end());
  test::expect_same_bits(model, terrain(1, scan, above_plane(0)).build());
}

TEST(TerrainSolid, SteepFacesBelongToTheFreeSurfaceAndTheSkirtDoesNot) {
  // A step of 4 m between x = 4 and x = 4.01.
  PointCloud scan;
  for (double y : {0.0, 8.0})
    for (auto [x, z] : {std::pair{0.0, 6.0}, {4.0, 6.0}, {4.01, 2.0}, {8.0, 2.0}}) scan.positions.push_back({x, y, z});
  const Model model = terrain(1, scan, above_plane(0)).build();
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    const Vec3& x = model.particles.reference_position[p];
    const bool face = x[0] > 3.5 && x[0] < 4 && x[2] > 2;
    const bool top = x[0] < 4 ? x[2] > 5.5 : x[2] > 1.5;
    EXPECT_EQ(model.particles.surface[p] != 0, face || top) << x[0] << " " << x[1] << " " << x[2];
  }
}

/// A body between the surfaces of "scan" and "base".
Scene between(double cell, PointCloud top, PointCloud base) {
  ScanVolume volume;
  volume.scan = "scan";
  volume.close = Closing::surface;
  volume.base_scan = "base";
  volume.base = Condition::free;
  Scene scene = terrain(cell, std::move(top), volume);
  scene.scans["base"] = std::move(base);
  return scene;
}

PointCloud moved(PointCloud cloud, const Vec3& by) {
  for (Vec3& p : cloud.positions) p = p + by;
  return cloud;
}

TEST(TerrainSolid, BetweenTwoSurfacesIsExactToo) {
  // As above a base at z = 3, but of other triangles that reach farther.
  const auto plane = [](double x, double y) { return 1 + x / 2 - y / 4; };
  const PointCloud top = random_scan(500, 8, 7, plane);
  const PointCloud level = moved(random_scan(300, 12, 12, [](double, double) { return 3.0; }), {-2, -2, 0});
  const Model model = between(0.5, top, level).build();
  EXPECT_NEAR(model.volumes[0].input_volume, 64.0 / 6, 1e-12);
  EXPECT_NEAR(model.volumes[0].plan_area, 16, 1e-12);  // x from 4 + y/2 to 8
  for (const Vec3& x : model.particles.reference_position) {
    EXPECT_GE(x[2], 3);
    EXPECT_LT(x[2], plane(x[0], x[1]));
  }
  EXPECT_TRUE(model.bodies[0].held.empty());

  // What both cover: x and y from 3 to 8; the base is tilted, and 1 below in the middle of that.
  const auto tilted = [&](double x, double y) { return plane(x, y) - 1 + 0.1 * (x - 5.5) - 0.05 * (y - 5.5); };
  const PointCloud beside =
      moved(random_scan(400, 8, 13, [&](double x, double y) { return tilted(x + 3, y + 3); }), {3, 3, 0});
  EXPECT_NEAR(between(0.5, top, beside).build().volumes[0].input_volume, 25, 1e-11);

  // Under an outline: its area times the thickness at its centroid.
  Scene cut = between(0.5, top, beside);
  std::get<ScanVolume>(cut.scenario.bodies[0].volume).outline = {{4, 4}, {7, 3.5}, {5, 7}};
  const VolumeReport report = cut.build().volumes[0];
  const double area = 0.5 * (3 * 3 + 0.5 * 1), x = 16.0 / 3, y = 14.5 / 3;
  EXPECT_NEAR(report.plan_area, area, 1e-12);
  EXPECT_NEAR(report.input_volume, area * (plane(x, y) - tilted(x, y)), 1e-11);
}

TEST(TerrainSolid, BetweenTwoDunesIsWhatItsColumnsHold) {
  const PointCloud top = random_scan(3000, 8, 14, dune);
  const PointCloud base =
      random_scan(2000, 8, 15, [](double x, double y) { return 4.6 + 0.3 * std::cos(x) + 0.1 * y; });
  Scene scene = between(0.2, top, base);
  const Model model = scene.build();
  EXPECT_LT(std::abs(model.volumes[0].relative_difference()), 2e-3);
  const Vec3 low = model.domain.min, high = model.domain.max;
  // The bounds are those of the part that has thickness.
  const auto& volume = std::get<ScanVolume>(scene.scenario.bodies[0].volume);
  const TerrainSolid solid = close_terrain(volume, top, &base, "b", 1);
  EXPECT_GE(solid.bounds.min[2], 4.3);
  EXPECT_LT(solid.bounds.max[2], 6.9);
  for (const Vec3& x : model.particles.reference_position)
    for (int a = 0; a < 3; ++a) {
      EXPECT_GE(x[a], std::max(low[a], solid.bounds.min[a]) - 0.1);
      EXPECT_LE(x[a], std::min(high[a], solid.bounds.max[a]) + 0.1);
    }
  test::expect_same_bits(model, scene.build(3));
}

TEST(TerrainSolid, NodesBelowATiltedBaseAreHeld) {
  const PointCloud top = grid_scan(8, 0, 8, [](double, double) { return 4.0; });
  const PointCloud base = grid_scan(8, 0, 8, [](double x, double) { return 0.25 * x; });
  Scene scene = between(1, top, base);
  std::get<ScanVolume>(scene.scenario.bodies[0].volume).base = Condition::fixed;
  const Model model = scene.build();
  ASSERT_EQ(model.bodies[0].held.size(), 1u);
  for (const auto& node : model.bodies[0].held[0].nodes) {
    const Lattice& lattice = model.bodies[0].lattice;
    const double x = lattice.origin[0] + node[0] * lattice.cell, z = lattice.origin[2] + node[2] * lattice.cell;
    EXPECT_LE(z, 0.25 * x + 1);
  }
}

TEST(TerrainSolid, NonsenseIsRefused) {
  const PointCloud flat = grid_scan(4, 0, 8, [](double, double) { return 3.0; });
  const auto refused = [&](ScanVolume volume, const PointCloud& scan) {
    return test::refusal(terrain(1, scan, volume));
  };
  ScanVolume bare;
  bare.scan = "scan";
  EXPECT_NE(refused(bare, flat).find("base_elevation"), std::string::npos);
  bare.close = Closing::depth;
  EXPECT_NE(refused(bare, flat).find("needs a depth"), std::string::npos);
  EXPECT_NE(refused(above_plane(5), flat).find("encloses"), std::string::npos);
  EXPECT_NE(refused(above_plane(0), {}).find("0 points"), std::string::npos);
  PointCloud line;
  for (int i = 0; i < 9; ++i) line.positions.push_back({i * 1.0, i * 2.0, 1});
  EXPECT_NE(refused(above_plane(0), line).find("one line"), std::string::npos);
  PointCloud nan = flat;
  nan.positions[3][2] = NAN;
  EXPECT_NE(refused(above_plane(0), nan).find("point 3"), std::string::npos);
  ScanVolume away = above_plane(0);
  away.outline = {{20, 20}, {22, 20}, {22, 22}};
  EXPECT_NE(refused(away, flat).find("encloses"), std::string::npos);
  ScanVolume unknown = above_plane(0);
  unknown.scan = "after";
  EXPECT_NE(refused(unknown, flat).find("'after'"), std::string::npos);
  bare.close = Closing::surface;
  EXPECT_NE(refused(bare, flat).find("needs a base_scan"), std::string::npos);
  EXPECT_NE(test::refusal(between(1, flat, line)).find("scan 'base' spans no surface"), std::string::npos);
  EXPECT_NE(test::refusal(between(1, flat, moved(flat, {0, 0, 1}))).find("encloses"), std::string::npos);
  EXPECT_NE(test::refusal(between(1, flat, nan)).find("point 3 of scan 'base'"), std::string::npos);
  Scene rigid = between(1, flat, moved(flat, {0, 0, -1}));
  rigid.scenario.bodies[0].formulation = Formulation::rigid;
  rigid.scenario.bodies[0].rigid.emplace();
  EXPECT_NE(test::refusal(rigid).find("close of rigid body 'slide'"), std::string::npos);
}

/// Rigid ground is the closed surface that the points were cut from.
TEST(TerrainSolid, OfARigidBodyHasAClosedBoundary) {
  for (const ScanVolume& volume : {above_plane(-2), sunk_by(1.5)}) {
    Scene scene = terrain(0.5, grid_scan(12, 0, 8, dune), volume);
    scene.scenario.bodies[0].formulation = Formulation::rigid;
    scene.scenario.bodies[0].rigid.emplace();
    const Model model = scene.build();
    const TriangleMesh& mesh = model.bodies[0].boundary;
    double volume_inside = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles) {
      volume_inside += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
      for (std::size_t e = 0; e < 3; ++e) ++edges[{t[e], t[(e + 1) % 3]}];
    }
    EXPECT_NEAR(volume_inside, model.volumes[0].input_volume, 1e-9 * volume_inside);
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1);
      ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
    EXPECT_TRUE(model.bodies[0].held.empty());
  }
  Scene low = terrain(0.5, grid_scan(12, 0, 8, dune), above_plane(5));
  low.scenario.bodies[0].formulation = Formulation::rigid;
  EXPECT_NE(test::refusal(low).find("above its base"), std::string::npos);
  Scene cut = terrain(0.5, grid_scan(12, 0, 8, dune), sunk_by(1));
  std::get<ScanVolume>(cut.scenario.bodies[0].volume).outline = {{1, 1}, {5, 1}, {5, 5}};
  cut.scenario.bodies[0].formulation = Formulation::rigid;
  EXPECT_NE(test::refusal(cut).find("outline"), std::string::npos);
}

}  // namespace
}  // namespace scarp

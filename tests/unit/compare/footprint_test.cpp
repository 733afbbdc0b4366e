// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/footprint.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "solver/model/error.hpp"
#include "tools/compare/raster_grid.hpp"
#include "tools/compare/runout.hpp"
#include "tools/compare/sections.hpp"

namespace scarp {
namespace {

constexpr double kPi = std::numbers::pi;

Heightfield raster(const RasterGrid& grid, const std::function<double(double, double)>& z) {
  Heightfield field = empty_raster(grid, {});
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) field.at(c, r) = z(grid.x(c), grid.y(r));
  return field;
}

Heightfield disk(const RasterGrid& grid, double x0, double radius) {
  return raster(grid, [=](double x, double y) { return std::hypot(x - x0, y) < radius ? 2.0 : 0.0; });
}

TEST(Footprint, TwoDisksAndTheirLens) {
  const RasterGrid grid{600, 400, 0.1, -29.95, -19.95};
  const double r = 10, d = 8;
  const FootprintReport report = compare_footprints(disk(grid, -d / 2, r), 1, disk(grid, d / 2, r), 1).report;
  const double lens = 2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d);
  const double whole = kPi * r * r;
  // A boundary of 63 m on cells of 0.1 m: the area is off by far less than one cell along it.
  EXPECT_NEAR(report.area_of(report.both), lens, 1);
  EXPECT_NEAR(report.area_of(report.simulated_only), whole - lens, 1);
  EXPECT_NEAR(report.area_of(report.observed_only), whole - lens, 1);
  EXPECT_EQ(report.both + report.simulated_only + report.observed_only + report.neither, grid.cells());
  EXPECT_NEAR(report.iou, lens / (2 * whole - lens), 0.005);
  EXPECT_NEAR(report.f1, lens / whole, 0.005);
  EXPECT_NEAR(report.precision, report.recall, 1e-3);
}

TEST(Footprint, SimulatedOnlyIsAFalsePositive) {
  const RasterGrid grid{4, 1, 1, 0, 0};
  Heightfield simulated = raster(grid, [](double x, double) { return x; });  // 0 1 2 3
  Heightfield observed = raster(grid, [](double, double) { return 5; });
  observed.at(3, 0) = NAN;
  const FootprintResult result = compare_footprints(simulated, 1, observed, 5);
  EXPECT_EQ(result.report.observed_only, 0u) << "at the threshold is not above it";
  EXPECT_EQ(result.report.simulated_only, 2u);
  EXPECT_EQ(result.cells[3], Overlap::simulated_only);
  EXPECT_TRUE(std::isnan(result.report.recall)) << "nothing was observed";
  EXPECT_EQ(result.report.precision, 0);
  EXPECT_THROW(compare_footprints(simulated, 1, raster({4, 1, 1, 0.5, 0}, [](double, double) { return 0; }), 1), Error);
}

TEST(PlanPath, ProjectsToTheNearestPiece) {
  const PlanPath path({{0, 0}, {10, 0}, {10, 0}, {10, 5}});
  EXPECT_EQ(path.length(), 15);
  EXPECT_EQ(path.at(12), (Vec2{10, 2}));
  EXPECT_EQ(path.at(99), (Vec2{10, 5}));
  const auto left = path.project(4, 1);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->s, 4);
  EXPECT_EQ(left->offset, 1);
  EXPECT_EQ(path.project(12, 2)->offset, -2);
  EXPECT_FALSE(path.project(-1, 0)) << "before the path";
  EXPECT_FALSE(path.project(10, 6)) << "beyond it";
  EXPECT_THROW(PlanPath({{1, 1}, {1, 1}}), Error);
}

TEST(PlanPath, SteepestLineOfAnInclineIsStraight) {
  const Heightfield incline = raster({50, 50, 2, 0, 0}, [](double x, double y) { return 100 - 0.3 * x - 0.4 * y; });
  const PlanPath path = steepest_line(incline, {10, 10});
  for (const Vec2& p : path.corners()) EXPECT_NEAR((p[0] - 10) * 0.4, (p[1] - 10) * 0.3, 1e-9);
  EXPECT_GT(path.at(path.length())[1], 95);
  const Heightfield bowl = raster({50, 50, 2, -49, -49}, [](double x, double y) { return x * x + y * y; });
  EXPECT_LT(norm({steepest_line(bowl, {30, -20}).at(1e9)[0], steepest_line(bowl, {30, -20}).at(1e9)[1], 0}), 2);
  EXPECT_THROW(steepest_line(incline, {-10, 0}), Error);
}

TEST(Runout, OfASlabOnAnIncline) {
  const RasterGrid grid{100, 40, 1, 0.5, 0.5};
  const Heightfield terrain = raster(grid, [](double x, double) { return 60 - 0.5 * x; });
  const Heightfield flow = raster(
      grid, [](double x, double y) { return x > 10 && x < 50 && y > 10 && y < 30 ? 2 + (x < 30 ? 1.0 : 0.0) : 0.05; });
  const RunoutReport report = runout_along(flow, &terrain, PlanPath({{0, 20}, {100, 20}}), 0.1, 0);
  EXPECT_EQ(report.cells, 800u);
  EXPECT_EQ(report.s_start, 10.5);
  EXPECT_EQ(report.s_runout, 49.5);
  EXPECT_DOUBLE_EQ(report.delta_h, 0.5 * 39);
  EXPECT_NEAR(report.runout_angle, std::atan(0.5) * 180 / kPi, 1e-9);
  EXPECT_EQ(report.width_max, 20);
  EXPECT_EQ(report.width_mean, 20);
  EXPECT_EQ(report.volume, 400 * 3 + 400 * 2);
  EXPECT_EQ(report.thickness_mean, 2.5);
  EXPECT_EQ(report.thickness_max, 3);
  // A bent path is longer than the straight line.
  const RunoutReport bent = runout_along(flow, &terrain, PlanPath({{0, 5}, {30, 20}, {60, 5}}), 0.1, 0);
  EXPECT_GT(bent.delta_sxy, 1.05 * std::abs(bent.front[0] - bent.start[0]));
  EXPECT_GE(bent.travel_angle, bent.runout_angle);
  const RunoutReport narrow = runout_along(flow, nullptr, PlanPath({{0, 20}, {100, 20}}), 0.1, 10);
  EXPECT_EQ(narrow.width_max, 10);
  EXPECT_EQ(narrow.cells + narrow.cells_beside, 800u);
  EXPECT_TRUE(std::isnan(narrow.travel_angle));
  EXPECT_THROW(runout_along(flow, &terrain, PlanPath({{0, 20}, {100, 20}}), 5, 0), Error);
}

TEST(Section, OfTwoPlanesIsStraight) {
  const RasterGrid grid{50, 50, 2, 0, 0};
  Heightfield low = raster(grid, [](double x, double y) { return 1 + 0.2 * x - 0.1 * y; });
  Heightfield high = raster(grid, [](double x, double y) { return 4 + 0.2 * x - 0.1 * y; });
  low.site.origin = high.site.origin = {500000, 5400000, 100};
  const Section section = cut_section(low, high, PlanPath({{10, 10}, {40, 50}}), 0.3);
  ASSERT_EQ(section.s.back(), 50);
  ASSERT_EQ(section.s.size(), 168u);
  for (std::size_t i = 0; i < section.s.size(); ++i) {
    EXPECT_NEAR(section.simulated[i], 1 + 0.2 * (10 + 0.6 * section.s[i]) - 0.1 * (10 + 0.8 * section.s[i]), 1e-9);
    EXPECT_NEAR(section.observed[i] - section.simulated[i], 3, 1e-9);
  }
  const std::string csv = section_csv(cut_section(low, high, PlanPath({{10, 10}, {10, 200}}), 100));
  EXPECT_EQ(csv,
            "s,x,y,simulated,observed,difference\n"
            "0,500010,5400010,102,105,3\n"
            "100,500010,5400110,nan,nan,nan\n"
            "190,500010,5400200,nan,nan,nan\n");
  EXPECT_THROW(cut_section(low, high, PlanPath({{10, 10}, {40, 50}}), 0), Error);
}

}  // namespace
}  // namespace scarp

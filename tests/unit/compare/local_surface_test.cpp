// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Local models of the observed surface, and distances of sets.
#include "tools/compare/local_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/compare/c2c.hpp"

namespace scarp {
namespace {

double bowl(double x, double y) { return 0.3 * x - 0.2 * y + 0.05 * x * x + 0.02 * x * y - 0.04 * y * y; }

PointCloud surface(double spacing, int n, double (*height)(double, double)) {
  PointCloud cloud;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j) {
      const double x = spacing * (i + 0.2 * std::sin(3.0 * j)), y = spacing * (j + 0.2 * std::cos(5.0 * i));
      cloud.positions.push_back({x, y, height(x, y)});
    }
  return cloud;
}

TEST(LocalSurface, APlaneIsExact) {
  const PointCloud cloud = surface(0.5, 2, [](double x, double y) { return 3 + 0.75 * x - 0.5 * y; });
  const auto plane = LocalSurface::fit(cloud.positions, false);
  ASSERT_TRUE(plane.has_value());
  const double slope = std::sqrt(1 + 0.75 * 0.75 + 0.5 * 0.5);
  EXPECT_NEAR(plane->normal()[2], 1 / slope, 1e-14);
  EXPECT_NEAR(plane->distance({7, -3, 3 + 0.75 * 7 + 0.5 * 3 + 2}), 2 / slope, 1e-13);
  const auto quadric = LocalSurface::fit(cloud.positions, true);
  EXPECT_NEAR(quadric->distance({0.7, -0.3, 3 + 0.75 * 0.7 + 0.5 * 0.3 - 2}), -2 / slope, 1e-12);
}

TEST(LocalSurface, AQuadricFollowsCurvature) {
  const PointCloud cloud = surface(0.2, 2, bowl);
  const auto plane = LocalSurface::fit(cloud.positions, false), quadric = LocalSurface::fit(cloud.positions, true);
  double plane_error = 0, quadric_error = 0;
  for (const auto& [x, y] : {std::pair(0.05, 0.1), {-0.3, 0.2}, {0.25, -0.35}}) {
    plane_error = std::max(plane_error, std::abs(plane->distance({x, y, bowl(x, y)})));
    quadric_error = std::max(quadric_error, std::abs(quadric->distance({x, y, bowl(x, y)})));
  }
  EXPECT_GT(plane_error, 1e-3);
  EXPECT_LT(quadric_error, 2e-4) << "exact but for the tilt of its frame";
}

TEST(LocalSurface, NeedsPointsThatSpanIt) {
  const std::vector<Vec3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}, {5, 5, 5}, {6, 6, 6}};
  EXPECT_FALSE(LocalSurface::fit(line, false).has_value());
  EXPECT_FALSE(LocalSurface::fit({{0, 0, 0}, {1, 0, 0}}, false).has_value());
  EXPECT_TRUE(LocalSurface::fit({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, false).has_value());
  EXPECT_FALSE(LocalSurface::fit({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}}, true).has_value());
  std::vector<Vec3> circle;
  for (int k = 0; k < 12; ++k) circle.push_back({std::cos(0.5 * k), std::sin(0.5 * k), 0});
  EXPECT_FALSE(LocalSurface::fit(circle, true).has_value()) << "a conic holds them all";
}

CompareOptions with(LocalModel model) {
  CompareOptions options;
  options.name = "n";
  options.max_distance = 5;
  options.c2c.local_model = model;
  return options;
}

TEST(C2cLocalModel, SeesThroughTheGapsBetweenPoints) {
  const PointCloud observed = surface(0.5, 15, [](double x, double y) { return 0.2 * x + 0.1 * y; });
  PointCloud simulated;
  for (int k = 0; k < 100; ++k) {
    const double x = 0.05 * k - 2.5, y = 0.03 * k - 1;
    simulated.positions.push_back({x, y, 0.2 * x + 0.1 * y - 0.1});
  }
  const double expected = 0.1 / std::sqrt(1 + 0.04 + 0.01);
  const Comparison nearest = compare_c2c(simulated, observed, with(LocalModel::nearest), 1);
  EXPECT_GT(nearest.report.distances->mean, 1.5 * expected) << "half of it is the spacing of the scan";
  for (LocalModel model : {LocalModel::plane, LocalModel::quadric}) {
    const Comparison result = compare_c2c(simulated, observed, with(model), 2);
    ASSERT_EQ(result.cloud.scalars[4].name, "signed_distance");
    for (std::size_t i = 0; i < simulated.size(); ++i) {
      EXPECT_NEAR(result.cloud.scalars[0].values[i], expected, 1e-9);
      EXPECT_NEAR(result.cloud.scalars[4].values[i], expected, 1e-9) << "the observed surface lies above";
    }
  }
}

double measure(const MeasureGroup& group, const std::string& name) {
  for (const Measure& m : group.measures)
    if (m.name == name) return std::get<double>(m.value);
  ADD_FAILURE() << name;
  return 0;
}

TEST(SetDistances, AreWhatTheirFormulasSay) {
  PointCloud simulated, observed;
  simulated.positions = {{0, 0, 0}, {10, 0, 0}};
  observed.positions = {{0, 0, 1}, {10, 0, 2}, {10, 0, 7}, {0, 0, -3}};
  CompareOptions options = with(LocalModel::nearest);
  options.max_distance = 0.5;  // sets know no limit
  const MeasureGroup sets = compare_c2c(simulated, observed, options, 1).report.groups[0];
  EXPECT_EQ(sets.name, "sets");
  EXPECT_EQ(measure(sets, "hausdorff_to_observed"), 2);
  EXPECT_EQ(measure(sets, "hausdorff_to_simulated"), 7);
  EXPECT_EQ(measure(sets, "hausdorff"), 7);
  EXPECT_DOUBLE_EQ(measure(sets, "hausdorff_95_to_observed"), 1.95);
  EXPECT_DOUBLE_EQ(measure(sets, "hausdorff_95_to_simulated"), 3 + 4 * 0.85);
  EXPECT_DOUBLE_EQ(measure(sets, "chamfer"), 1.5 + 13 / 4.0);
  EXPECT_DOUBLE_EQ(measure(sets, "chamfer_squared"), 2.5 + 63 / 4.0);
}

}  // namespace
}  // namespace scarp

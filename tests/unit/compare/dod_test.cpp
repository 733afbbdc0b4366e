// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/dod.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

Heightfield raster(const RasterGrid& grid, const std::function<double(double, double)>& z) {
  Heightfield field = empty_raster(grid, {});
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) field.at(c, r) = z(grid.x(c), grid.y(r));
  return field;
}

DodResult compare(const Heightfield& simulated, const Heightfield& observed, const DodOptions& options = {},
                  const Heightfield* mask = nullptr, double registration_error = 0) {
  const std::vector<double> no_sigma;
  return dem_of_difference({simulated, observed, no_sigma, mask, registration_error}, options);
}

double hill(double x, double y) { return 0.1 * x + 3 * std::sin(0.05 * y); }

TEST(Dod, VolumeOfAParaboloid) {
  // On squares of side c a smooth function vanishing at its rim is summed to O(c^2) of its edge slope.
  const RasterGrid grid{400, 400, 0.25, -50 + 0.125, -50 + 0.125};
  const double R = 40, H = 3;
  const auto bump = [&](double x, double y) { return H * std::max(0.0, 1 - (x * x + y * y) / (R * R)); };
  const DodReport report =
      compare(raster(grid, hill), raster(grid, [&](double x, double y) { return hill(x, y) + bump(x, y); })).report;
  const double exact = std::numbers::pi * R * R * H / 2;
  EXPECT_NEAR(report.all.net.volume, exact, 1e-4 * exact);
  EXPECT_NEAR(report.all.added.volume, exact, 1e-4 * exact);
  EXPECT_NEAR(report.all.added.area, std::numbers::pi * R * R, 0.01 * std::numbers::pi * R * R);
  EXPECT_LT(std::abs(report.all.removed.volume), 1e-6) << "only the rounding of hill + 0 - hill";
  EXPECT_EQ(report.cells_compared, 160000u);
  EXPECT_EQ(report.sigma_simulated_from, "none");
}

TEST(Dod, VolumeOfTwoWedges) {
  // d = x / 10: cell centres integrate what is linear exactly.
  const RasterGrid grid{80, 30, 0.5, -20 + 0.25, 0.25};
  const DodReport report = compare(raster(grid, [](double, double) { return 7.0; }),
                                   raster(grid, [](double x, double) { return 7.0 + 0.1 * x; }))
                               .report;
  EXPECT_NEAR(report.all.added.volume, 0.5 * 20 * 2 * 15, 1e-9);
  EXPECT_NEAR(report.all.removed.volume, -0.5 * 20 * 2 * 15, 1e-9);
  EXPECT_NEAR(report.all.net.volume, 0, 1e-9);
  EXPECT_NEAR(report.statistics.largest, 1.975, 1e-12);
}

TEST(Dod, LevelOfDetectionAndItsVolumes) {
  const RasterGrid grid{80, 30, 0.5, -20 + 0.25, 0.25};
  DodOptions options;
  options.uncertainty_simulated = 0.3;
  options.uncertainty_observed = 0.4;
  const DodResult result = compare(raster(grid, [](double, double) { return 7.0; }),
                                   raster(grid, [](double x, double) { return 7.0 + 0.1 * x; }), options, nullptr, 0.1);
  const double limit = 1.959963984540054 * (0.5 + 0.1);
  EXPECT_NEAR(result.report.level_of_detection, limit, 1e-12);
  EXPECT_NEAR(result.level_of_detection.at(3, 4), limit, 1e-12);
  double added = 0;
  std::size_t cells = 0;
  for (int c = 0; c < 80; ++c)
    if (0.1 * grid.x(c) > limit) {
      added += 30 * 0.25 * 0.1 * grid.x(c);
      cells += 30;
    }
  const DodVolume& volume = result.report.significant.added;
  EXPECT_EQ(volume.cells, cells);
  EXPECT_NEAR(volume.volume, added, 1e-9);
  const double n = static_cast<double>(cells);
  EXPECT_NEAR(volume.sigma.independent, 0.25 * std::sqrt(n) * 0.5, 1e-9);
  EXPECT_NEAR(volume.sigma.fully_correlated, 0.25 * n * 0.5, 1e-9);
  EXPECT_NEAR(volume.sigma.systematic, 0.25 * n * 0.1, 1e-9);
  EXPECT_FALSE(volume.sigma.correlated.has_value()) << "no range is known";
}

TEST(Dod, NoDataIsCountedAndNeverCompared) {
  const RasterGrid grid{4, 3, 1, 0, 0};
  Heightfield a = raster(grid, [](double x, double) { return x; }), b = a;
  a.at(0, 0) = b.at(1, 0) = b.at(2, 0) = NAN;
  const DodResult result = compare(a, b);
  EXPECT_EQ(result.report.cells_compared, 9u);
  EXPECT_EQ(result.report.only_observed, 1u);
  EXPECT_EQ(result.report.only_simulated, 2u);
  EXPECT_TRUE(std::isnan(result.difference.at(0, 0)));
  EXPECT_EQ(result.report.all.net.cells, 9u);
  b = raster(grid, [](double, double) { return NAN; });
  EXPECT_THROW(compare(a, b), Error);
}

/// Ground with noise, a datum bias of 0.09 m, and a third that moved by metres.
Heightfield surveyed(const RasterGrid& grid, double sigma) {
  std::mt19937 chance(7);
  std::normal_distribution<double> noise(0, sigma);
  return raster(grid, [&](double x, double y) {
    const double moved = x > 65 ? 0.4 + 0.05 * (x - 65) : 0;
    return hill(x, y) + 0.09 - moved + noise(chance);
  });
}

TEST(Dod, SaysHowFullOfHolesADifferenceIs) {
  Heightfield a{3, 3, 1, 0, 0, std::vector<double>(9, 1.0), {}}, b = a;
  const auto neighbours = [&] { return dem_of_difference({a, b, {}}, {}).report.average_neighbours; };
  EXPECT_DOUBLE_EQ(neighbours(), (8 + 4 * 5 + 4 * 3) / 9.0);
  b.z[4] = NAN;  // the middle
  EXPECT_DOUBLE_EQ(neighbours(), (4 * 4 + 4 * 2) / 8.0);
  b.z = {NAN, NAN, NAN, NAN, 1, NAN, NAN, NAN, NAN};
  EXPECT_EQ(neighbours(), 0);
}

TEST(Dod, AutomaticStableGroundFindsTheDatumBias) {
  const RasterGrid grid{100, 100, 1, 0, 0};
  DodOptions options;
  options.stable.ground = StableGround::automatic;
  const DodReport found = compare(raster(grid, hill), surveyed(grid, 0.05), options).report;
  ASSERT_TRUE(found.stable.has_value());
  EXPECT_NEAR(found.stable->bias, 0.09, 0.003) << "six thousand values with 0.05 m";
  EXPECT_NEAR(found.stable->nmad, 0.05, 0.003);
  EXPECT_NEAR(static_cast<double>(found.stable->cells), 6600, 60);
  EXPECT_FALSE(found.bias_removed);
  EXPECT_NEAR(found.sigma_observed, 0.05, 0.003);
  options.stable.remove_bias = true;
  const DodReport without = compare(raster(grid, hill), surveyed(grid, 0.05), options).report;
  EXPECT_NEAR(without.all.net.volume, found.all.net.volume - 1e4 * found.stable->bias, 1e-6);
  EXPECT_NEAR(without.shared_sigma, std::sqrt(std::numbers::pi / 2 / double(found.stable->cells)) * found.stable->nmad,
              1e-12);
}

TEST(Dod, PolygonMaskAndSlopeLimitChooseStableGround) {
  const RasterGrid grid{100, 100, 1, 0, 0};
  DodOptions options;
  options.stable.ground = StableGround::polygon;
  options.stable.polygon = {{9.5, 9.5}, {39.5, 9.5}, {39.5, 29.5}, {9.5, 29.5}};
  const DodReport polygon = compare(raster(grid, hill), surveyed(grid, 0.05), options).report;
  EXPECT_EQ(polygon.stable->cells, 600u);
  EXPECT_NEAR(polygon.stable->bias, 0.09, 0.01);
  options.stable.ground = StableGround::mask;
  const Heightfield mask = raster(grid, [](double x, double y) { return x < 20 ? 1 : y < 50 ? 0 : NAN; });
  EXPECT_EQ(compare(raster(grid, hill), surveyed(grid, 0.05), options, &mask).report.stable->cells, 2000u);
  options.stable.steepest = 0.5;
  EXPECT_THROW(compare(raster(grid, hill), surveyed(grid, 0.05), options, &mask), Error) << "all is steeper";
}

TEST(Dod, SlopeOfAnInclineIsItsAngle) {
  const Heightfield plane = raster({5, 4, 2, 0, 0}, [](double x, double y) { return 0.3 * x - 0.4 * y; });
  for (double s : slopes(plane)) EXPECT_NEAR(s, std::atan(0.5) * 180 / std::numbers::pi, 1e-12);
}

TEST(VolumeUncertainty, NormalFactors) {
  EXPECT_NEAR(two_sided_factor(0.95), 1.959963984540054, 1e-12);
  EXPECT_NEAR(two_sided_factor(0.99), 2.5758293035489004, 1e-12);
  EXPECT_NEAR(two_sided_factor(0.6826894921370859), 1, 1e-12);
}

/// Sums of simulated fields with the spherical covariance: the standard deviation that a survey would have if it were
/// repeated.
double monte_carlo(const RasterGrid& grid, const std::vector<double>& weights, double range, int draws) {
  const std::size_t n = grid.cells();
  std::vector<double> L(n * n, 0.0);
  const auto covariance = [&](std::size_t i, std::size_t j) {
    const int c = grid.columns;
    const double dx = double(i % c) - double(j % c), dy = double(i / c) - double(j / c);
    return spherical_correlation(grid.cell * std::hypot(dx, dy), range);
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double s = covariance(i, j);
      for (std::size_t k = 0; k < j; ++k) s -= L[i * n + k] * L[j * n + k];
      L[i * n + j] = i == j ? std::sqrt(s) : s / L[j * n + j];
    }
  std::mt19937 chance(11);
  std::normal_distribution<double> normal;
  double squares = 0;
  std::vector<double> white(n);
  for (int d = 0; d < draws; ++d) {
    for (double& v : white) v = normal(chance);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double field = 0;
      for (std::size_t k = 0; k <= i; ++k) field += L[i * n + k] * white[k];
      sum += weights[i] * field;
    }
    squares += sum * sum;
  }
  return std::sqrt(squares / draws);
}

TEST(VolumeUncertainty, CorrelatedErrorsAgainstRepeatedSurveys) {
  const RasterGrid grid{12, 10, 2, 0, 0};
  std::vector<double> weights(grid.cells());
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = i % 7 == 0 ? 0 : 0.1 + 0.05 * double(i % 5);
  for (double range : {3.0, 9.0, 40.0}) {
    // 10,000 draws give a standard deviation to 0.7 %; three of these.
    const double repeated = monte_carlo(grid, weights, range, 10000);
    EXPECT_NEAR(std::sqrt(correlated_variance(grid, weights, range)), repeated, 0.021 * repeated) << range;
  }
}

TEST(VolumeUncertainty, LimitsOfTheCorrelationRange) {
  const RasterGrid grid{60, 50, 1, 0, 0};
  const std::vector<double> sigma(grid.cells(), 0.2);
  const std::vector<std::uint8_t> all(grid.cells(), 1);
  const VolumeSigma shortest = volume_sigma(grid, sigma, all, 0.9, 0);
  EXPECT_NEAR(*shortest.correlated, shortest.independent, 1e-9) << "no neighbour within the range";
  const VolumeSigma longest = volume_sigma(grid, sigma, all, 1e6, 0);
  EXPECT_NEAR(*longest.correlated, longest.fully_correlated, 1e-3 * longest.fully_correlated);
}

TEST(VolumeUncertainty, BlocksOfCellsChangeLittle) {
  // Range 40 cells is summed over blocks; against the plain sum over all pairs.
  const RasterGrid grid{70, 60, 1, 0, 0};
  std::vector<double> weights(grid.cells());
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 1 + 0.5 * std::sin(0.01 * double(i));
  double pairs = 0;
  for (int dr = -59; dr < 60; ++dr)
    for (int dc = -69; dc < 70; ++dc) {
      const double rho = spherical_correlation(std::hypot(dc, dr), 40);
      if (rho <= 0) continue;
      for (int r = std::max(0, -dr); r < std::min(60, 60 - dr); ++r)
        for (int c = std::max(0, -dc); c < std::min(70, 70 - dc); ++c)
          pairs += rho * weights[r * 70 + c] * weights[(r + dr) * 70 + c + dc];
    }
  EXPECT_NEAR(correlated_variance(grid, weights, 40), pairs, 0.005 * pairs);
}

}  // namespace
}  // namespace scarp

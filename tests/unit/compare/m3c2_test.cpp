// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/m3c2.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

#include "solver/model/error.hpp"
#include "tests/support/m3c2_oracle.hpp"
#include "tests/unit/compare/m3c2_golden.hpp"

namespace scarp {
namespace {

using test::golden_cloud;
using test::golden_cores;
using test::GoldenRow;
using test::kGolden;

M3c2Settings golden_settings(CompareConvention convention) {
  M3c2Settings s;
  s.rules = rules_of(convention, {});
  s.source = NormalSource::core;
  s.normals.radii = {0.35, 0.7, 1.4};
  s.normals.closed_ball = s.rules.closed_ball;
  s.normals.choice = s.rules.scale;
  s.radius = 0.45;
  s.half_length = 2;
  return s;
}

/// The reference's own normals: the table tests what is made of them, the obvious search how they are found.
std::vector<Vec3> golden_normals() {
  std::vector<Vec3> normals;
  for (const GoldenRow& row : kGolden) normals.push_back(row.normal);
  return normals;
}

M3c2Input golden_input(const Vec3& shift = {0, 0, 0}) {
  M3c2Input input{golden_cloud(0.10, 0), golden_cloud(0.11, 0.25), golden_cores(), golden_normals()};
  for (auto* points : {&input.simulated, &input.observed, &input.cores})
    for (Vec3& p : *points) p = p + shift;
  return input;
}

void expect_golden(const M3c2Input& input, M3c2Settings settings, double tolerance) {
  const auto mean = m3c2(input, settings, 2);
  settings.average = Average::median;
  const auto median = m3c2(input, settings, 2);
  settings.average = Average::mean;
  settings.source = NormalSource::vertical;
  const auto vertical = m3c2(input, settings, 2);
  for (std::size_t i = 0; i < kGolden.size(); ++i) {
    const GoldenRow& g = kGolden[i];
    EXPECT_NEAR(mean[i].distance, g.distance, tolerance) << i;
    EXPECT_NEAR(mean[i].detection, g.lod, tolerance) << i;
    EXPECT_NEAR(mean[i].simulated.spread, g.spread1, tolerance) << i;
    EXPECT_NEAR(mean[i].observed.spread, g.spread2, tolerance) << i;
    EXPECT_EQ(mean[i].simulated.count, g.n1) << i;
    EXPECT_EQ(mean[i].observed.count, g.n2) << i;
    EXPECT_NEAR(median[i].distance, g.median_distance, tolerance) << i;
    EXPECT_NEAR(median[i].detection, g.median_lod, tolerance) << i;
    EXPECT_NEAR(median[i].simulated.spread, g.range1, tolerance) << i;
    EXPECT_NEAR(median[i].observed.spread, g.range2, tolerance) << i;
    EXPECT_EQ(vertical[i].normal.direction, (Vec3{0, 0, 1}));
    EXPECT_NEAR(vertical[i].distance, g.vertical_distance, tolerance) << i;
    EXPECT_NEAR(vertical[i].detection, g.vertical_lod, tolerance) << i;
    EXPECT_EQ(vertical[i].simulated.count, g.vertical_n1) << i;
    EXPECT_EQ(vertical[i].observed.count, g.vertical_n2) << i;
    EXPECT_EQ(mean[i].flags + median[i].flags + vertical[i].flags, 0);
  }
}

TEST(M3c2, AgreesWithPy4dgeoWhereThereAreNoTies) {
  for (auto convention : {CompareConvention::scarp, CompareConvention::py4dgeo})
    expect_golden(golden_input(), golden_settings(convention), 1e-9);
}

TEST(M3c2, NormalsOfTheSameCloudsAreThoseOfTheObviousSearch) {
  M3c2Settings s = golden_settings(CompareConvention::py4dgeo);
  s.source = NormalSource::simulated;
  s.normals.radii = {1.4};
  const M3c2Input input = golden_input();
  const auto rows = m3c2(input, s, 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double planarity = 0;
    const Vec3 n = test::slow_normal(input.simulated, input.cores[i], 1.4, &planarity);
    for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(rows[i].normal.direction[a], n[a], 1e-12) << i;
    EXPECT_EQ(rows[i].normal.radius, 1.4) << i;
    EXPECT_NEAR(dot(n, kGolden[i].normal), 1, 2e-6) << i;
  }
}

TEST(M3c2, AgreesWithPy4dgeoInMapCoordinates) {
  // Coordinates themselves are rounded to 5e-10 m there; averages of dozens are ten times better.
  expect_golden(golden_input({500000, 4100000, 1200}), golden_settings(CompareConvention::py4dgeo), 1e-9);
  expect_golden(golden_input({500000, 4100000, 1200}), golden_settings(CompareConvention::scarp), 1e-9);
}

TEST(M3c2, RegistrationErrorAddsToTheLevelOfDetection) {
  M3c2Settings s = golden_settings(CompareConvention::py4dgeo);
  s.registration_error = 0.02;
  const auto rows = m3c2(golden_input(), s, 1);
  for (std::size_t i = 0; i < kGolden.size(); ++i) EXPECT_NEAR(rows[i].detection, kGolden[i].lod + 0.0392, 1e-9);
}

TEST(M3c2, OtherProgramsDivideTheVarianceByN) {
  M3c2Settings s = golden_settings(CompareConvention::pdal);
  const auto rows = m3c2(golden_input(), s, 1);
  for (std::size_t i = 0; i < kGolden.size(); ++i) {
    const GoldenRow& g = kGolden[i];
    const auto population = [](double spread, double n) { return spread * spread * (n - 1) / n; };
    EXPECT_NEAR(rows[i].simulated.spread, std::sqrt(population(g.spread1, g.n1)), 1e-9);
    EXPECT_NEAR(rows[i].detection,
                1.96 * std::sqrt(population(g.spread1, g.n1) / g.n1 + population(g.spread2, g.n2) / g.n2), 1e-9);
    EXPECT_NEAR(rows[i].distance, g.distance, 1e-9);
  }
}

TEST(M3c2, QuartilesByEitherRule) {
  const std::array<double, 7> by_rank{0.04, 0.05, 0.06, 0.105, 0.16, 0.18, 0.20};  // n = 3 ... 9, of py4dgeo
  for (int n = 3; n <= 9; ++n) {
    std::vector<double> values;
    for (int k = n; k >= 1; --k) values.push_back(0.005 * k * k);
    M3c2Rules rules;
    EXPECT_NEAR(level_of(values, Average::median, rules).spread, by_rank[static_cast<std::size_t>(n - 3)], 1e-15) << n;
    rules.half_medians = true;
    if (n == 3) {
      EXPECT_NEAR(level_of(values, Average::median, rules).spread, 0.02, 1e-15);
    }
    if (n == 7) {
      EXPECT_NEAR(level_of(values, Average::median, rules).spread, 0.12, 1e-15);
    }
  }
}

/// Points on a lattice in the plane z = 0.
std::vector<Vec3> lattice(int n, double spacing) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) points.push_back({spacing * i, spacing * j, 0});
  return points;
}

std::size_t without_distance(CompareConvention convention, double radius, double half_length) {
  M3c2Input input{lattice(41, 0.25), lattice(41, 0.25), lattice(41, 0.25), {}};
  M3c2Settings s;
  s.rules = rules_of(convention, {});
  s.source = NormalSource::vertical;
  s.radius = radius;
  s.half_length = half_length;
  std::size_t count = 0;
  for (const M3c2Row& row : m3c2(input, s, 2)) {
    count += std::isnan(row.distance);
    EXPECT_EQ(std::isnan(row.distance), row.simulated.count == 0);
    EXPECT_EQ(std::isnan(row.distance), (row.flags & kNoSimulated) != 0);
    if (!std::isnan(row.distance)) {
      EXPECT_EQ(row.distance, 0);
    }
  }
  return count;
}

TEST(M3c2, AnEvenNumberOfSegmentsLosesTheCorePlaneInStrictModeOnly) {
  for (const auto& [radius, half_length, lost] : {std::tuple(0.5, 1.0, true),
                                                  {0.5, 2.0, true},
                                                  {0.5, 3.0, true},
                                                  {0.5, 1.5, false},
                                                  {0.3, 1.0, true},
                                                  {0.3, 3.0, true},
                                                  {0.3, 1.5, false},
                                                  {0.3, 2.0, false}}) {
    EXPECT_EQ(without_distance(CompareConvention::py4dgeo, radius, half_length), lost ? 1681u : 0u)
        << radius << " " << half_length;
    EXPECT_EQ(without_distance(CompareConvention::scarp, radius, half_length), 0u) << radius << " " << half_length;
  }
}

TEST(M3c2, BothEndsOfTheCylinderAreInsideOnlyIfClosed) {
  const M3c2Input input{{{0, 0, 0}, {0, 0, 3}}, {{0, 0, -3}, {0, 0, 0.5}, {0.5, 0, 0.5}}, {{0, 0, 0}}, {}};
  M3c2Settings s;
  s.source = NormalSource::vertical;
  s.radius = 0.5;
  s.half_length = 3;
  s.rules = rules_of(CompareConvention::scarp, {});
  const M3c2Row closed = m3c2(input, s, 1)[0];
  EXPECT_EQ(closed.simulated.count, 2u);
  EXPECT_EQ(closed.observed.count, 3u);
  s.half_length = 1.5;  // three segments; z = 0.5 is between two of them
  s.rules = rules_of(CompareConvention::py4dgeo, {});
  const M3c2Row open = m3c2(input, s, 1)[0];
  EXPECT_EQ(open.simulated.count, 1u);
  EXPECT_EQ(open.observed.count, 0u);
  EXPECT_TRUE(std::isnan(open.distance));
  s.half_length = 0.1;  // py4dgeo makes it at least the radius
  EXPECT_EQ(m3c2(input, s, 1)[0].observed.count, 0u) << "0.5 is the open end";
  s.radius = 0.6;
  EXPECT_EQ(m3c2(input, s, 1)[0].observed.count, 2u);
}

TEST(M3c2, NeighboursThatSpanNoPlaneGiveNaNAndAFlag) {
  const std::vector<std::vector<Vec3>> degenerate{
      {{50, 0, 0}},                                                                        // none near
      {{0, 0, 0}},                                                                         // one
      {{0, 0, 0}, {0.1, 0, 0}},                                                            // two
      {{0, 0, 0}, {0.1, 0.2, 0.3}, {-0.1, -0.2, -0.3}},                                    // on a line
      {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},                                        // all the same
      {{0.1, 0, 0}, {-0.1, 0, 0}, {0, 0.1, 0}, {0, -0.1, 0}, {0, 0, 0.1}, {0, 0, -0.1}}};  // a ball
  for (auto convention :
       {CompareConvention::scarp, CompareConvention::py4dgeo, CompareConvention::cloudcompare, CompareConvention::pdal})
    for (std::size_t c = 0; c < degenerate.size(); ++c)
      for (const Vec3& shift : {Vec3{0, 0, 0}, Vec3{500000, 4100000, 1200}}) {
        M3c2Input input{degenerate[c], degenerate[c], {{0, 0, 0}}, {}};
        for (auto* points : {&input.simulated, &input.observed, &input.cores})
          for (Vec3& p : *points) p = p + shift;
        M3c2Settings s = golden_settings(convention);
        s.source = NormalSource::simulated;
        if (c == 5 && shift[0] > 0) continue;  // rounding makes a plane of it
        const M3c2Row row = m3c2(input, s, 1)[0];
        EXPECT_TRUE(std::isnan(row.normal.direction[0]) && std::isnan(row.normal.radius)) << c;
        EXPECT_TRUE(std::isnan(row.distance) && std::isnan(row.detection)) << c;
        EXPECT_EQ(row.simulated.count + row.observed.count, 0u) << c;
        EXPECT_TRUE(std::isnan(row.simulated.position) && std::isnan(row.observed.spread)) << c;
        EXPECT_EQ(row.flags, 15) << c;
      }
}

TEST(M3c2, ThreePointsAreEnoughForANormal) {
  const std::vector<Vec3> three{{0, 0, 0}, {0.2, 0, 0}, {0, 0.1, 0}};
  M3c2Settings s = golden_settings(CompareConvention::scarp);
  s.source = NormalSource::simulated;
  const M3c2Row row = m3c2({three, three, {{0, 0, 0}}, {}}, s, 1)[0];
  EXPECT_EQ(row.normal.direction, (Vec3{0, 0, 1}));
  EXPECT_EQ(row.distance, 0);
  EXPECT_TRUE(std::isnan(row.detection)) << "three points have no level of detection by this convention";
  EXPECT_EQ(row.flags, kNoDetection);
}

TEST(M3c2, OneOrNoPointHasNoSpread) {
  const M3c2Input input{{{0, 0, 0}}, {{0, 0, 0.25}}, {{0, 0, 0}, {50, 0, 0}}, {}};
  for (auto convention : {CompareConvention::scarp, CompareConvention::py4dgeo, CompareConvention::pdal}) {
    M3c2Settings s = golden_settings(convention);
    s.source = NormalSource::vertical;
    s.registration_error = 0.5;
    const auto rows = m3c2(input, s, 1);
    EXPECT_EQ(rows[0].distance, 0.25);
    if (convention == CompareConvention::pdal)
      EXPECT_DOUBLE_EQ(rows[0].detection, 0.98);
    else
      EXPECT_TRUE(std::isnan(rows[0].detection));
    EXPECT_TRUE(std::isnan(rows[1].distance));
    EXPECT_TRUE(std::isnan(rows[1].detection));
    EXPECT_EQ(rows[1].flags, kNoSimulated | kNoObserved | kNoDetection);
  }
  M3c2Settings s = golden_settings(CompareConvention::py4dgeo);
  s.source = NormalSource::vertical;
  s.registration_error = 0.5;
  s.average = Average::median;
  const auto rows = m3c2(input, s, 1);
  EXPECT_EQ(rows[0].simulated.spread, 0) << "the interquartile range of one";
  EXPECT_DOUBLE_EQ(rows[0].detection, 0.98);
  EXPECT_TRUE(std::isnan(rows[1].detection));
}

TEST(M3c2, NormalsTakeTheSideAskedFor) {
  M3c2Settings s = golden_settings(CompareConvention::scarp);
  s.source = NormalSource::simulated;
  const M3c2Input input = golden_input();
  s.normals.viewpoint = {-100, 0, 0};
  const std::vector<std::pair<NormalSide, double>> signs{{NormalSide::up, 1},      {NormalSide::down, -1},
                                                         {NormalSide::east, -1},   {NormalSide::west, 1},
                                                         {NormalSide::towards, 1}, {NormalSide::away, -1}};
  for (const auto& [side, sign] : signs) {
    s.normals.side = side;
    const M3c2Row row = m3c2(input, s, 1)[0];
    EXPECT_NEAR(row.normal.direction[2], sign * kGolden[0].normal[2], 1e-3) << name_of(side);
    EXPECT_NEAR(row.distance, sign * kGolden[0].distance, 1e-4) << name_of(side);
  }
  s.normals.side = NormalSide::south;
  EXPECT_LT(m3c2(input, s, 1)[0].normal.direction[1], 0);
  s.normals.side = NormalSide::north;
  EXPECT_GT(m3c2(input, s, 1)[0].normal.direction[1], 0);
  s.normals.side = NormalSide::none;
  EXPECT_NEAR(std::abs(m3c2(input, s, 1)[0].normal.direction[2]), kGolden[0].normal[2], 1e-3);
}

TEST(M3c2, ASimulationResolvesNothingFinerThanItsSpacing) {
  const double spacing = 0.25;
  M3c2Input input{lattice(41, spacing), golden_cloud(0.10, 0), lattice(41, spacing), {}};
  M3c2Settings s = golden_settings(CompareConvention::scarp);
  s.source = NormalSource::vertical;
  const auto as_scan = m3c2(input, s, 1);
  s.simulated_floor = spacing / std::sqrt(12.0);
  const auto as_simulation = m3c2(input, s, 1);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < as_scan.size(); ++i) {
    if (std::isnan(as_scan[i].detection)) continue;
    EXPECT_EQ(as_scan[i].simulated.spread, 0) << "a lattice looks perfectly smooth";
    const double observed = as_scan[i].detection / 1.96;
    EXPECT_NEAR(as_simulation[i].detection, 1.96 * std::hypot(observed, spacing / std::sqrt(12.0)), 1e-12);
    ++seen;
  }
  EXPECT_GT(seen, 1000u);
}

std::vector<Vec3> rough(std::size_t count, double lift, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    p = {10 * unit(generator), 10 * unit(generator), lift + 0.1 * unit(generator)};
    p[2] += std::sin(0.8 * p[0]) + 0.5 * p[1];
  }
  return points;
}

TEST(M3c2, AgreesWithTheObviousSearch) {
  const M3c2Input input{rough(3000, 0, 1), rough(2500, 0.3, 2), rough(60, 0.1, 3), {}};
  for (const auto& [radius, half_length] : {std::pair(0.6, 2.0), {0.5, 0.2}, {2.0, 15.0}})
    for (auto convention : {CompareConvention::scarp, CompareConvention::py4dgeo}) {
      M3c2Settings s = golden_settings(convention);
      s.source = NormalSource::simulated;
      s.normals.radii = {1.1};
      s.radius = radius;
      s.half_length = half_length;
      const auto rows = m3c2(input, s, 2);
      std::size_t found = 0;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        double planarity = 0;
        const Vec3 n = test::slow_normal(input.simulated, input.cores[i], 1.1, &planarity);
        for (std::size_t a = 0; a < 3; ++a) ASSERT_NEAR(rows[i].normal.direction[a], n[a], 1e-12);
        const auto search = convention == CompareConvention::scarp ? test::slow_cylinder : test::slow_segments;
        const Vec3& exactly = rows[i].normal.direction;
        const auto first = search(input.simulated, input.cores[i], exactly, radius, half_length);
        const auto second = search(input.observed, input.cores[i], exactly, radius, half_length);
        ASSERT_EQ(rows[i].simulated.count, first.size());
        ASSERT_EQ(rows[i].observed.count, second.size());
        if (first.empty() || second.empty()) continue;
        double mean = 0;
        for (double t : second) mean += t / static_cast<double>(second.size());
        for (double t : first) mean -= t / static_cast<double>(first.size());
        EXPECT_NEAR(rows[i].distance, mean, 1e-12);
        ++found;
      }
      EXPECT_GT(found, 20u);
    }
}

TEST(M3c2, OfSeveralScalesTheFlattestWins) {
  const M3c2Input input{rough(3000, 0, 1), rough(2500, 0.3, 2), rough(60, 0.1, 3), {}};
  M3c2Settings s = golden_settings(CompareConvention::scarp);
  s.source = NormalSource::simulated;
  s.normals.radii = {0.5, 1.1, 2.5};
  const auto rows = m3c2(input, s, 2);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double best = 0, chosen = 0;
    for (double radius : s.normals.radii) {
      double planarity = 0;
      test::slow_normal(input.simulated, input.cores[i], radius, &planarity);
      if (planarity > best) {
        best = planarity;
        chosen = radius;
      }
    }
    EXPECT_EQ(rows[i].normal.radius, chosen) << i;
  }
}

std::vector<std::uint64_t> bits(const std::vector<M3c2Row>& rows) {
  std::vector<std::uint64_t> all;
  for (const M3c2Row& r : rows)
    for (double v :
         {r.normal.direction[0], r.normal.direction[1], r.normal.direction[2], r.normal.radius, r.simulated.position,
          r.simulated.spread, r.observed.position, r.observed.spread, r.distance, r.detection})
      all.push_back(std::bit_cast<std::uint64_t>(v));
  return all;
}

TEST(M3c2, SameBitsOnAnyNumberOfThreads) {
  const M3c2Input input{rough(4000, 0, 1), rough(4000, 0.3, 2), rough(1500, 0.1, 3), {}};
  M3c2Settings s = golden_settings(CompareConvention::scarp);
  s.source = NormalSource::simulated;
  const auto one = bits(m3c2(input, s, 1));
  EXPECT_EQ(one, bits(m3c2(input, s, 2)));
  EXPECT_EQ(one, bits(m3c2(input, s, 3)));
}

PointCloud cloud_of(std::vector<Vec3> positions) {
  PointCloud cloud;
  cloud.positions = std::move(positions);
  return cloud;
}

CompareOptions golden_options() {
  CompareOptions options;
  options.name = "golden";
  options.method = CompareMethod::m3c2;
  options.max_distance = 2;
  options.m3c2.normal_radii = {0.35, 0.7, 1.4};
  options.m3c2.cylinder_radius = 0.45;
  return options;
}

TEST(CompareM3c2, WritesEveryNumberIntoTheCloudAndTheReport) {
  PointCloud cores = cloud_of(golden_cores());
  cores.normals = golden_normals();
  cores.positions.push_back({500, 500, 0});
  cores.normals.push_back({0, 0, 0});
  cores.scalars = {{"distance", "m", {9, 9, 9, 9, 9}}, {"kept", "1", {1, 2, 3, 4, 5}}};
  CompareOptions options = golden_options();
  options.m3c2.normals = NormalSource::core;
  const Comparison result =
      compare_m3c2(cloud_of(golden_cloud(0.10, 0)), cloud_of(golden_cloud(0.11, 0.25)), &cores, options, 2);
  const std::vector<std::string> names{"distance",        "lod",
                                       "significant",     "spread_simulated",
                                       "spread_observed", "count_simulated",
                                       "count_observed",  "normal_radius",
                                       "flags",           "kept"};
  ASSERT_EQ(result.cloud.scalars.size(), names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    EXPECT_EQ(result.cloud.scalars[k].name, names[k]);
    EXPECT_EQ(result.cloud.scalars[k].values.size(), 5u);
  }
  EXPECT_NEAR(result.cloud.scalars[0].values[0], kGolden[0].distance, 1e-9);
  EXPECT_EQ(result.cloud.scalars[2].values[0], 1);
  EXPECT_NEAR(result.cloud.normals[1][1], kGolden[1].normal[1], 1e-9);
  for (std::size_t k : {0, 1, 2, 3, 4, 7}) EXPECT_TRUE(std::isnan(result.cloud.scalars[k].values[4])) << k;
  EXPECT_EQ(result.cloud.scalars[5].values[4], 0);
  EXPECT_EQ(result.cloud.scalars[8].values[4], 15);
  EXPECT_EQ(result.report.distances->points, 5u);
  EXPECT_EQ(result.report.distances->matched, 4u);
  ASSERT_EQ(result.report.groups.size(), 2u);
  EXPECT_EQ(result.report.groups[0].name, "detection");
  EXPECT_EQ(std::get<std::int64_t>(result.report.groups[0].measures[0].value), 4);
}

TEST(CompareM3c2, OriginsDoNotShowInTheResult) {
  PointCloud first = cloud_of(golden_cloud(0.10, 0)), second = cloud_of(golden_cloud(0.11, 0.25));
  const Comparison plain = compare_m3c2(first, second, nullptr, golden_options(), 2);
  first.site.origin = {500000, 4100000, 1200};
  for (Vec3& p : second.positions) p = p + first.site.origin;
  const Comparison moved = compare_m3c2(first, second, nullptr, golden_options(), 2);
  EXPECT_EQ(moved.cloud.positions, first.positions);
  for (std::size_t i = 0; i < first.size(); i += 7)
    ASSERT_NEAR(moved.cloud.scalars[0].values[i], plain.cloud.scalars[0].values[i], 1e-9);
}

TEST(CompareM3c2, GuessesRadiiThatHoldThirtyPoints) {
  CompareOptions options = golden_options();
  options.m3c2.normal_radii = {};
  options.m3c2.cylinder_radius = 0;
  PointCloud cores = cloud_of(golden_cores());
  const Comparison result =
      compare_m3c2(cloud_of(golden_cloud(0.10, 0)), cloud_of(golden_cloud(0.11, 0.25)), &cores, options, 2);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GE(result.cloud.scalars[6].values[i], 20) << "of the sparser, observed cloud";
    EXPECT_LE(result.cloud.scalars[6].values[i], 60);
  }
}

TEST(CompareM3c2, RefusesWhatCannotBeCompared) {
  const PointCloud first = cloud_of(golden_cloud(0.10, 0)), second = cloud_of(golden_cloud(0.11, 0.25));
  const auto refused = [&](auto&& change) {
    CompareOptions options = golden_options();
    change(options);
    EXPECT_THROW(compare_m3c2(first, second, nullptr, options, 1), Error);
  };
  refused([](CompareOptions& o) { o.max_distance = 0; });
  refused([](CompareOptions& o) { o.registration_error = -1; });
  refused([](CompareOptions& o) { o.registration_error = std::numeric_limits<double>::quiet_NaN(); });
  refused([](CompareOptions& o) { o.m3c2.normal_radii = {1, 0}; });
  refused([](CompareOptions& o) { o.m3c2.normals = NormalSource::core; });
  refused([](CompareOptions& o) { o.m3c2.orientation = NormalSide::towards; });
  EXPECT_THROW(compare_m3c2({}, second, nullptr, golden_options(), 1), Error);
  EXPECT_THROW(compare_m3c2(first, {}, nullptr, golden_options(), 1), Error);
  const PointCloud nowhere;
  EXPECT_THROW(compare_m3c2(first, second, &nowhere, golden_options(), 1), Error);
}

}  // namespace
}  // namespace scarp

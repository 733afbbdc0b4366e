// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/synth/synth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// The default scan at a tenth of its density, without faults.
SyntheticScan bare_scan() {
  SyntheticScan scan;
  scan.density /= 10;
  scan.truth_cell = 1;
  scan.range_noise = 0;
  scan.vegetation = 0;
  scan.outliers = 0;
  return scan;
}

/// Level ground 20 m below a scanner in the middle.
SyntheticScan plate() {
  SyntheticScan scan = bare_scan();
  scan.height = 0;
  scan.roughness = 0;
  scan.scanner = {50, 50, 20};
  scan.density = 4;
  return scan;
}

SyntheticScan with_slide() {
  SyntheticScan scan = bare_scan();
  scan.slide = SyntheticSlide{{50, 65}, 12, 4, 40};
  return scan;
}

Vec3 local(const SyntheticScan& scan, const Vec3& p) { return p - scan.site_offset; }

/// Height of a point above the bare ground.
double above_ground(const SyntheticScan& scan, const Vec3& p) {
  const Vec3 q = local(scan, p);
  return q[2] - ground_height(scan, q[0], q[1]);
}

TEST(Synth, WithoutNoiseEveryPointIsOnTheGround) {
  SyntheticScan scan = with_slide();
  scan.site_offset = {512000, 5412000, 300};
  const PointCloud cloud = synthesize(scan, 2).cloud;
  ASSERT_GT(cloud.size(), 10000u);
  double worst = 0;
  for (const Vec3& p : cloud.positions) {
    worst = std::max(worst, std::abs(above_ground(scan, p)));
    const Vec3 q = local(scan, p);
    EXPECT_TRUE(q[0] > -1e-6 && q[0] < 100 + 1e-6 && q[1] > -1e-6 && q[1] < 100 + 1e-6);
  }
  EXPECT_LT(worst, 1e-6);
  EXPECT_EQ(cloud.site.origin, (Vec3{0, 0, 0}));
}

TEST(Synth, EveryAttributeHasOneValuePerPoint) {
  const PointCloud cloud = synthesize(SyntheticScan{}, 2).cloud;
  EXPECT_GT(cloud.size(), 200000u);
  EXPECT_LT(cloud.size(), 400000u);
  for (const std::size_t length : {cloud.colour.size(), cloud.intensity.size(), cloud.classification.size(),
                                   cloud.return_number.size(), cloud.number_of_returns.size()})
    EXPECT_EQ(length, cloud.size());
  EXPECT_TRUE(std::all_of(cloud.positions.begin(), cloud.positions.end(), is_finite));
  double red = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    red += cloud.colour[i][0];
    EXPECT_EQ(cloud.colour[i][0] % 257, 0);
    EXPECT_EQ(cloud.return_number[i], 1);
    EXPECT_EQ(cloud.number_of_returns[i], 1);
  }
  EXPECT_GT(red / static_cast<double>(cloud.size()), 0.2 * 65535);
  EXPECT_LT(red / static_cast<double>(cloud.size()), 0.8 * 65535);
}

// On level ground at height h below the scanner, a patch at plan distance d gets
// density (R0 / R)^2 h / R per area, with R^2 = d^2 + h^2.
TEST(Synth, DensityFallsWithTheSquareOfTheRangeAndTheCosineOfIncidence) {
  const SyntheticScan scan = plate();
  const PointCloud cloud = synthesize(scan, 2).cloud;
  const double h = scan.scanner[2];
  for (const auto& [inner, outer] : {Vec2{0, 10}, Vec2{10, 20}, Vec2{20, 33}, Vec2{33, 50}}) {
    double count = 0;
    for (const Vec3& p : cloud.positions) {
      const double d = std::hypot(p[0] - 50, p[1] - 50);
      count += d >= inner && d < outer;
    }
    // Integral over the ring: 2 pi density R0^2 [ -h / R ].
    const double expected = 2 * M_PI * scan.density * scan.reference_range * scan.reference_range *
                            (h / std::hypot(inner, h) - h / std::hypot(outer, h));
    EXPECT_NEAR(count / expected, 1, 0.02) << "ring from " << inner << " m";
  }
}

TEST(Synth, WhatTheScannerCannotSeeIsEmptyUnlessAskedFor) {
  SyntheticScan scan = bare_scan();
  scan.roughness = 0;
  scan.scanner = {50, -30, 25};  // the crest is at 40 m: its flat lies in the shadow
  const auto on_crest = [](const PointCloud& cloud) {
    return std::count_if(cloud.positions.begin(), cloud.positions.end(), [](const Vec3& p) { return p[1] > 80.5; });
  };
  const PointCloud seen = synthesize(scan, 1).cloud;
  EXPECT_EQ(on_crest(seen), 0);
  scan.occlusion = false;
  const PointCloud all = synthesize(scan, 1).cloud;
  double expected = 0;  // of the level crest, seen from 15 m below it through the ground
  for (double x = 0.25; x < 100; x += 0.5)
    for (double y = 80.75; y < 100; y += 0.5) {
      const double range = norm(Vec3{x, y, 40} - scan.scanner);
      expected += 0.25 * scan.density * std::pow(scan.reference_range / range, 2) * 15 / range;
    }
  EXPECT_NEAR(static_cast<double>(on_crest(all)) / expected, 1, 0.1);
  for (const Vec3& p : all.positions) EXPECT_NEAR(above_ground(scan, p), 0, 1e-6);
}

TEST(Synth, NoSeenPointHasGroundBeforeIt) {
  SyntheticScan scan = bare_scan();
  scan.roughness = 2;
  const PointCloud cloud = synthesize(scan, 2).cloud;
  for (std::size_t i = 0; i < cloud.size(); i += 101) {
    const Vec3 d = cloud.positions[i] - scan.scanner;
    for (double t = 0.3; t < 0.99; t += 0.002) {
      const Vec3 p = scan.scanner + t * d;
      if (p[1] < 0 || p[0] < 0 || p[0] > 100) continue;
      ASSERT_GT(above_ground(scan, p), -0.02) << "point " << i << " is seen through the ground";
    }
  }
}

TEST(Synth, SharesAndHeightsOfTheClasses) {
  SyntheticScan scan = bare_scan();
  scan.density *= 2.5;
  scan.vegetation = 0.2;
  scan.outliers = 0.02;
  const PointCloud cloud = synthesize(scan, 2).cloud;
  const double tallest = scan.vegetation_height;
  std::array<double, 256> share{};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint8_t c = cloud.classification[i];
    share[c] += 1.0 / static_cast<double>(cloud.size());
    const double height = above_ground(scan, cloud.positions[i]);
    const double lowest = c == 2 ? 0 : c == 5 ? 0.05 * tallest : c == 18 ? tallest + 2 : -10;
    const double highest = c == 2 ? 0 : c == 5 ? tallest : c == 18 ? tallest + 12 : -2;
    EXPECT_TRUE(height > lowest - 1e-6 && height < highest + 1e-6) << height << " m, class " << int{c};
  }
  EXPECT_NEAR(share[5], scan.vegetation, 0.01);
  EXPECT_NEAR(share[7], scan.outliers / 2, 0.002);
  EXPECT_NEAR(share[18], scan.outliers / 2, 0.002);
  EXPECT_NEAR(share[2] + share[5] + share[7] + share[18], 1, 1e-9);
}

TEST(Synth, NoiseIsAlongTheRayAndAsLargeAsAskedFor) {
  SyntheticScan scan = plate(), noisy = scan;
  noisy.range_noise = 0.05;
  const PointCloud a = synthesize(scan, 1).cloud, b = synthesize(noisy, 1).cloud;
  ASSERT_EQ(a.size(), b.size());
  double sum = 0, squares = 0, across = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 ray = a.positions[i] - scan.scanner, shift = b.positions[i] - a.positions[i];
    const double along = dot(shift, ray) / norm(ray);
    sum += along;
    squares += along * along;
    across = std::max(across, norm(shift - (along / norm(ray)) * ray));
  }
  const double n = static_cast<double>(a.size());
  EXPECT_LT(across, 1e-9);
  EXPECT_NEAR(sum / n, 0, 4 * 0.05 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.05, 0.002);
}

TEST(Synth, RoughnessHasTheDeviationAskedFor) {
  SyntheticScan scan = plate();
  scan.roughness = 0.5;
  double sum = 0, squares = 0, n = 0;
  for (double x = 0.35; x < 1500; x += 7.3)
    for (double y = 0.35; y < 1500; y += 7.3) {
      const double z = ground_height(scan, x, y);
      sum += z;
      squares += z * z;
      ++n;
    }
  EXPECT_NEAR(sum / n, 0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / n), 0.5, 0.025);
}

TEST(Synth, TheSlopeIsFlatAtBothEndsAndSmoothBetween) {
  SyntheticScan scan = bare_scan();
  scan.roughness = 0;
  EXPECT_EQ(ground_height(scan, 50, 20), 0);
  EXPECT_NEAR(ground_height(scan, 50, 50), 20, 1e-12);
  EXPECT_NEAR(ground_height(scan, 50, 80), 40, 1e-12);
  const auto gradient = [&](double y) {
    return (ground_height(scan, 50, y + 5e-4) - ground_height(scan, 50, y - 5e-4)) / 1e-3;
  };
  double before = 0;
  for (double y = 15; y < 85; y += 0.1) {
    const double now = gradient(y);
    EXPECT_GE(now, -1e-12);
    EXPECT_NEAR(now, before, 0.012) << y;  // 0.83 within 12 m by half a cosine: at most 0.011 in 0.1 m
    before = now;
  }
}

TEST(Synth, TheSlideKeepsItsVolume) {
  const SyntheticScan scan = with_slide();
  double scar = 0, lobe = 0, deepest = 0;
  const double cell = 0.05;
  for (double x = cell / 2; x < 100; x += cell)
    for (double y = cell / 2; y < 100; y += cell) {
      const double change = slide_change(scan, x, y);
      (change < 0 ? scar : lobe) += change * cell * cell;
      deepest = std::min(deepest, change);
    }
  EXPECT_NEAR(-scar, 5.0 / 9 * M_PI * 12 * 12 * 4, 1e-3 * lobe);
  EXPECT_NEAR(lobe, -scar, 1e-3 * lobe);
  EXPECT_NEAR(deepest, -4, 0.01);
  SyntheticScan before = scan;
  before.slide.reset();
  for (const double y : {65.0, 25.0, 45.0})
    EXPECT_NEAR(ground_height(scan, 50, y) - ground_height(before, 50, y), slide_change(scan, 50, y), 1e-12);
}

TEST(Synth, TruthIsTheGroundInTheSitesCoordinates) {
  SyntheticScan scan = with_slide();
  scan.site_offset = {512000, 5412000, 300};
  scan.size = {100, 90.1};
  scan.truth_cell = 0.5;
  const Heightfield truth = synthesize(scan, 2).truth;
  for (const Vec2& p : {Vec2{0, 0}, Vec2{50, 65}, Vec2{12.5, 40}, Vec2{100, 90}})
    EXPECT_NEAR(height_at(truth, p[0] + 512000, p[1] + 5412000), ground_height(scan, p[0], p[1]) + 300, 1e-9);
  EXPECT_TRUE(std::isfinite(height_at(truth, 512100, 5412090.1)));
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Synth, SameBitsForAnyNumberOfThreads) {
  SyntheticScan scan = with_slide();
  scan.vegetation = 0.1;
  scan.outliers = 0.01;
  scan.range_noise = 0.01;
  const SyntheticResult one = synthesize(scan, 1), three = synthesize(scan, 3);
  EXPECT_TRUE(same_bits(one.cloud.positions, three.cloud.positions));
  EXPECT_TRUE(same_bits(one.cloud.colour, three.cloud.colour));
  EXPECT_TRUE(same_bits(one.cloud.intensity, three.cloud.intensity));
  EXPECT_TRUE(same_bits(one.cloud.classification, three.cloud.classification));
  EXPECT_TRUE(same_bits(one.truth.z, three.truth.z));
}

TEST(Synth, SeedsMakeOtherGroundAndSurveysOtherPointsOfTheSameGround) {
  const SyntheticScan scan = bare_scan();
  SyntheticScan other = scan, again = scan;
  other.seed = 2;
  again.survey = 1;
  const SyntheticResult a = synthesize(scan, 2), b = synthesize(other, 2), c = synthesize(again, 2);
  EXPECT_FALSE(same_bits(a.truth.z, b.truth.z));
  EXPECT_TRUE(same_bits(a.truth.z, c.truth.z));
  EXPECT_FALSE(same_bits(a.cloud.positions, c.cloud.positions));
  EXPECT_NEAR(static_cast<double>(c.cloud.size()) / static_cast<double>(a.cloud.size()), 1, 0.02);
}

TEST(Synth, TheSweepGoesRowByRow) {
  const SyntheticScan scan = bare_scan();
  const PointCloud cloud = synthesize(scan, 2).cloud;
  double elevation = -M_PI;
  std::size_t falls = 0;
  for (const Vec3& p : cloud.positions) {
    const Vec3 d = p - scan.scanner;
    const double now = std::atan2(d[2], std::hypot(d[0], d[1]));
    falls += now < elevation - 1e-9;
    elevation = now;
  }
  EXPECT_EQ(falls, 0u);
}

TEST(Synth, WrongOptionsAreRefused) {
  const auto refused = [](auto&& spoil) {
    SyntheticScan scan = with_slide();
    spoil(scan);
    try {
      synthesize(scan, 1);
    } catch (const Error&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused([](SyntheticScan&) {}));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.density = 0; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.density = 1e12; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.roughness = NAN; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.toe_length = 80; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.vegetation = 0.8, s.outliers = 0.3; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.scanner = {50, 50, 5}; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.scanner = {50, 400, -50}; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.site_offset[0] = 0.5; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.truth_cell = 1e-4; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.slide->travel = 60; }));
  EXPECT_TRUE(refused([](SyntheticScan& s) { s.slide->depth = -1; }));
}

}  // namespace
}  // namespace scarp

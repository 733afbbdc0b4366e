// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/c2m.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "solver/model/error.hpp"
#include "tests/support/sample_meshes.hpp"

namespace scarp {
namespace {

using test::cube;
using test::scattered;
using test::terrain;

PointCloud points(std::vector<Vec3> positions) {
  PointCloud cloud;
  cloud.positions = std::move(positions);
  return cloud;
}

CompareOptions within(double max_distance) {
  CompareOptions options;
  options.name = "n";
  options.method = CompareMethod::c2m;
  options.max_distance = max_distance;
  return options;
}

TEST(CompareC2m, MeasuresSignedDistancesAndTheirSplit) {
  const Comparison result =
      compare_c2m(points({{0.5, 0.5, 1.25}, {0.5, 0.5, 0.9}, {0.5, 0.5, 40}}), cube(), within(2), 1);
  EXPECT_EQ(result.cloud.scalars[0].values[0], 0.25);
  EXPECT_NEAR(result.cloud.scalars[0].values[1], -0.1, 1e-15);
  EXPECT_TRUE(std::isnan(result.cloud.scalars[0].values[2]));
  EXPECT_EQ(result.cloud.scalars[3].values[0], -0.25) << "observed minus simulated";
  EXPECT_EQ(result.report.distances->matched, 2u);
  EXPECT_EQ(result.report.groups[0].name, "mesh");
  EXPECT_TRUE(result.report.warnings.empty());
}

TEST(CompareC2m, OriginsDoNotShowInTheResult) {
  PointCloud cloud = points(scattered(50, {-1, -1, -1}, {2, 2, 2}, 4));
  cloud.site.origin = {500000, 4100000, 0};
  TriangleMesh mesh = cube();
  const Comparison near = compare_c2m(points(cloud.positions), mesh, within(9), 1);
  for (Vec3& v : mesh.vertices) v = v + cloud.site.origin;
  const Comparison far = compare_c2m(cloud, mesh, within(9), 1);
  EXPECT_EQ(near.cloud.scalars[0].values, far.cloud.scalars[0].values);
}

TEST(CompareC2m, SameBitsOnAnyNumberOfThreads) {
  const PointCloud cloud = points(scattered(2000, {-3, -3, -5}, {20, 20, 6}, 5));
  const auto bits = [&](int threads) {
    std::vector<std::uint64_t> all;
    for (const PointScalar& s : compare_c2m(cloud, terrain(17), within(4), threads).cloud.scalars)
      for (double v : s.values) all.push_back(std::bit_cast<std::uint64_t>(v));
    return all;
  };
  EXPECT_EQ(bits(1), bits(2));
  EXPECT_EQ(bits(1), bits(3));
}

}  // namespace
}  // namespace scarp

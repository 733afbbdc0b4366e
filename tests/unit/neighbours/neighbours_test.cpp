// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/neighbours/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

/// Every point with its distance, nearest first: the slow, obvious search.
std::vector<Neighbour> all_sorted(const std::vector<Vec3>& positions, const Vec3& query) {
  std::vector<Neighbour> all;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 d = query - positions[i];
    all.push_back({i, dot(d, d)});
  }
  std::sort(all.begin(), all.end());
  return all;
}

double unit(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

std::vector<Vec3> scattered(std::size_t count, const Vec3& size, const Vec3& corner, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (int a = 0; a < 3; ++a) p[a] = corner[a] + size[a] * unit(generator);
  return points;
}

/// A lattice whose points are equally far in many directions, each node twice.
std::vector<Vec3> doubled_lattice(int n, double spacing) {
  std::vector<Vec3> points;
  for (int copy = 0; copy < 2; ++copy)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) points.push_back({spacing * i, spacing * j, spacing * k});
  return points;
}

void expect_as_brute_force(const std::vector<Vec3>& positions, const std::vector<Vec3>& queries) {
  const Neighbours neighbours(positions);
  std::vector<Neighbour> found;
  for (const Vec3& query : queries) {
    const std::vector<Neighbour> all = all_sorted(positions, query);
    for (std::size_t k : {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{60}, positions.size() + 5}) {
      neighbours.nearest(query, k, found);
      const std::vector<Neighbour> expected(all.begin(), all.begin() + std::min(k, all.size()));
      ASSERT_EQ(found, expected) << "k " << k;
    }
    // Radii that end exactly on a point, and between points.
    for (std::size_t rank : {std::size_t{0}, all.size() / 50, all.size() / 3}) {
      const double radius = std::sqrt(all[rank].squared_distance);
      const auto end = std::find_if(all.begin(), all.end(),
                                    [&](const Neighbour& n) { return n.squared_distance > radius * radius; });
      ASSERT_EQ(neighbours.within(query, radius), std::vector<Neighbour>(all.begin(), end)) << "radius " << radius;
    }
    ASSERT_EQ(neighbours.closest(query), all.front());
  }
}

TEST(Neighbours, AgreesWithBruteForceOnScatteredPoints) {
  expect_as_brute_force(scattered(3000, {100, 50, 10}, {-20, 4, 0}, 1),
                        scattered(60, {140, 90, 40}, {-40, -16, -15}, 2));
}

TEST(Neighbours, AgreesWithBruteForceWhereEverythingIsTied) {
  const std::vector<Vec3> lattice = doubled_lattice(9, 0.1);
  std::vector<Vec3> queries(lattice.begin(), lattice.begin() + 60);
  for (int i = 0; i < 30; ++i) queries.push_back({0.05 * i, 0.4, 0.05 * (i % 7)});
  expect_as_brute_force(lattice, queries);
}

TEST(Neighbours, AgreesWithBruteForceInMapCoordinates) {
  const Vec3 corner{500000, 5400000, 1200};
  expect_as_brute_force(scattered(2000, {10, 10, 1}, corner, 3), scattered(30, {12, 12, 3}, corner, 4));
}

TEST(Neighbours, ManyCopiesOfOnePointComeByIndex) {
  const std::vector<Vec3> same(5000, Vec3{1.5, -2, 3});
  const std::vector<Neighbour> found = Neighbours(same).nearest({1.5, -2, 3}, 4);
  ASSERT_EQ(found.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(found[i], (Neighbour{i, 0.0}));
  EXPECT_EQ(Neighbours(same).closest({1.5, -2, 4}), (Neighbour{0, 1.0}));
}

TEST(Neighbours, PilesOfCopiesAreAnsweredAsBruteForceDoes) {
  std::vector<Vec3> points = scattered(1500, {4, 4, 4}, {-2, -2, -2}, 8);
  for (int i = 0; i < 4000; ++i) points.push_back(i % 3 == 0 ? Vec3{0, 0, 0} : Vec3{1, i % 2 == 0 ? 0.0 : -0.0, 1});
  points.insert(points.end(), points.begin(), points.begin() + 700);
  expect_as_brute_force(points, {{0, 0, 0}, {1, 0, 1}, {0.5, 0, 0.5}, {0.3, 0.2, -0.4}, points[5], points[1000]});
}

TEST(Neighbours, PilesOfCopiesCostNoTime) {
  const std::vector<Vec3> same(200000, Vec3{1.5, -2, 3});
  const Neighbours neighbours(same);
  for (std::size_t i = 0; i < same.size(); ++i) ASSERT_EQ(neighbours.closest(same[i])->index, 0u);
}

TEST(Neighbours, ClosestStopsAtItsLimitInclusively) {
  const std::vector<Vec3> positions{{0, 0, 0}, {3, 4, 0}};
  const Neighbours neighbours(positions);
  EXPECT_EQ(neighbours.closest({6, 8, 0}, 5.0), (Neighbour{1, 25.0}));
  EXPECT_FALSE(neighbours.closest({6, 8, 0}, std::nextafter(5.0, 0.0)).has_value());
  EXPECT_EQ(neighbours.closest({0, 0, 0}, 0.0), (Neighbour{0, 0.0}));
}

TEST(Neighbours, AnswersNothingToQueriesThatHaveNoAnswer) {
  const std::vector<Vec3> none, one{{1, 2, 3}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Neighbours(none).nearest({0, 0, 0}, 3).empty());
  EXPECT_TRUE(Neighbours(none).within({0, 0, 0}, 1e9).empty());
  EXPECT_FALSE(Neighbours(none).closest({0, 0, 0}).has_value());
  const Neighbours neighbours(one);
  EXPECT_TRUE(neighbours.nearest({0, 0, 0}, 0).empty());
  EXPECT_TRUE(neighbours.nearest({nan, 0, 0}, 1).empty());
  EXPECT_FALSE(neighbours.closest({0, INFINITY, 0}).has_value());
  EXPECT_TRUE(neighbours.within({1, 2, 3}, nan).empty());
  EXPECT_TRUE(neighbours.within({1, 2, 3}, -1).empty());
  EXPECT_EQ(neighbours.within({0, 0, 0}, INFINITY).size(), 1u);
}

TEST(Neighbours, RefusesPositionsThatAreNotFinite) {
  std::vector<Vec3> positions(10, Vec3{1, 2, 3});
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(), 1e200}) {
    positions[7][1] = bad;
    try {
      Neighbours refused(positions);
      FAIL() << "accepted " << bad;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("point 7"), std::string::npos) << error.what();
    }
  }
}

TEST(Neighbours, AnswersAlikeFromManyThreads) {
  const std::vector<Vec3> positions = scattered(20000, {50, 50, 5}, {0, 0, 0}, 5);
  const std::vector<Vec3> queries = scattered(4000, {50, 50, 5}, {0, 0, 0}, 6);
  const Neighbours neighbours(positions);
  std::vector<std::vector<Neighbour>> one(queries.size()), three(queries.size());
  parallel_for(queries.size(), 1, [&](std::size_t i) { one[i] = neighbours.nearest(queries[i], 8); });
  parallel_for(queries.size(), 3, [&](std::size_t i) { three[i] = neighbours.nearest(queries[i], 8); });
  EXPECT_EQ(one, three);
}

}  // namespace
}  // namespace scarp

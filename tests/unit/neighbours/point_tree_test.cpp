// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/neighbours/point_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

std::vector<Vec3> scattered(std::size_t count, const Vec3& size, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (std::size_t a = 0; a < 3; ++a) p[a] = size[a] * unit(generator);
  return points;
}

TEST(PointTree, HoldsEveryPointOnce) {
  for (std::size_t count : {0u, 1u, 15u, 16u, 17u, 1000u, 4097u}) {
    const std::vector<Vec3> positions = scattered(count, {3, 2, 1}, 5);
    const PointTree tree(positions);
    ASSERT_EQ(tree.size(), count);
    std::set<std::uint32_t> seen(tree.indices().begin(), tree.indices().end());
    EXPECT_EQ(seen.size(), count);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(tree.points()[i], positions[tree.indices()[i]]);
    std::size_t visited = 0;
    tree.visit([](const PointTree::Box&) { return true; },
               [&](std::size_t begin, std::size_t end) {
                 EXPECT_EQ(begin, visited);
                 visited = end;
                 for (std::size_t i = begin; i < end; ++i) EXPECT_LT(i, count);
               });
    EXPECT_EQ(visited, count);
  }
}

TEST(PointTree, BoxesHoldTheirPoints) {
  std::vector<Vec3> positions = scattered(3000, {1e-3, 100, 7}, 6);
  for (Vec3& p : positions) p = p + Vec3{512345.67, 5412345.67, 100};
  const PointTree tree(positions);
  PointTree::Box last{};
  tree.visit(
      [&](const PointTree::Box& box) {
        last = box;
        return true;
      },
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          for (std::size_t a = 0; a < 3; ++a) ASSERT_LE(std::abs(tree.points()[i][a] - last.centre[a]), last.half[a]);
      });
}

TEST(PointTree, RegionsMissNothing) {
  const std::vector<Vec3> positions = scattered(5000, {10, 10, 2}, 7);
  const PointTree tree(positions);
  std::size_t inside = 0, looked_at = 0;
  for (const Vec3& centre : scattered(60, {10, 10, 2}, 8)) {
    Vec3 direction = centre - Vec3{5, 4, 0.5};
    direction = (1 / norm(direction)) * direction;
    const Vec3 d0 = positions[17] - centre;
    const double exactly = norm(d0);  // a ball through a point
    std::set<std::uint32_t> ball, cylinder, expected_ball, expected_cylinder;
    tree.visit([&](const PointTree::Box& box) { return may_touch_ball(box, centre, exactly); },
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) ball.insert(tree.indices()[i]);
               });
    tree.visit([&](const PointTree::Box& box) { return may_touch_cylinder(box, centre, direction, 0.4, 3); },
               [&](std::size_t begin, std::size_t end) {
                 looked_at += end - begin;
                 for (std::size_t i = begin; i < end; ++i) cylinder.insert(tree.indices()[i]);
               });
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
      const Vec3 d = positions[i] - centre;
      if (norm(d) <= exactly) {
        EXPECT_TRUE(ball.count(i));
      }
      const double t = dot(d, direction);
      if (std::abs(t) > 3 || norm(d - t * direction) > 0.4) continue;
      ++inside;
      EXPECT_TRUE(cylinder.count(i));
    }
  }
  EXPECT_GT(inside, 500u);
  EXPECT_LT(looked_at, 15 * inside) << "the search is no search";
}

TEST(PointTree, TakesManyCopiesOfOnePoint) {
  const PointTree tree(std::vector<Vec3>(100000, Vec3{1, 2, 3}));
  std::size_t found = 0;
  tree.visit(
      [](const PointTree::Box& box) {
        return may_touch_ball(box, {1, 2, 3}, 0);
      },
      [&](std::size_t begin, std::size_t end) { found += end - begin; });
  EXPECT_EQ(found, 100000u);
}

TEST(PointTree, RefusesWhatIsNoPlace) {
  EXPECT_THROW(PointTree({{0, 0, std::numeric_limits<double>::quiet_NaN()}}), Error);
  EXPECT_THROW(PointTree({{0, 0, 0}, {0, 1e101, 0}}), Error);
}

}  // namespace
}  // namespace scarp

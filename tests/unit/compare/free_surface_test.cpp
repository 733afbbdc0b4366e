// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/free_surface.hpp"

#include <gtest/gtest.h>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

Frame column() {
  Frame frame;
  frame.positions = {{0, 0, 0}, {0, 0, 1}, {0.25, 0, 2}};
  frame.site = {{500000, 5400000, 0}, "EPSG:25832"};
  frame.fields = {{"displacement", "m", 3, std::vector<float>{9, 9, 9, 0, 3, 4, 1, 2, 2}},
                  {"surface", "1", 1, std::vector<std::uint8_t>{0, 1, 1}}};
  return frame;
}

TEST(FreeSurface, IsTheMarkedParticlesWhereTheyAre) {
  const PointCloud cloud = free_surface(column());
  EXPECT_EQ(cloud.positions, (std::vector<Vec3>{{0, 0, 1}, {0.25, 0, 2}}));
  EXPECT_EQ(cloud.site.origin, (Vec3{500000, 5400000, 0}));
  EXPECT_EQ(cloud.site.crs, "EPSG:25832");
  ASSERT_EQ(cloud.scalars.size(), 1u);
  EXPECT_EQ(cloud.scalars[0].name, "displacement");
  EXPECT_EQ(cloud.scalars[0].unit, "m");
  EXPECT_EQ(cloud.scalars[0].values, (std::vector<double>{5, 3}));
}

TEST(FreeSurface, NeedsNoDisplacement) {
  Frame frame = column();
  frame.fields.erase(frame.fields.begin());
  const PointCloud cloud = free_surface(frame);
  EXPECT_EQ(cloud.size(), 2u);
  EXPECT_TRUE(cloud.scalars.empty());
}

TEST(FreeSurface, RefusesFramesWithoutOne) {
  Frame frame = column();
  frame.fields[1].values = std::vector<std::uint8_t>{0, 0, 0};
  EXPECT_THROW(free_surface(frame), Error) << "none marked";
  frame.fields[1].values = std::vector<std::uint8_t>{1, 1};
  EXPECT_THROW(free_surface(frame), Error) << "too short";
  frame.fields[1].values = std::vector<std::int32_t>{1, 1, 1};
  EXPECT_THROW(free_surface(frame), Error) << "wrong type";
  frame.fields[1].name = "other";
  EXPECT_THROW(free_surface(frame), Error) << "no such field";
  frame = column();
  frame.fields[0].values = std::vector<float>{1, 2, 3};
  EXPECT_THROW(free_surface(frame), Error) << "displacement too short";
  EXPECT_THROW(free_surface(Frame{}), Error);
}

}  // namespace
}  // namespace scarp

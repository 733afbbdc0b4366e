// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/raster_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

Heightfield plane(const RasterGrid& grid) {
  Heightfield field = empty_raster(grid, {});
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) field.at(c, r) = 10 + 0.5 * grid.x(c) - 0.25 * grid.y(r);
  return field;
}

TEST(RasterGrid, OverlapKeepsTheCellsInsideTheOther) {
  const RasterGrid grid{10, 8, 2, 1, 1}, other{6, 4, 3, 5, 7};
  const RasterGrid common = overlap(grid, other);
  EXPECT_EQ(common.x0, 5) << "the first centre at or beyond the other's outer edge, 3.5";
  EXPECT_EQ(common.y0, 7);
  EXPECT_EQ(common.columns, 8);
  EXPECT_EQ(common.rows, 5);
  EXPECT_THROW(overlap(grid, {2, 2, 1, 100, 0}), Error);
}

TEST(RasterGrid, CoincidingCellsAreTakenAsTheyAre) {
  Heightfield source = plane({10, 8, 2, 1, 1});
  source.at(4, 3) = NAN;
  Resampling done;
  // Corners written with few digits still coincide.
  const Heightfield same = resample(source, {4, 3, 2, 5 + 1e-7, 5}, &done);
  EXPECT_EQ(done.method, "exact");
  EXPECT_EQ(same.at(0, 0), source.at(2, 2));
  EXPECT_TRUE(std::isnan(same.at(2, 1)));
  const Heightfield beyond = resample(source, {2, 1, 2, 19, 1}, &done);
  EXPECT_EQ(beyond.at(0, 0), source.at(9, 0));
  EXPECT_TRUE(std::isnan(beyond.at(1, 0)));
}

TEST(RasterGrid, PlanesSurviveEveryResampling) {
  const Heightfield source = plane({40, 30, 2, 1, 1});
  Resampling done;
  const Heightfield shifted = resample(source, {20, 10, 2, 10.3, 8.9}, &done);
  EXPECT_EQ(done.method, "bilinear");
  EXPECT_NEAR(done.shift_x, -0.7, 1e-12);
  EXPECT_NEAR(done.shift_y, -0.1, 1e-12);
  // Edges of the coarse cells on edges of the fine ones: a cell in part inside counts as flat.
  const Heightfield coarse = resample(source, {5, 4, 6, 15, 11}, &done);
  EXPECT_EQ(done.method, "area mean");
  for (const Heightfield* field : {&shifted, &coarse}) {
    const RasterGrid grid = grid_of(*field);
    for (int r = 0; r < grid.rows; ++r)
      for (int c = 0; c < grid.columns; ++c)
        EXPECT_NEAR(field->at(c, r), 10 + 0.5 * grid.x(c) - 0.25 * grid.y(r), 1e-9);
  }
}

TEST(RasterGrid, NoDataSpreadsOnlyWhereItHasWeight) {
  Heightfield source = plane({6, 6, 1, 0, 0});
  source.at(3, 2) = NAN;
  const Heightfield half = resample(source, {4, 1, 1, 0.5, 2}, nullptr);
  EXPECT_FALSE(std::isnan(half.at(1, 0)));
  EXPECT_TRUE(std::isnan(half.at(2, 0))) << "between 2 and 3";
  EXPECT_TRUE(std::isnan(half.at(3, 0)));
  // Three of four cells are enough, one is not.
  Heightfield coarse = resample(source, {1, 1, 2, 2.5, 2.5}, nullptr);
  EXPECT_FALSE(std::isnan(coarse.at(0, 0)));
  source.at(2, 2) = source.at(2, 3) = NAN;
  coarse = resample(source, {1, 1, 2, 2.5, 2.5}, nullptr);
  EXPECT_TRUE(std::isnan(coarse.at(0, 0)));
}

TEST(RasterGrid, PoliciesOfACell) {
  const std::vector<Vec3> points{{0.1, 0.1, 1}, {0.9, 0.2, 2}, {0.5, 0.5, 6}, {1, 0, 4}, {1.5, 0.5, 8}, {-0.1, 0, 9}};
  const RasterGrid grid{3, 1, 1, 0.5, 0.5};
  std::vector<std::uint32_t> counts;
  EXPECT_EQ(grid_points(points, {}, grid, CellPolicy::mean, &counts).at(0, 0), 3);
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{3, 2, 0})) << "the lower edge belongs to a cell";
  EXPECT_EQ(grid_points(points, {}, grid, CellPolicy::median, nullptr).at(0, 0), 2);
  EXPECT_EQ(grid_points(points, {}, grid, CellPolicy::median, nullptr).at(1, 0), 6);
  EXPECT_EQ(grid_points(points, {}, grid, CellPolicy::min, nullptr).at(0, 0), 1);
  EXPECT_EQ(grid_points(points, {}, grid, CellPolicy::max, nullptr).at(0, 0), 6);
  EXPECT_TRUE(std::isnan(grid_points(points, {}, grid, CellPolicy::max, nullptr).at(2, 0)));
  EXPECT_THROW(grid_points(points, {}, grid, CellPolicy::tin, nullptr), Error);
}

TEST(RasterGrid, CoveringGridHasWholeMultiplesOfTheCell) {
  const RasterGrid grid = covering_grid({{-0.1, 3.9, 0}, {7.9, 4.0, 0}}, 2);
  EXPECT_EQ(grid.x0, -1);
  EXPECT_EQ(grid.y0, 3);
  EXPECT_EQ(grid.columns, 5);
  EXPECT_EQ(grid.rows, 2);
  EXPECT_THROW(covering_grid({{0, 0, 0}, {1e9, 1e9, 0}}, 0.01), Error);
  EXPECT_THROW(covering_grid({}, 1), Error);
  EXPECT_THROW(covering_grid({{0, 0, 0}}, 0), Error);
}

TEST(RasterGrid, EmptyCellsAreFilledFromNearDataOnly) {
  Heightfield field = empty_raster({7, 1, 1, 0, 0}, {});
  field.at(0, 0) = 1;
  field.at(2, 0) = 4;
  EXPECT_EQ(fill_empty(field, 0), 0u);
  EXPECT_EQ(fill_empty(field, 2), 3u);
  EXPECT_DOUBLE_EQ(field.at(1, 0), 2.5);
  EXPECT_DOUBLE_EQ(field.at(3, 0), 4);
  EXPECT_DOUBLE_EQ(field.at(4, 0), 4) << "what was filled is no data";
  EXPECT_TRUE(std::isnan(field.at(5, 0)));
}

TEST(RasterGrid, PolygonsWithNotches) {
  const std::vector<Vec2> notch{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  EXPECT_TRUE(inside_polygon(notch, 0.5, 2));
  EXPECT_TRUE(inside_polygon(notch, 3.5, 2));
  EXPECT_FALSE(inside_polygon(notch, 2, 2));
  EXPECT_FALSE(inside_polygon(notch, 5, 2));
}

}  // namespace
}  // namespace scarp

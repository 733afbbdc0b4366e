// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/raster_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostCells = std::size_t{1} << 28;
constexpr double kSame = 1e-6;  ///< of a cell: rasters written with rounded corners still coincide

RasterGrid checked(RasterGrid grid, double columns, double rows) {
  if (!(columns * rows <= static_cast<double>(kMostCells)))
    throw Error("compare", "cells of the raster of a comparison", shortest(columns) + " x " + shortest(rows),
                "at most 2^28; take larger cells");
  grid.columns = static_cast<int>(columns);
  grid.rows = static_cast<int>(rows);
  return grid;
}

/// First and last index along one axis whose centre start + i * cell is within [low, high].
std::pair<int, int> range_within(double start, double cell, int count, double low, double high) {
  const double first = std::ceil((low - start) / cell - kSame), last = std::floor((high - start) / cell + kSame);
  return {static_cast<int>(std::clamp(first, 0.0, double(count))),
          static_cast<int>(std::clamp(last, -1.0, double(count - 1)))};
}

/// Distance from the nearest whole number.
double off_whole(double v) { return v - std::round(v); }

/// Mean of the source's cells over one target cell, by shared area; NaN where less than half has data.
double area_mean(const Heightfield& source, double x, double y, double cell) {
  const auto span = [&](double centre, double start, int count) {
    // In units of source cells, their lower edges at whole numbers.
    const double low = (centre - 0.5 * cell - start) / source.cell + 0.5;
    const double high = low + cell / source.cell;
    const int first = static_cast<int>(std::clamp(std::floor(low), 0.0, double(count)));
    const int last = static_cast<int>(std::clamp(std::ceil(high), 0.0, double(count)));
    return std::tuple{low, high, first, last};
  };
  const auto [x_low, x_high, c0, c1] = span(x, source.x0, source.columns);
  const auto [y_low, y_high, r0, r1] = span(y, source.y0, source.rows);
  double sum = 0, area = 0;
  for (int r = r0; r < r1; ++r)
    for (int c = c0; c < c1; ++c) {
      const double z = source.at(c, r);
      if (std::isnan(z)) continue;
      const double share = (std::min(x_high, c + 1.0) - std::max(x_low, double(c))) *
                           (std::min(y_high, r + 1.0) - std::max(y_low, double(r)));
      sum += share * z;
      area += share;
    }
  const double whole = (x_high - x_low) * (y_high - y_low);
  return area >= 0.5 * whole * (1 - kSame) ? sum / area : kNaN;
}

/// Bilinear; a corner without data matters only where it has weight.
double bilinear(const Heightfield& source, double x, double y) {
  const double u = (x - source.x0) / source.cell, v = (y - source.y0) / source.cell;
  const double i = std::floor(u), j = std::floor(v), a = u - i, b = v - j;
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const double weight = (k & 1 ? a : 1 - a) * (k & 2 ? b : 1 - b);
    if (weight <= kSame) continue;
    const double column = i + (k & 1), row = j + (k >> 1);
    if (!(column >= 0 && row >= 0 && column < source.columns && row < source.rows)) return kNaN;
    sum += weight * source.at(static_cast<int>(column), static_cast<int>(row));
  }
  return sum;
}

}  // namespace

double height_of_cell(std::vector<double>& heights, CellPolicy policy) {
  if (heights.empty()) return kNaN;
  std::sort(heights.begin(), heights.end());
  const std::size_t n = heights.size();
  switch (policy) {
    case CellPolicy::min:
      return heights.front();
    case CellPolicy::max:
      return heights.back();
    case CellPolicy::median:
      return n % 2 ? heights[n / 2] : 0.5 * (heights[n / 2 - 1] + heights[n / 2]);
    case CellPolicy::mean:
    case CellPolicy::tin:
      break;
  }
  // Relative to the lowest, so that digits are kept far from zero.
  double sum = 0;
  for (double z : heights) sum += z - heights.front();
  return heights.front() + sum / static_cast<double>(n);
}

RasterGrid grid_of(const Heightfield& field) { return {field.columns, field.rows, field.cell, field.x0, field.y0}; }

void require_same_grid(const Heightfield& a, const Heightfield& b) {
  if (a.columns != b.columns || a.rows != b.rows || a.cell != b.cell || a.x0 != b.x0 || a.y0 != b.y0)
    throw Error("compare", "the two rasters of a comparison are not on the same cells");
}

Heightfield empty_raster(const RasterGrid& grid, const SiteFrame& site) {
  checked(grid, grid.columns, grid.rows);
  return {grid.columns, grid.rows, grid.cell, grid.x0, grid.y0, std::vector<double>(grid.cells(), kNaN), site};
}

RasterGrid overlap(const RasterGrid& grid, const RasterGrid& other) {
  const double half = 0.5 * other.cell;
  const auto [c0, c1] =
      range_within(grid.x0, grid.cell, grid.columns, other.x0 - half, other.x(other.columns - 1) + half);
  const auto [r0, r1] = range_within(grid.y0, grid.cell, grid.rows, other.y0 - half, other.y(other.rows - 1) + half);
  if (c1 < c0 || r1 < r0)
    throw Error("compare", "the two surfaces do not overlap in plan", "",
                "two surfaces of one place in one coordinate reference system");
  return {c1 - c0 + 1, r1 - r0 + 1, grid.cell, grid.x(c0), grid.y(r0)};
}

RasterGrid covering_grid(const std::vector<Vec3>& points, double cell) {
  if (!(cell > 0) || !std::isfinite(cell))
    throw Error("compare", "cell of the raster of a comparison", shortest(cell), "above 0 m");
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  if (box.empty()) throw Error("compare", "no points to make a raster of", "0 points", "at least 1");
  const double i0 = std::floor(box.min[0] / cell), j0 = std::floor(box.min[1] / cell);
  return checked({0, 0, cell, (i0 + 0.5) * cell, (j0 + 0.5) * cell}, std::floor(box.max[0] / cell) - i0 + 1,
                 std::floor(box.max[1] / cell) - j0 + 1);
}

Heightfield resample(const Heightfield& source, const RasterGrid& grid, Resampling* done) {
  Heightfield result = empty_raster(grid, source.site);
  const double u = (grid.x0 - source.x0) / source.cell, v = (grid.y0 - source.y0) / source.cell;
  const bool same_cell = std::abs(grid.cell / source.cell - 1) * std::max(grid.columns, grid.rows) < kSame;
  const bool exact = same_cell && std::abs(off_whole(u)) < kSame && std::abs(off_whole(v)) < kSame;
  const bool mean = !exact && grid.cell >= 2 * source.cell;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double x = grid.x(column), y = grid.y(row);
      if (exact) {
        const double c = std::round(u) + column, r = std::round(v) + row;
        if (c >= 0 && r >= 0 && c < source.columns && r < source.rows)
          result.at(column, row) = source.at(static_cast<int>(c), static_cast<int>(r));
      } else {
        result.at(column, row) = mean ? area_mean(source, x, y, grid.cell) : bilinear(source, x, y);
      }
    }
  if (done)
    *done = {exact  ? "exact"
             : mean ? "area mean"
                    : "bilinear",
             exact ? 0 : off_whole(u) * source.cell, exact ? 0 : off_whole(v) * source.cell};
  return result;
}

Heightfield grid_points(const std::vector<Vec3>& points, const SiteFrame& site, const RasterGrid& grid,
                        CellPolicy policy, std::vector<std::uint32_t>* counts) {
  if (policy == CellPolicy::tin) throw Error("compare", "a triangulation is no matter of the points in a cell");
  Heightfield result = empty_raster(grid, site);
  std::vector<std::pair<std::size_t, double>> in_cell;
  in_cell.reserve(points.size());
  for (const Vec3& p : points) {
    const double i = std::floor((p[0] - grid.x0) / grid.cell + 0.5), j = std::floor((p[1] - grid.y0) / grid.cell + 0.5);
    if (!(i >= 0 && j >= 0 && i < grid.columns && j < grid.rows) || !std::isfinite(p[2])) continue;
    in_cell.emplace_back(static_cast<std::size_t>(j) * grid.columns + static_cast<std::size_t>(i), p[2]);
  }
  std::sort(in_cell.begin(), in_cell.end());
  if (counts) counts->assign(grid.cells(), 0);
  std::vector<double> heights;
  for (std::size_t begin = 0, end = 0; begin < in_cell.size(); begin = end) {
    heights.clear();
    for (; end < in_cell.size() && in_cell[end].first == in_cell[begin].first; ++end)
      heights.push_back(in_cell[end].second);
    result.z[in_cell[begin].first] = height_of_cell(heights, policy);
    if (counts) (*counts)[in_cell[begin].first] = static_cast<std::uint32_t>(heights.size());
  }
  return result;
}

std::size_t fill_empty(Heightfield& field, double distance) {
  if (!(distance > 0)) return 0;
  const int reach = static_cast<int>(std::min(distance / field.cell + kSame, 1e4));
  const std::vector<double> data = field.z;
  std::size_t filled = 0;
  for (int row = 0; row < field.rows; ++row)
    for (int column = 0; column < field.columns; ++column) {
      if (!std::isnan(field.at(column, row))) continue;
      double sum = 0, weights = 0;
      for (int r = std::max(0, row - reach); r <= std::min(field.rows - 1, row + reach); ++r)
        for (int c = std::max(0, column - reach); c <= std::min(field.columns - 1, column + reach); ++c) {
          const double square = double(r - row) * (r - row) + double(c - column) * (c - column);
          const double z = data[static_cast<std::size_t>(r) * field.columns + c];
          if (std::isnan(z) || square * field.cell * field.cell > distance * distance * (1 + kSame)) continue;
          sum += z / square;
          weights += 1 / square;
        }
      if (weights > 0) field.at(column, row) = sum / weights;
      filled += weights > 0;
    }
  return filled;
}

bool inside_polygon(const std::vector<Vec2>& polygon, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

}  // namespace scarp

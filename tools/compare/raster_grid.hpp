// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rasters and points brought onto one grid of cells.
#pragma once

#include <string>
#include <vector>

#include "solver/model/dod_options.hpp"
#include "solver/model/heightfield.hpp"

namespace scarp {

/// Square cells in plan; x0, y0 is the centre of the cell in the south-west, m.
struct RasterGrid {
  int columns = 0, rows = 0;
  double cell = 0;
  double x0 = 0, y0 = 0;

  std::size_t cells() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  double x(int column) const { return x0 + column * cell; }
  double y(int row) const { return y0 + row * cell; }
  double area() const { return cell * cell; }
};

RasterGrid grid_of(const Heightfield& field);

/// @throws Error unless both have the same cells.
void require_same_grid(const Heightfield& a, const Heightfield& b);

/// A raster without data on a grid. @throws Error for more than 2^28 cells.
Heightfield empty_raster(const RasterGrid& grid, const SiteFrame& site);

/// The cells of `grid` whose centres are within the outer edges of `other`.
/// @throws Error when there are none: the two do not overlap.
RasterGrid overlap(const RasterGrid& grid, const RasterGrid& other);

/// The grid of whole multiples of `cell` whose cells cover the points in plan. @throws Error without points, for a cell
/// that is not above 0, or for more than 2^28 cells.
RasterGrid covering_grid(const std::vector<Vec3>& points, double cell);

/// What was done to bring a raster onto a grid.
struct Resampling {
  std::string method;  ///< "exact" (the cells coincide), "bilinear" or "area mean"
  double shift_x = 0;  ///< from the nearest cell centre of the source to that of the grid, m, at the grid's origin
  double shift_y = 0;
};

/// `source` on the cells of `grid`. Where the cells coincide (to 1e-6 of a cell), its own values; where the grid's
/// cells are below twice the source's, bilinear at the centres (no data beside a cell without data that has weight);
/// otherwise the mean of the source's cells, weighted by the area that they share with the cell, where at least half
/// of the cell has data.
Heightfield resample(const Heightfield& source, const RasterGrid& grid, Resampling* done);

/// Points as a raster: of the points in each cell (the lower edges belong to it) the mean, median, lowest or highest;
/// NaN where there is none. `counts`, if not null, gets the number of points in each cell.
/// @throws Error for policy tin, which is a matter of triangulation.
Heightfield grid_points(const std::vector<Vec3>& points, const SiteFrame& site, const RasterGrid& grid,
                        CellPolicy policy, std::vector<std::uint32_t>* counts);

/// What stands for several heights in a cell: their mean (also for tin), median, lowest or highest; NaN of none. Sorts
/// them.
double height_of_cell(std::vector<double>& heights, CellPolicy policy);

/// Gives cells without data the mean of the data within `distance` (m, between centres), weighted by the inverse square
/// of the distance; returns how many got one. Only what was there before counts as data.
std::size_t fill_empty(Heightfield& field, double distance);

/// Whether (x, y) is inside a polygon (even-odd rule).
bool inside_polygon(const std::vector<Vec2>& polygon, double x, double y);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/seed.hpp"

#include <algorithm>
#include <tuple>

namespace scarp {
namespace {

/// Occupied cells of one row of cells in plan, ascending in x, then up.
std::vector<OccupiedCell> cells_of_row(const SubLattice& grid, const Columns& columns, std::int32_t row) {
  const int n = grid.per_cell, n_across = grid.flat() ? 1 : n;
  std::vector<OccupiedCell> found;
  std::vector<std::uint32_t> points;
  for (std::int32_t i = 0; i < grid.lattice.cells[0]; ++i) {
    std::int32_t low = INT32_MAX, high = -1;
    const auto for_each_span = [&](auto&& f) {
      for (int b = 0; b < n_across; ++b)
        for (int a = 0; a < n; ++a) {
          const std::size_t c = grid.column(i * n + a, row * n_across + b);
          for (std::size_t s = columns.first[c]; s < columns.first[c + 1]; ++s) f(columns.spans[s]);
        }
    };
    for_each_span([&](Span s) {
      low = std::min(low, s.begin / n);
      high = std::max(high, (s.end - 1) / n);
    });
    if (high < low) continue;
    points.assign(high - low + 1, 0);
    for_each_span([&](Span s) {
      for (std::int32_t k = s.begin / n; k <= (s.end - 1) / n; ++k)
        points[k - low] += std::min(s.end, (k + 1) * n) - std::max(s.begin, k * n);
    });
    for (std::int32_t k = low; k <= high; ++k)
      if (points[k - low] > 0) found.push_back({{i, row, k}, points[k - low], 0});
  }
  return found;
}

bool on_terrain_surface(const SubLattice& grid, const Columns& columns, std::int32_t i, std::int32_t j,
                        std::int32_t k) {
  // NaN, outside the plan, compares false: the skirt is no free surface.
  const auto above = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    return a >= 0 && b >= 0 && a < grid.x.count && b < grid.y.count && grid.up.at(c) >= columns.top[grid.column(a, b)];
  };
  return above(i, j, k + 1) || above(i - 1, j, k) || above(i + 1, j, k) || above(i, j - 1, k) || above(i, j + 1, k);
}

bool on_any_surface(const SubLattice& grid, const Columns& columns, std::int32_t i, std::int32_t j, std::int32_t k) {
  const auto empty = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    return a < 0 || b < 0 || a >= grid.x.count || b >= grid.y.count || !columns.contains(grid.column(a, b), c);
  };
  return empty(i, j, k - 1) || empty(i, j, k + 1) || empty(i - 1, j, k) || empty(i + 1, j, k) ||
         (!grid.flat() && (empty(i, j - 1, k) || empty(i, j + 1, k)));
}

bool less_in_order(const OccupiedCell& a, const std::array<std::int32_t, 3>& b) {
  return std::tie(a.at[2], a.at[1], a.at[0]) < std::tie(b[2], b[1], b[0]);
}

bool has_neighbour(const std::vector<OccupiedCell>& cells, const std::array<std::int32_t, 3>& at) {
  for (int c = -1; c <= 1; ++c)
    for (int b = -1; b <= 1; ++b) {
      // Three cells side by side in x stand together in the order.
      const std::array<std::int32_t, 3> first{at[0] - 1, at[1] + b, at[2] + c};
      auto cell = std::lower_bound(cells.begin(), cells.end(), first, less_in_order);
      for (; cell != cells.end() && cell->at[2] == first[2] && cell->at[1] == first[1] && cell->at[0] <= at[0] + 1;
           ++cell)
        if (cell->at != at) return true;
    }
  return false;
}

}  // namespace

std::vector<OccupiedCell> occupied_cells(const SubLattice& grid, const Columns& columns, int threads) {
  const std::int32_t rows = grid.flat() ? 1 : grid.lattice.cells[1];
  const std::int32_t layers = grid.lattice.cells[grid.flat() ? 1 : 2];
  std::vector<std::vector<OccupiedCell>> row(rows);
  parallel_for(rows, threads,
               [&](std::size_t r) { row[r] = cells_of_row(grid, columns, static_cast<std::int32_t>(r)); });

  // A stable counting sort by layer turns (y, x, z) into (z, y, x).
  std::vector<std::size_t> next(static_cast<std::size_t>(layers) + 1, 0);
  for (const auto& r : row)
    for (const OccupiedCell& cell : r) ++next[cell.at[2] + 1];
  for (std::int32_t k = 0; k < layers; ++k) next[k + 1] += next[k];
  std::vector<OccupiedCell> cells(next[layers]);
  for (auto& r : row) {
    for (const OccupiedCell& cell : r) cells[next[cell.at[2]]++] = cell;
    std::vector<OccupiedCell>().swap(r);
  }
  std::size_t first = 0;
  for (OccupiedCell& cell : cells) {
    cell.first = first;
    first += cell.points;
  }
  return cells;
}

void seed(const SubLattice& grid, const Columns& columns, const std::vector<OccupiedCell>& cells, std::size_t begin,
          int threads, Particles& particles) {
  const int n = grid.per_cell, n_across = grid.flat() ? 1 : n;
  const double volume = grid.point_volume();
  const bool terrain = !columns.top.empty();
  parallel_for(cells.size(), threads, [&](std::size_t c) {
    const auto& at = cells[c].at;
    std::size_t p = begin + cells[c].first;
    for (std::int32_t k = at[2] * n; k < (at[2] + 1) * n; ++k)
      for (std::int32_t j = at[1] * n_across; j < (at[1] + 1) * n_across; ++j)
        for (std::int32_t i = at[0] * n; i < (at[0] + 1) * n; ++i) {
          if (!columns.contains(grid.column(i, j), k)) continue;
          particles.id[p] = static_cast<std::int64_t>(p);
          particles.reference_position[p] = grid.point(i, j, k);
          particles.reference_volume[p] = volume;
          particles.surface[p] =
              terrain ? on_terrain_surface(grid, columns, i, j, k) : on_any_surface(grid, columns, i, j, k);
          ++p;
        }
  });
}

void count_cells(const SubLattice& grid, const std::vector<OccupiedCell>& cells, VolumeReport& report) {
  const auto full = static_cast<std::uint32_t>(grid.per_cell * grid.per_cell * (grid.flat() ? 1 : grid.per_cell));
  report.cells = cells.size();
  for (const OccupiedCell& cell : cells) {
    report.full_cells += cell.points == full;
    report.isolated_particles += cell.points == 1 && !has_neighbour(cells, cell.at);
  }
}

}  // namespace scarp

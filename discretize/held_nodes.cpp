// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/held_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {
namespace {

/// Surface over the column that is nearest to a node and inside the plan, among those of the cells around it.
double surface_beside(const SubLattice& grid, const Columns& columns, std::int32_t node_i, std::int32_t node_j) {
  const std::int32_t n = grid.per_cell;
  double nearest = INFINITY, surface = NAN;
  for (std::int32_t b = std::max(0, (node_j - 1) * n); b < std::min(grid.y.count, (node_j + 1) * n); ++b)
    for (std::int32_t a = std::max(0, (node_i - 1) * n); a < std::min(grid.x.count, (node_i + 1) * n); ++a) {
      const double top = columns.top[grid.column(a, b)];
      const double da = a + 0.5 - node_i * n, db = b + 0.5 - node_j * n;
      if (std::isnan(top) || da * da + db * db >= nearest) continue;
      nearest = da * da + db * db;
      surface = top;
    }
  return surface;
}

/// Base elevation at every node in plan; NaN far from the solid.
std::vector<double> base_at_nodes(const TerrainSolid& solid, const SubLattice& grid, const Columns& columns,
                                  const Axis& x, const Axis& y, int threads) {
  std::vector<double> top = sample_tin(solid.tin, x, y, threads);
  parallel_for(top.size(), threads, [&](std::size_t node) {
    const auto i = static_cast<std::int32_t>(node % x.count), j = static_cast<std::int32_t>(node / x.count);
    if (std::isnan(top[node])) top[node] = surface_beside(grid, columns, i, j);
  });
  return sample_base(solid, top, x, y, threads);
}

/// Whether a cell beside the node in plan holds a column outside the solid's plan.
bool on_skirt(const SubLattice& grid, const Columns& columns, std::int32_t node_i, std::int32_t node_j) {
  const std::int32_t n = grid.per_cell;
  for (std::int32_t b = (node_j - 1) * n; b < (node_j + 1) * n; ++b)
    for (std::int32_t a = (node_i - 1) * n; a < (node_i + 1) * n; ++a) {
      const bool beyond = a < 0 || b < 0 || a >= grid.x.count || b >= grid.y.count;
      if (beyond || std::isnan(columns.top[grid.column(a, b)])) return true;
    }
  return false;
}

/// The corners of occupied cells for which held(cell, node) is true.
template <class F>
std::vector<std::array<std::int32_t, 3>> collect_nodes(const std::vector<OccupiedCell>& cells, F&& held) {
  std::vector<std::array<std::int32_t, 3>> upside_down;  // z, y, x: sorts in the order of the lattice
  for (const OccupiedCell& cell : cells)
    for (int corner = 0; corner < 8; ++corner) {
      const std::array<std::int32_t, 3> node{cell.at[0] + (corner & 1), cell.at[1] + (corner >> 1 & 1),
                                             cell.at[2] + (corner >> 2)};
      if (held(cell, node)) upside_down.push_back({node[2], node[1], node[0]});
    }
  std::sort(upside_down.begin(), upside_down.end());
  upside_down.erase(std::unique(upside_down.begin(), upside_down.end()), upside_down.end());
  for (auto& node : upside_down) std::swap(node[0], node[2]);
  return upside_down;
}

NodeSet base_nodes(const TerrainSolid& solid, const SubLattice& grid, const Columns& columns,
                   const std::vector<OccupiedCell>& cells, int threads) {
  const Lattice& lattice = grid.lattice;
  const Axis x = Axis::nodes(lattice.origin[0], lattice.cell, lattice.cells[0]);
  const Axis y = Axis::nodes(lattice.origin[1], lattice.cell, lattice.cells[1]);
  const Axis z = Axis::nodes(lattice.origin[2], lattice.cell, lattice.cells[2]);
  const std::vector<double> base = base_at_nodes(solid, grid, columns, x, y, threads);
  const double tiny = 1e-6 * lattice.cell;  // a base given as a multiple of the cell lies on its nodes

  // Cells ascend in z: the first of a column is its lowest.
  std::vector<std::int32_t> lowest(static_cast<std::size_t>(lattice.cells[0]) * lattice.cells[1], -1);
  const auto lowest_of = [&](const OccupiedCell& cell) -> std::int32_t& {
    return lowest[static_cast<std::size_t>(cell.at[1]) * lattice.cells[0] + cell.at[0]];
  };
  for (const OccupiedCell& cell : cells)
    if (lowest_of(cell) < 0) lowest_of(cell) = cell.at[2];
  return {"base", solid.base, solid.base == Condition::roller ? 2 : -1,
          collect_nodes(cells, [&](const OccupiedCell& cell, const std::array<std::int32_t, 3>& node) {
            const bool bottom_of_column = cell.at[2] == lowest_of(cell) && node[2] == cell.at[2];
            return bottom_of_column ||
                   z.at(node[2]) <= base[static_cast<std::size_t>(node[1]) * x.count + node[0]] + tiny;
          })};
}

}  // namespace

std::vector<NodeSet> hold_nodes(const TerrainSolid& solid, const SubLattice& grid, const Columns& columns,
                                const std::vector<OccupiedCell>& cells, int threads) {
  std::vector<NodeSet> sets;
  if (solid.base != Condition::free) sets.push_back(base_nodes(solid, grid, columns, cells, threads));
  if (solid.hold_skirt)
    sets.push_back({"skirt", Condition::fixed, -1,
                    collect_nodes(cells, [&](const OccupiedCell&, const std::array<std::int32_t, 3>& node) {
                      return on_skirt(grid, columns, node[0], node[1]);
                    })});
  return sets;
}

}  // namespace scarp

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
  std::vector<double> base = sample_tin(solid.tin, x, y, threads);
  parallel_for(base.size(), threads, [&](std::size_t node) {
    const auto i = static_cast<std::int32_t>(node % x.count), j = static_cast<std::int32_t>(node / x.count);
    if (std::isnan(base[node])) base[node] = surface_beside(grid, columns, i, j);
    if (!std::isnan(base[node])) base[node] = solid.base_below(base[node]);
  });
  return base;
}

}  // namespace

std::vector<NodeSet> hold_base(const TerrainSolid& solid, const SubLattice& grid, const Columns& columns,
                               const std::vector<OccupiedCell>& cells, int threads) {
  if (solid.base == Condition::free) return {};
  const Lattice& lattice = grid.lattice;
  const Axis x = Axis::nodes(lattice.origin[0], lattice.cell, lattice.cells[0]);
  const Axis y = Axis::nodes(lattice.origin[1], lattice.cell, lattice.cells[1]);
  const Axis z = Axis::nodes(lattice.origin[2], lattice.cell, lattice.cells[2]);
  const std::vector<double> base = base_at_nodes(solid, grid, columns, x, y, threads);
  const double tiny = 1e-6 * lattice.cell;  // a base given as a multiple of the cell lies on its nodes

  std::vector<std::uint8_t> seen(static_cast<std::size_t>(lattice.cells[0]) * lattice.cells[1], 0);
  std::vector<std::array<std::int32_t, 3>> upside_down;  // z, y, x: sorts in the order of the lattice
  for (const OccupiedCell& cell : cells) {               // ascending in z: the first of a column is its lowest
    const auto& at = cell.at;
    std::uint8_t& column = seen[static_cast<std::size_t>(at[1]) * lattice.cells[0] + at[0]];
    for (int corner = 0; corner < 8; ++corner) {
      const std::int32_t i = at[0] + (corner & 1), j = at[1] + (corner >> 1 & 1), k = at[2] + (corner >> 2);
      const bool bottom_of_column = column == 0 && k == at[2];
      if (bottom_of_column || z.at(k) <= base[static_cast<std::size_t>(j) * x.count + i] + tiny)
        upside_down.push_back({k, j, i});
    }
    column = 1;
  }
  std::sort(upside_down.begin(), upside_down.end());
  upside_down.erase(std::unique(upside_down.begin(), upside_down.end()), upside_down.end());
  NodeSet set{"base", solid.base, solid.base == Condition::roller ? 2 : -1, {}};
  set.nodes.reserve(upside_down.size());
  for (const auto& node : upside_down) set.nodes.push_back({node[2], node[1], node[0]});
  return {std::move(set)};
}

}  // namespace scarp

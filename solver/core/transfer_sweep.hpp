// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the sweeps between particles and grid of total-Lagrangian bodies share.
#pragma once

#include <algorithm>

#include "solver/core/linear_cell.hpp"
#include "solver/core/total_body.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {

/// From monomials to the slots of a cell.
template <int D>
void store_corners(typename LinearCell<D>::Values (&sums)[D], Vec3* slots) {
#pragma GCC unroll 3
  for (int d = 0; d < D; ++d) LinearCell<D>::to_corners(sums[d]);
#pragma GCC unroll 8
  for (int k = 0; k < LinearCell<D>::N; ++k)
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) slots[k][d] = sums[d][k];
}

/// f(cell) over all cells of the body's tasks.
template <class F>
void for_each_cell(TotalBody& body, int threads, F&& f) {
  parallel_for(body.tasks.size(), threads, [&](std::size_t t) {
    for (std::size_t cell = body.tasks[t].begin; cell < body.tasks[t].end; ++cell) f(cell);
  });
}

inline constexpr std::size_t kNodesPerTask = 1024;

/// f(node, sum of its slots). The slots of a node stand far apart: those of a node sixteen further on are asked for
/// meanwhile.
template <class F>
void for_each_node(TotalBody& body, int threads, F&& f) {
  const std::size_t nodes = body.grid.nodes.size();
  const std::vector<std::uint32_t>& around = body.grid.around;
  const std::size_t ahead = 16 * static_cast<std::size_t>(body.grid.corners());
  parallel_for((nodes + kNodesPerTask - 1) / kNodesPerTask, threads, [&](std::size_t t) {
    for (std::size_t i = t * kNodesPerTask; i < std::min(nodes, (t + 1) * kNodesPerTask); ++i) {
      Vec3 sum{0, 0, 0};
      for (std::uint32_t s = body.grid.around_begin[i]; s < body.grid.around_begin[i + 1]; ++s) {
        if (s + ahead < around.size()) __builtin_prefetch(&body.slots[around[s + ahead]]);
        sum = sum + body.slots[around[s]];
      }
      f(i, sum);
    }
  });
}

}  // namespace scarp

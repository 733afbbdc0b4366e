// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the sweeps over an UpdatedGrid share: a particle's weights, and the choice of dimension and shape.
#pragma once

#include <algorithm>

#include "solver/core/updated_grid.hpp"
#include "solver/model/parallel.hpp"
#include "solver/shapes/gimp.hpp"
#include "solver/shapes/linear.hpp"
#include "solver/shapes/quadratic_bspline.hpp"

namespace scarp {

template <int D, class S>
inline constexpr int kWindow = D == 2 ? S::width* S::width : S::width* S::width* S::width;

/// phi_I and its gradient (1/m) at member m of cell c, for all I of the cell's window.
template <int D, class S>
class WindowWeights {
 public:
  WindowWeights(const UpdatedGrid& grid, std::size_t c, std::size_t m) {
    const double per_cell = 1 / grid.cell;
    double half = 0;
    if constexpr (S::has_size) half = grid.half_edge[grid.members[m]];
    for (int a = 0; a < D; ++a) {
      S::weigh(grid.xi[m][a], grid.cells[c][a], grid.cell_count[a], half, value_[a], slope_[a]);
      for (double& slope : slope_[a]) slope *= per_cell;
    }
  }

  /// f(k, phi, gradient) over the window, x fastest.
  template <class F>
  void each(F&& f) const {
    int n = 0;
    if constexpr (D == 2) {
      for (int j = 0; j < S::width; ++j)
        for (int i = 0; i < S::width; ++i, ++n)
          f(n, value_[0][i] * value_[1][j], Vec3{slope_[0][i] * value_[1][j], value_[0][i] * slope_[1][j], 0});
    } else {
      for (int k = 0; k < S::width; ++k)
        for (int j = 0; j < S::width; ++j) {
          const double vv = value_[1][j] * value_[2][k], sv = slope_[1][j] * value_[2][k],
                       vs = value_[1][j] * slope_[2][k];
          for (int i = 0; i < S::width; ++i, ++n)
            f(n, value_[0][i] * vv, Vec3{slope_[0][i] * vv, value_[0][i] * sv, value_[0][i] * vs});
        }
    }
  }

  /// f(k, phi) over the window.
  template <class F>
  void each_value(F&& f) const {
    int n = 0;
    for (int k = 0; k < (D == 2 ? 1 : S::width); ++k)
      for (int j = 0; j < S::width; ++j) {
        const double vv = value_[1][j] * (D == 2 ? 1 : value_[D - 1][k]);
        for (int i = 0; i < S::width; ++i, ++n) f(n, value_[0][i] * vv);
      }
  }

 private:
  double value_[D][S::width], slope_[D][S::width];
};

/// Calls f.operator()<D, S>() for the grid's dimension and shape.
template <class F>
void with_shape(const UpdatedGrid& grid, F&& f) {
  const bool plane = grid.dimension == 2;
  switch (grid.shape) {
    case ShapeFunction::linear:
      return plane ? f.template operator()<2, LinearShape>() : f.template operator()<3, LinearShape>();
    case ShapeFunction::quadratic_bspline:
      return plane ? f.template operator()<2, QuadraticBspline>() : f.template operator()<3, QuadraticBspline>();
    case ShapeFunction::gimp:
      return plane ? f.template operator()<2, Gimp>() : f.template operator()<3, Gimp>();
  }
}

/// Index into the grid's nodes of function k of the window of cell c.
template <int D, class S>
std::uint32_t window_node(const UpdatedGrid& grid, std::size_t c, int k) {
  const auto& cell = grid.cells[c];
  return grid.node_of_lattice[grid.lattice_node(
      {cell[0] + k % S::width, cell[1] + k / S::width % S::width, cell[2] + (D == 2 ? 0 : k / (S::width * S::width))})];
}

/// f(slot) of all occupied cells that give to node n, in a fixed order; such a cell lies at most width - 1 before it on
/// each axis.
template <int D, class S, class F>
void each_slot_of_node(const UpdatedGrid& grid, const std::array<std::int32_t, 3>& n, F&& f) {
  constexpr int w = S::width;
  for (int k = 0; k < kWindow<D, S>; ++k) {
    const std::array<int, 3> place{k % w, k / w % w, D == 2 ? 0 : k / (w * w)};
    std::array<std::int32_t, 3> cell{0, 0, 0};
    bool inside = true;
    for (int a = 0; a < D; ++a) {
      cell[a] = n[a] - place[a];
      inside = inside && cell[a] >= 0 && cell[a] < grid.cell_count[a];
    }
    if (!inside) continue;
    const std::uint32_t c = grid.cell_of_lattice[grid.lattice_cell(cell)];
    if (c != UpdatedGrid::kNone) f(static_cast<std::size_t>(c) * kWindow<D, S> + k);
  }
}

/// Cells that one thread sweeps at a time; the list is fixed by the particles alone.
inline constexpr std::size_t kUpdatedCellsPerTask = 32;

inline std::size_t updated_tasks(const UpdatedGrid& grid) {
  return (grid.cells.size() + kUpdatedCellsPerTask - 1) / kUpdatedCellsPerTask;
}

/// f(task, cell) over all cells.
template <class F>
void for_each_updated_cell(const UpdatedGrid& grid, int threads, F&& f) {
  parallel_for(updated_tasks(grid), threads, [&](std::size_t t) {
    const std::size_t end = std::min(grid.cells.size(), (t + 1) * kUpdatedCellsPerTask);
    for (std::size_t c = t * kUpdatedCellsPerTask; c < end; ++c) f(t, c);
  });
}

/// Sum of the slots of node n.
template <int D, class S>
NodeSums sum_of_slots(const UpdatedGrid& grid, const std::array<std::int32_t, 3>& n) {
  NodeSums sum;
  each_slot_of_node<D, S>(grid, n, [&](std::size_t s) {
    const NodeSums& slot = grid.slots[s];
    sum.mass += slot.mass;
    sum.momentum = sum.momentum + slot.momentum;
    sum.force = sum.force + slot.force;
  });
  return sum;
}

inline constexpr std::size_t kUpdatedNodesPerTask = 1024;

/// f(node, sum of its slots).
template <class F>
void for_each_updated_node(UpdatedGrid& grid, int threads, F&& f) {
  const std::size_t nodes = grid.nodes.size();
  with_shape(grid, [&]<int D, class S>() {
    parallel_for((nodes + kUpdatedNodesPerTask - 1) / kUpdatedNodesPerTask, threads, [&](std::size_t t) {
      for (std::size_t i = t * kUpdatedNodesPerTask; i < std::min(nodes, (t + 1) * kUpdatedNodesPerTask); ++i)
        f(i, sum_of_slots<D, S>(grid, grid.nodes[i]));
    });
  });
}

}  // namespace scarp

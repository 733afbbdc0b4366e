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
      S::weigh(grid.xi[grid.members[m]][a], grid.cells[c][a], grid.cell_count[a], half, value_[a], slope_[a]);
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

/// Of function k of a cell's window from the first, in its block's tile.
template <int D, class S>
constexpr std::uint32_t in_tile(int k) {
  constexpr int edge = kernels::block_edge(D) + S::width - 1, w = S::width;
  return static_cast<std::uint32_t>(k % w + edge * (k / w % w) + edge * edge * (k / (w * w)));
}

/// Index into the grid's nodes of function k of the window of cell c, which is of block b.
template <int D, class S>
std::uint32_t window_node(const UpdatedGrid& grid, std::size_t b, std::size_t c, int k) {
  return grid.tile_nodes[b * grid.tile() + grid.first_in_tile[c] + in_tile<D, S>(k)];
}

/// f(block, cell) over all cells; one thread has a block.
template <class F>
void for_each_updated_cell(const UpdatedGrid& grid, int threads, F&& f) {
  parallel_for(grid.blocks.size(), threads, [&](std::size_t b) {
    for (std::uint32_t c = grid.block_begin[b]; c < grid.block_begin[b + 1]; ++c) f(b, c);
  });
}

/// f(node, place in the tiles) over the functions of all tiles that have a node, those of a node in a fixed order and
/// never at the same time.
template <class F>
void for_each_tile_node(const UpdatedGrid& grid, int threads, F&& f) {
  const std::size_t tile = grid.tile();
  for (const auto& colour : grid.colours)
    parallel_for(colour.size(), threads, [&](std::size_t i) {
      const std::size_t begin = colour[i] * tile;
      for (std::size_t t = begin; t < begin + tile; ++t)
        if (grid.tile_nodes[t] != UpdatedGrid::kNone) f(grid.tile_nodes[t], t);
    });
}

/// f.operator()<D, S>(block, its tile) over all blocks, with tiles set to zero by clear(sums) before.
template <class Sums, class F, class Clear>
void map_blocks(const UpdatedGrid& grid, std::vector<Sums>& tiles, int threads, F&& f, Clear&& clear) {
  const std::size_t tile = grid.tile();
  with_shape(grid, [&]<int D, class S>() {
    parallel_for(grid.blocks.size(), threads, [&](std::size_t b) {
      Sums* const begin = &tiles[b * tile];
      for (Sums* sums = begin; sums != begin + tile; ++sums) clear(*sums);
      f.template operator()<D, S>(b, begin);
    });
  });
}

/// Sums phi_Ip of(p) of all particles in momentum_tiles and gives add(node, sum) what each tile has.
template <class Of, class Add>
void map_vectors(UpdatedGrid& grid, int threads, Of&& of, Add&& add) {
  map_blocks(
      grid, grid.momentum_tiles, threads,
      [&]<int D, class S>(std::size_t b, std::array<double, 4>* tile) {
        for (std::uint32_t c = grid.block_begin[b]; c < grid.block_begin[b + 1]; ++c)
          for (std::uint32_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
            const Vec3 f = of(grid.members[m]);
            if (f == Vec3{0, 0, 0}) continue;
            WindowWeights<D, S>(grid, c, m).each_value([&](int k, double phi) {
              for (int d = 0; d < D; ++d) tile[grid.first_in_tile[c] + in_tile<D, S>(k)][d] += phi * f[d];
            });
          }
      },
      [](std::array<double, 4>& sum) { sum = {}; });
  for_each_tile_node(grid, threads, [&](std::uint32_t node, std::size_t t) {
    const std::array<double, 4>& sum = grid.momentum_tiles[t];
    add(node, Vec3{sum[0], sum[1], sum[2]});
  });
}

/// Adds momentum_tiles to the momenta of the nodes' sums.
void add_momentum_tiles(UpdatedGrid& grid, int threads);

/// Adds what f.operator()<D, S>(block, cell, momenta of its window) gives to the momenta of the nodes' sums; function k
/// of the window is in_tile(k).
template <class F>
void map_more_momenta(UpdatedGrid& grid, int threads, F&& f) {
  map_blocks(
      grid, grid.momentum_tiles, threads,
      [&]<int D, class S>(std::size_t b, std::array<double, 4>* tile) {
        for (std::uint32_t c = grid.block_begin[b]; c < grid.block_begin[b + 1]; ++c)
          f.template operator()<D, S>(b, c, tile + grid.first_in_tile[c]);
      },
      [](std::array<double, 4>& momentum) { momentum = {}; });
  add_momentum_tiles(grid, threads);
}

inline constexpr std::size_t kUpdatedNodesPerTask = 1024;

/// f(node) over all nodes.
template <class F>
void for_each_updated_node(const UpdatedGrid& grid, int threads, F&& f) {
  const std::size_t nodes = grid.nodes.size();
  parallel_for((nodes + kUpdatedNodesPerTask - 1) / kUpdatedNodesPerTask, threads, [&](std::size_t t) {
    for (std::size_t i = t * kUpdatedNodesPerTask; i < std::min(nodes, (t + 1) * kUpdatedNodesPerTask); ++i) f(i);
  });
}

}  // namespace scarp

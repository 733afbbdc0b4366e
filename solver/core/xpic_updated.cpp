// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/updated_window.hpp"
#include "solver/core/xpic.hpp"

namespace scarp {
namespace {

/// Adds to the momenta of the window sum_p phi_Ip m_p (S term)_p.
template <int D, class S>
void map_term_of_cell(const Particles& particles, const UpdatedGrid& grid, std::size_t b, std::size_t c,
                      std::array<double, 4>* momenta) {
  constexpr int window = kWindow<D, S>;
  Vec3 term[window];
  for (int k = 0; k < window; ++k) term[k] = grid.term[window_node<D, S>(grid, b, c, k)];
  for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
    const WindowWeights<D, S> weights(grid, c, m);
    Vec3 v{0, 0, 0};
    weights.each_value([&](int k, double phi) {
      for (int d = 0; d < D; ++d) v[d] += phi * term[k][d];
    });
    const Vec3 mv = particles.mass[grid.members[m]] * v;
    weights.each_value([&](int k, double phi) {
      for (int d = 0; d < D; ++d) momenta[in_tile<D, S>(k)][d] += phi * mv[d];
    });
  }
}

}  // namespace

void filter_velocities(const Particles& particles, UpdatedGrid& grid, int order, int threads) {
  const std::size_t nodes = grid.nodes.size();
  grid.filtered.resize(nodes);
  grid.term.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    grid.term[i] = grid.velocity[i];
    grid.filtered[i] = xpic_factor(order, 1) * grid.term[i];
  }
  for (int k = 2; k <= order; ++k) {
    for_each_updated_node(grid, threads, [&](std::size_t i) { grid.sums[i].momentum = {0, 0, 0}; });
    map_more_momenta(grid, threads, [&]<int D, class S>(std::size_t b, std::size_t c, std::array<double, 4>* momenta) {
      map_term_of_cell<D, S>(particles, grid, b, c, momenta);
    });
    for_each_updated_node(grid, threads, [&](std::size_t i) {
      const NodeSums& sum = grid.sums[i];
      if (!(sum.mass > 0)) return;
      grid.term[i] = with_held((1 / sum.mass) * sum.momentum, grid.velocity[i], grid.kept[i]);
      grid.filtered[i] = grid.filtered[i] + xpic_factor(order, k) * grid.term[i];
    });
  }
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/transfer_sweep.hpp"
#include "solver/core/xpic.hpp"

namespace scarp {
namespace {

/// Slots <- sum_p phi_Ip m_p (S term)_p.
template <int D>
void map_term_of_cell(const Particles& particles, TotalBody& body, std::size_t cell) {
  using Cell = LinearCell<D>;
  typename Cell::Values term[D], m, sums[D]{};
  for (int d = 0; d < D; ++d) {
    for (int k = 0; k < Cell::N; ++k) term[d][k] = body.term[body.grid.cell_nodes[cell * Cell::N + k]][d];
    Cell::to_monomials(term[d]);
  }
  for (std::size_t p = body.grid.cell_begin[cell]; p < body.grid.cell_begin[cell + 1]; ++p) {
    Cell::monomials(body.grid.xi[p - body.begin], m);
    for (int d = 0; d < D; ++d) Cell::add_value(sums[d], m, particles.mass[p] * Cell::value(term[d], m));
  }
  store_corners<D>(sums, &body.slots[cell * Cell::N]);
}

}  // namespace

void filter_velocities(const Particles& particles, TotalBody& body, int order, int threads) {
  const std::size_t nodes = body.grid.nodes.size();
  body.filtered.resize(nodes);
  body.term.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    body.term[i] = body.velocity[i];
    body.filtered[i] = xpic_factor(order, 1) * body.term[i];
  }
  for (int k = 2; k <= order; ++k) {
    if (body.grid.dimension == 2)
      for_each_cell(body, threads, [&](std::size_t cell) { map_term_of_cell<2>(particles, body, cell); });
    else
      for_each_cell(body, threads, [&](std::size_t cell) { map_term_of_cell<3>(particles, body, cell); });
    for_each_node(body, threads, [&](std::size_t i, const Vec3& momentum) {
      body.term[i] = with_held(body.inverse_mass[i] * momentum, body.velocity[i], body.kept[i]);
      body.filtered[i] = body.filtered[i] + xpic_factor(order, k) * body.term[i];
    });
  }
}

}  // namespace scarp

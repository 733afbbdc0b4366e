// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/transfer.hpp"

#include <algorithm>

#include "solver/core/linear_cell.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

constexpr std::size_t kNodesPerTask = 1024;

template <int D>
void store(typename LinearCell<D>::Values (&sums)[D], Vec3* slots) {
#pragma GCC unroll 3
  for (int d = 0; d < D; ++d) LinearCell<D>::to_corners(sums[d]);
#pragma GCC unroll 8
  for (int k = 0; k < LinearCell<D>::N; ++k)
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) slots[k][d] = sums[d][k];
}

template <int D>
void map_momentum_of_cell(const Particles& particles, TotalBody& body, std::size_t cell) {
  using Cell = LinearCell<D>;
  typename Cell::Values m, sums[D]{};
  for (std::size_t p = body.grid.cell_begin[cell]; p < body.grid.cell_begin[cell + 1]; ++p) {
    Cell::monomials(body.grid.xi[p - body.begin], m);
    for (int d = 0; d < D; ++d) Cell::add_value(sums[d], m, particles.mass[p] * particles.velocity[p][d]);
  }
  store<D>(sums, &body.slots[cell * Cell::N]);
}

template <int D>
void advance_cell(Particles& particles, TotalBody& body, double flip, double dt, std::size_t cell) {
  using Cell = LinearCell<D>;
  typename Cell::Values updated[D], change[D], m, sums[D]{};
#pragma GCC unroll 8
  for (int k = 0; k < Cell::N; ++k) {
    const std::uint32_t node = body.grid.cell_nodes[cell * Cell::N + k];
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) {
      updated[d][k] = body.velocity_updated[node][d];
      change[d][k] = updated[d][k] - flip * body.velocity[node][d];
    }
  }
#pragma GCC unroll 3
  for (int d = 0; d < D; ++d) {
    Cell::to_monomials(updated[d]);
    Cell::to_monomials(change[d]);
  }
  for (std::size_t p = body.grid.cell_begin[cell]; p < body.grid.cell_begin[cell + 1]; ++p) {
    Cell::monomials(body.grid.xi[p - body.begin], m);
    const double mass = particles.mass[p];
    Vec3& v = particles.velocity[p];
    Vec3& x = particles.position[p];
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) {
      v[d] = flip * v[d] + Cell::value(change[d], m);
      x[d] += dt * Cell::value(updated[d], m);
      Cell::add_value(sums[d], m, mass * v[d]);
    }
  }
  store<D>(sums, &body.slots[cell * Cell::N]);
}

template <class F>
void for_each_cell(TotalBody& body, int threads, F&& f) {
  parallel_for(body.tasks.size(), threads, [&](std::size_t t) {
    for (std::size_t cell = body.tasks[t].begin; cell < body.tasks[t].end; ++cell) f(cell);
  });
}

/// f(node, sum of its slots).
template <class F>
void for_each_node(TotalBody& body, int threads, F&& f) {
  const std::size_t nodes = body.grid.nodes.size();
  parallel_for((nodes + kNodesPerTask - 1) / kNodesPerTask, threads, [&](std::size_t t) {
    for (std::size_t i = t * kNodesPerTask; i < std::min(nodes, (t + 1) * kNodesPerTask); ++i) {
      Vec3 sum{0, 0, 0};
      for (std::uint32_t s = body.grid.around_begin[i]; s < body.grid.around_begin[i + 1]; ++s)
        sum = sum + body.slots[body.grid.around[s]];
      f(i, sum);
    }
  });
}

inline void hold(Vec3& v, std::uint8_t held) {
  for (int a = 0; a < 3; ++a)
    if (held >> a & 1) v[a] = 0;
}

}  // namespace

void map_momentum(const Particles& particles, TotalBody& body, int threads) {
  if (body.grid.dimension == 2)
    for_each_cell(body, threads, [&](std::size_t cell) { map_momentum_of_cell<2>(particles, body, cell); });
  else
    for_each_cell(body, threads, [&](std::size_t cell) { map_momentum_of_cell<3>(particles, body, cell); });
}

void find_node_velocities(TotalBody& body, int threads) {
  for_each_node(body, threads, [&](std::size_t i, const Vec3& momentum) {
    body.velocity[i] = body.inverse_mass[i] * momentum;
    hold(body.velocity[i], body.held_now[i]);
  });
}

void advance_nodes(TotalBody& body, const Vec3& gravity, double dt, int threads) {
  for_each_node(body, threads, [&](std::size_t i, const Vec3& force) {
    body.velocity_updated[i] = body.velocity[i] + dt * (body.inverse_mass[i] * force + gravity);
    hold(body.velocity_updated[i], body.held[i]);
  });
}

void advance_particles(Particles& particles, TotalBody& body, double flip, double dt, int threads) {
  if (body.grid.dimension == 2)
    for_each_cell(body, threads, [&](std::size_t cell) { advance_cell<2>(particles, body, flip, dt, cell); });
  else
    for_each_cell(body, threads, [&](std::size_t cell) { advance_cell<3>(particles, body, flip, dt, cell); });
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/transfer.hpp"

#include "solver/core/law_kernels.hpp"
#include "solver/core/transfer_sweep.hpp"

namespace scarp {
namespace {

template <int D>
void map_momentum_of_cell(const Particles& particles, TotalBody& body, std::size_t cell) {
  using Cell = LinearCell<D>;
  typename Cell::Values m, sums[D]{};
  for (std::size_t p = body.grid.cell_begin[cell]; p < body.grid.cell_begin[cell + 1]; ++p) {
    Cell::monomials(body.grid.xi[p - body.begin], m);
    for (int d = 0; d < D; ++d) Cell::add_value(sums[d], m, particles.mass[p] * particles.velocity[p][d]);
  }
  store_corners<D>(sums, &body.slots[cell * Cell::N]);
}

template <int D>
void advance_cell(Particles& particles, TotalBody& body, VelocityUpdate update, double dt, std::size_t cell) {
  using Cell = LinearCell<D>;
  typename Cell::Values updated[D], change[D], m, sums[D]{};
#pragma GCC unroll 8
  for (int k = 0; k < Cell::N; ++k) {
    const std::uint32_t node = body.grid.cell_nodes[cell * Cell::N + k];
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) {
      updated[d][k] = body.velocity_updated[node][d];
      change[d][k] = updated[d][k] - update.less * body.velocity[node][d];
      if (!body.filtered.empty()) change[d][k] += body.filtered[node][d];
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
      v[d] = update.kept * v[d] + Cell::value(change[d], m);
      x[d] += dt * Cell::value(updated[d], m);
      Cell::add_value(sums[d], m, mass * v[d]);
    }
  }
  store_corners<D>(sums, &body.slots[cell * Cell::N]);
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
    body.velocity[i] = free_part(body.inverse_mass[i] * momentum, body.held_now[i]);
  });
}

void advance_nodes(TotalBody& body, const Vec3& gravity, double dt, int threads) {
  for_each_node(body, threads, [&](std::size_t i, const Vec3& force) {
    body.velocity_updated[i] =
        free_part(body.velocity[i] + dt * (body.inverse_mass[i] * force + gravity), body.held[i]);
  });
}

kernels::CellSweep cell_sweep(Particles& particles, TotalBody& body, VelocityUpdate update, double dt) {
  kernels::CellSweep sweep{};
  sweep.particles = arrays_of(particles);
  sweep.xi = body.grid.xi.data()->data();
  sweep.first = body.begin;
  sweep.cell_begin = body.grid.cell_begin.data();
  sweep.cell_nodes = body.grid.cell_nodes.data();
  sweep.slots = body.slots.data()->data();
  sweep.node_velocity = body.velocity.data()->data();
  sweep.node_updated = body.velocity_updated.data()->data();
  sweep.per_cell = 1 / body.grid.cell;
  sweep.dt = dt;
  sweep.kept = update.kept;
  sweep.less = update.less;
  return sweep;
}

void advance_particles(Particles& particles, TotalBody& body, VelocityUpdate update, double dt, int threads) {
  if (body.kernels && body.filtered.empty()) {
    const kernels::CellSweep sweep = cell_sweep(particles, body, update, dt);
    const auto advance = body.kernels->cells.advance[body.grid.dimension - 2];
    return parallel_for(body.tasks.size(), threads,
                        [&](std::size_t t) { advance(sweep, body.tasks[t].begin, body.tasks[t].end); });
  }
  if (body.grid.dimension == 2)
    for_each_cell(body, threads, [&](std::size_t cell) { advance_cell<2>(particles, body, update, dt, cell); });
  else
    for_each_cell(body, threads, [&](std::size_t cell) { advance_cell<3>(particles, body, update, dt, cell); });
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/updated_transfer.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/f_bar.hpp"
#include "solver/core/node_step.hpp"
#include "solver/core/updated_kernels.hpp"
#include "solver/core/updated_window.hpp"
#include "solver/materials/tensor.hpp"

namespace scarp {
namespace {

double volume(const Particles& particles, std::size_t p) {
  return determinant(particles.deformation_gradient[p]) * particles.reference_volume[p];
}

/// sum V s / sum V of the cell, with s as in averaged_stress.hpp; for grids that average.
template <int D>
double cell_mean_stress(const Particles& particles, const UpdatedGrid& grid, std::size_t c) {
  double sum = 0, V_cell = 0;
  for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
    const std::uint32_t p = grid.members[m];
    const double V = volume(particles, p);
    sum += V * mean_stress<D>(particles.stress[p]);
    V_cell += V;
  }
  return sum / V_cell;
}

/// V_p sigma_p, J; where the grid averages, with the cell's mean stress.
template <int D>
Sym6 volume_times_stress(const Particles& particles, const UpdatedGrid& grid, std::size_t p, double cell_mean) {
  const double V = volume(particles, p);
  Sym6 s = grid.averages ? with_mean_stress<D>(particles.stress[p], cell_mean) : particles.stress[p];
  for (double& component : s) component *= V;
  return s;
}

/// a <- a - S g, in the first D components.
template <int D>
void subtract_product(Vec3& a, const Sym6& S, const Vec3& g) {
  if constexpr (D == 2) {
    a[0] -= S[0] * g[0] + S[3] * g[1];
    a[1] -= S[3] * g[0] + S[1] * g[1];
  } else {
    a[0] -= S[0] * g[0] + S[3] * g[1] + S[5] * g[2];
    a[1] -= S[3] * g[0] + S[1] * g[1] + S[4] * g[2];
    a[2] -= S[5] * g[0] + S[4] * g[1] + S[2] * g[2];
  }
}

/// `tile` is that of the cell's block.
template <int D, class S>
void map_cell(const Particles& particles, const UpdatedGrid& grid, std::size_t c, NodeSums* tile) {
  NodeSums* const window = tile + grid.first_in_tile[c];
  const double cell_mean = grid.averages ? cell_mean_stress<D>(particles, grid, c) : 0;
  for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
    const std::uint32_t p = grid.members[m];
    const double mass = particles.mass[p];
    const Vec3 momentum = mass * particles.velocity[p];
    const Sym6 stress = volume_times_stress<D>(particles, grid, p, cell_mean);
    WindowWeights<D, S>(grid, c, m).each([&](int k, double phi, const Vec3& gradient) {
      NodeSums& sums = window[in_tile<D, S>(k)];
      sums.mass += phi * mass;
      for (int d = 0; d < D; ++d) sums.momentum[d] += phi * momentum[d];
      subtract_product<D>(sums.force, stress, gradient);
    });
  }
}

template <int D, class S>
void map_forces_of_cell(const Particles& particles, const UpdatedGrid& grid, std::size_t c, NodeSums* tile) {
  NodeSums* const window = tile + grid.first_in_tile[c];
  const double cell_mean = grid.averages ? cell_mean_stress<D>(particles, grid, c) : 0;
  for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
    const Sym6 stress = volume_times_stress<D>(particles, grid, grid.members[m], cell_mean);
    WindowWeights<D, S>(grid, c, m).each([&](int k, double, const Vec3& gradient) {
      subtract_product<D>(window[in_tile<D, S>(k)].force, stress, gradient);
    });
  }
}

/// The largest |v_p|^2.
template <int D, class S>
double advance_cell(Particles& particles, const UpdatedGrid& grid, VelocityUpdate update, double dt, std::size_t b,
                    std::size_t c, std::array<double, 4>* tile) {
  constexpr int window = kWindow<D, S>;
  Vec3 updated[window], change[window];
  std::array<double, 4>* const sums = tile + grid.first_in_tile[c];
  for (int k = 0; k < window; ++k) {
    const std::uint32_t node = window_node<D, S>(grid, b, c, k);
    updated[k] = grid.velocity_updated[node];
    change[k] = updated[k] - update.less * grid.velocity[node];
    if (!grid.filtered.empty()) change[k] = change[k] + grid.filtered[node];
  }
  double fastest = 0;
  for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
    const std::uint32_t p = grid.members[m];
    const WindowWeights<D, S> weights(grid, c, m);
    Vec3 gain{0, 0, 0}, carried{0, 0, 0};
    weights.each_value([&](int k, double phi) {
      for (int d = 0; d < D; ++d) {
        gain[d] += phi * change[k][d];
        carried[d] += phi * updated[k][d];
      }
    });
    Vec3& v = particles.velocity[p];
    v = update.kept * v + gain;
    particles.position[p] = particles.position[p] + dt * carried;
    fastest = std::max(fastest, dot(v, v));
    const Vec3 mv = particles.mass[p] * v;
    weights.each_value([&](int k, double phi) {
      for (int d = 0; d < D; ++d) sums[in_tile<D, S>(k)][d] += phi * mv[d];
    });
  }
  return fastest;
}

/// The tiles to the nodes' sums by a kernel, like for_each_tile_node.
template <class Kernel, class Sums>
void add_tiles(UpdatedGrid& grid, Kernel add, const std::vector<Sums>& tiles, int threads) {
  const std::size_t tile = grid.tile();
  for (const auto& colour : grid.colours)
    parallel_for(colour.size(), threads, [&](std::size_t i) {
      const std::size_t begin = colour[i] * tile;
      add(reinterpret_cast<const double*>(&tiles[begin]), &grid.tile_nodes[begin], tile,
          reinterpret_cast<double*>(grid.sums.data()));
    });
}

}  // namespace

void add_momentum_tiles(UpdatedGrid& grid, int threads) {
  if (grid.kernels) return add_tiles(grid, grid.kernels->particles.add_momenta, grid.momentum_tiles, threads);
  for_each_tile_node(grid, threads, [&](std::uint32_t node, std::size_t t) {
    for (int d = 0; d < 3; ++d) grid.sums[node].momentum[d] += grid.momentum_tiles[t][d];
  });
}

void map_to_nodes(Particles& particles, UpdatedGrid& grid, int threads) {
  const kernels::ParticleSweep sweep = particle_sweep(particles, grid, {}, 0);
  const auto clear = [](NodeSums& sums) { sums = {}; };
  map_blocks(
      grid, grid.tiles, threads,
      [&]<int D, class S>(std::size_t b, NodeSums* tile) {
        if (grid.kernels && !grid.averages)
          return grid.kernels->particles.map[plane_or_space(grid)][shape_index(grid)](sweep, cells_of(grid, b, tile));
        for (std::size_t c = grid.block_begin[b]; c < grid.block_begin[b + 1]; ++c)
          map_cell<D, S>(particles, grid, c, tile);
      },
      clear);
  for_each_updated_node(grid, threads, [&](std::size_t i) { clear(grid.sums[i]); });
  if (grid.kernels) return add_tiles(grid, grid.kernels->particles.add_tile, grid.tiles, threads);
  for_each_tile_node(grid, threads, [&](std::uint32_t node, std::size_t t) {
    NodeSums& sums = grid.sums[node];
    const NodeSums& more = grid.tiles[t];
    sums.mass += more.mass;
    for (int d = 0; d < 3; ++d) sums.momentum[d] += more.momentum[d];
    for (int d = 0; d < 3; ++d) sums.force[d] += more.force[d];
  });
}

void map_forces(const Particles& particles, UpdatedGrid& grid, int threads) {
  const auto clear = [](NodeSums& sums) { sums.force = {0, 0, 0}; };
  map_blocks(
      grid, grid.tiles, threads,
      [&]<int D, class S>(std::size_t b, NodeSums* tile) {
        for (std::size_t c = grid.block_begin[b]; c < grid.block_begin[b + 1]; ++c)
          map_forces_of_cell<D, S>(particles, grid, c, tile);
      },
      clear);
  for_each_updated_node(grid, threads, [&](std::size_t i) { clear(grid.sums[i]); });
  for_each_tile_node(grid, threads, [&](std::uint32_t node, std::size_t t) {
    grid.sums[node].force = grid.sums[node].force + grid.tiles[t].force;
  });
}

void add_particle_forces(UpdatedGrid& grid, const std::vector<Vec3>& force, int threads) {
  map_vectors(
      grid, threads, [&](std::uint32_t p) { return force[p]; },
      [&](std::uint32_t node, const Vec3& sum) { grid.sums[node].force = grid.sums[node].force + sum; });
}

void find_node_velocities(UpdatedGrid& grid, int threads) {
  for_each_updated_node(grid, threads, [&](std::size_t i) {
    const NodeSums& sum = grid.sums[i];
    grid.mass[i] = sum.mass;
    grid.velocity[i] = sum.mass > 0 ? free_part((1 / sum.mass) * sum.momentum, grid.held_now[i]) : Vec3{0, 0, 0};
  });
}

void advance_nodes(UpdatedGrid& grid, const Vec3& gravity, double dt, int threads) {
  for_each_updated_node(grid, threads, [&](std::size_t i) {
    const NodeSums& sum = grid.sums[i];
    grid.velocity_updated[i] =
        sum.mass > 0 ? grid.velocity[i] + dt * ((1 / sum.mass) * sum.force + gravity) : Vec3{0, 0, 0};
    grid.velocity_updated[i] = free_part(grid.velocity_updated[i], grid.held[i]);
  });
}

double advance_particles(Particles& particles, UpdatedGrid& grid, VelocityUpdate update, double dt, int threads) {
  grid.task_maxima.assign(grid.blocks.size(), 0);
  const kernels::ParticleSweep sweep = particle_sweep(particles, grid, update, dt);
  map_blocks(
      grid, grid.momentum_tiles, threads,
      [&]<int D, class S>(std::size_t b, std::array<double, 4>* tile) {
        double& fastest = grid.task_maxima[b];
        if (grid.kernels && grid.filtered.empty())
          fastest =
              grid.kernels->particles.advance[plane_or_space(grid)][shape_index(grid)](sweep, cells_of(grid, b, tile));
        else
          for (std::size_t c = grid.block_begin[b]; c < grid.block_begin[b + 1]; ++c)
            fastest = std::max(fastest, advance_cell<D, S>(particles, grid, update, dt, b, c, tile));
      },
      [](std::array<double, 4>& momentum) { momentum = {}; });
  for_each_updated_node(grid, threads, [&](std::size_t i) { grid.sums[i].momentum = {0, 0, 0}; });
  add_momentum_tiles(grid, threads);
  double fastest = 0;
  for (double v2 : grid.task_maxima) fastest = std::max(fastest, v2);
  return std::sqrt(fastest);
}

void take_updated_velocities(UpdatedGrid& grid, int threads) {
  parallel_for(grid.nodes.size(), threads, [&](std::size_t i) {
    if (grid.mass[i] > grid.light_mass) grid.velocity[i] = grid.velocity_updated[i];
  });
}

}  // namespace scarp

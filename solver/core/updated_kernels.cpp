// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/updated_kernels.hpp"

#include "solver/kernels/choose_kernels.hpp"
#include "solver/materials/tensor.hpp"

namespace scarp {
namespace {

/// Lanes that the particles of all cells take, filled or not.
std::size_t lanes_taken(const UpdatedGrid& grid, int lanes) {
  std::size_t taken = 0;
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    taken += (grid.cell_begin[c + 1] - grid.cell_begin[c] + lanes - 1) / lanes * lanes;
  return taken;
}

}  // namespace

void use_kernels(UpdatedGrid& grid, const Particles& particles, const kernels::Kernels& widest) {
  grid.kernels = &widest;
  for (const kernels::Kernels& narrower : kernels::available_kernels())
    if (narrower.lanes < grid.kernels->lanes &&
        lanes_taken(grid, narrower.lanes) < 0.8 * static_cast<double>(lanes_taken(grid, grid.kernels->lanes)))
      grid.kernels = &narrower;
  grid.volume.assign(particles.size(), 0);
  for (std::uint32_t p : grid.particles)
    grid.volume[p] = determinant(particles.deformation_gradient[p]) * particles.reference_volume[p];
  grid.one_material = particles.material[grid.particles.front()];
  for (std::uint32_t p : grid.particles)
    if (particles.material[p] != grid.one_material) grid.one_material = -1;
}

kernels::ParticleSweep particle_sweep(Particles& particles, UpdatedGrid& grid, VelocityUpdate update, double dt) {
  kernels::ParticleSweep sweep;
  sweep.particles = {particles.position.data()->data(),
                     particles.velocity.data()->data(),
                     particles.deformation_gradient.data()->data(),
                     particles.stress.data()->data(),
                     particles.elastic_left_cauchy_green.data()->data(),
                     particles.equivalent_plastic_strain.data(),
                     particles.plastic_work.data(),
                     grid.volume.data(),
                     particles.mass.data(),
                     particles.reference_volume.data(),
                     grid.xi.data()->data(),
                     grid.half_edge.data()};
  sweep.velocity = grid.velocity.data()->data();
  sweep.velocity_updated = grid.velocity_updated.data()->data();
  sweep.per_cell = 1 / grid.cell;
  for (int a = 0; a < 3; ++a) sweep.cell_count[a] = grid.cell_count[a];
  sweep.kept = update.kept;
  sweep.less = update.less;
  sweep.dt = dt;
  return sweep;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/updated_kernels.hpp"

#include "solver/core/law_kernels.hpp"
#include "solver/materials/tensor.hpp"

namespace scarp {
void use_kernels(UpdatedGrid& grid, const Particles& particles, const kernels::Kernels& widest) {
  grid.kernels = &best_filled(grid.cell_begin, widest);
  grid.volume.assign(particles.size(), 0);
  for (std::uint32_t p : grid.particles)
    grid.volume[p] = determinant(particles.deformation_gradient[p]) * particles.reference_volume[p];
  grid.one_material = particles.material[grid.particles.front()];
  for (std::uint32_t p : grid.particles)
    if (particles.material[p] != grid.one_material) grid.one_material = -1;
}

kernels::ParticleSweep particle_sweep(Particles& particles, UpdatedGrid& grid, VelocityUpdate update, double dt) {
  kernels::ParticleSweep sweep;
  sweep.particles = arrays_of(particles);
  sweep.volume = grid.volume.data();
  sweep.xi = grid.xi.data()->data();
  sweep.half_edge = grid.half_edge.data();
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

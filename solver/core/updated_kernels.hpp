// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "solver/core/updated_grid.hpp"
#include "solver/core/updated_stress.hpp"
#include "solver/core/velocity_update.hpp"
#include "solver/kernels/kernels.hpp"

namespace scarp {

/// Lets the sweeps over the particles of `grid` run on kernels: those of the widest packs up to `widest` that its
/// cells fill best. Without it they run particle by particle, which is the oracle of the kernels. The particles' F
/// must be those of the start.
void use_kernels(UpdatedGrid& grid, const Particles& particles, const kernels::Kernels& widest);

/// What the kernels see of particles and grid.
kernels::ParticleSweep particle_sweep(Particles& particles, UpdatedGrid& grid, VelocityUpdate update, double dt);
/// The cells of one block, whose tile is of NodeSums or, where a sweep maps momenta only, of four numbers.
template <class Sums>
kernels::CellRange cells_of(const UpdatedGrid& grid, std::size_t block, Sums* tile) {
  static_assert(sizeof(Sums) % (4 * sizeof(double)) == 0 && sizeof(NodeSums) == 8 * sizeof(double));
  return {grid.block_begin[block],
          grid.block_begin[block + 1],
          reinterpret_cast<const std::int32_t(*)[3]>(grid.cells.data()),
          grid.cell_begin.data(),
          grid.first_in_tile.data(),
          grid.members.data(),
          &grid.tile_nodes[block * grid.tile()],
          reinterpret_cast<double*>(tile)};
}

/// Index of the grid's dimension and shape in the tables of kernels.
inline int plane_or_space(const UpdatedGrid& grid) { return grid.dimension - 2; }
inline int shape_index(const UpdatedGrid& grid) { return static_cast<int>(grid.shape); }

/// Of cell c: index of the one material of its particles, or -1.
inline std::int32_t material_of(const UpdatedGrid& grid, const Particles& particles, std::size_t c) {
  const std::int32_t first = particles.material[grid.members[grid.cell_begin[c]]];
  for (std::size_t m = grid.cell_begin[c] + 1; m < grid.cell_begin[c + 1]; ++m)
    if (particles.material[grid.members[m]] != first) return -1;
  return first;
}

/// Of the cells of a block: deforms those whose particles have one law that has a kernel, and calls
/// rest(first, last) for runs of the others.
template <class F>
void deform_block(const UpdatedGrid& grid, const kernels::ParticleSweep& sweep, const Particles& particles,
                  std::size_t block, UpdatedOutcome& outcome, F&& rest) {
  const auto& laws = grid.law_parameters;
  const std::uint32_t end = grid.block_begin[block + 1];
  kernels::DeformResult result;
  for (std::uint32_t c = grid.block_begin[block]; c < end;) {
    const std::int32_t material = grid.one_material >= 0 ? grid.one_material : material_of(grid, particles, c);
    std::uint32_t next = grid.one_material >= 0 ? end : c + 1;
    if (grid.one_material < 0)
      while (next < end && material_of(grid, particles, next) == material) ++next;
    if (material >= 0 && laws[material]) {
      kernels::CellRange range = cells_of<NodeSums>(grid, block, nullptr);
      range.begin = c;
      range.end = next;
      const int kind = static_cast<int>(laws[material]->kind);
      grid.kernels->particles.deform[kind][plane_or_space(grid)][shape_index(grid)](sweep, range, *laws[material],
                                                                                    result);
    } else {
      rest(c, next);
    }
    c = next;
  }
  note(outcome, result.largest_speed_squared, 0);
  if (result.bad_particle >= 0) note(outcome, -1, static_cast<std::size_t>(result.bad_particle));
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels of the total-Lagrangian method work on where particles carry their state. Lanes are the particles of
// one cell, which stand side by side in the model; they share the cell's nodes, and what they give to its corners is
// summed over the lanes into the cell's slots (solver/core/reference_grid.hpp). Linear shape functions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/kernels/particles.hpp"

namespace scarp::kernels {

/// A sweep over the cells of a body.
struct CellSweep {
  ParticleArrays particles;
  const double* xi;                 ///< place in the cell, three each, from the body's first particle on
  std::size_t first = 0;            ///< that particle
  const std::size_t* cell_begin;    ///< range of a cell in the model's particles
  const std::uint32_t* cell_nodes;  ///< 2^D per cell
  double* slots;                    ///< three per cell and corner
  const double* node_velocity;      ///< v_I, three per node
  const double* node_updated;       ///< v~_I
  double per_cell = 0;              ///< 1 / edge, 1/m
  double dt = 0;
  double kept = 1, less = 1;  ///< v_p <- kept v_p + sum phi (v~_I - less v_I)
  bool find_speed = true;     ///< whether to look for the largest wave speed
};

/// What a sweep that deforms found.
struct CellResult {
  double largest_speed_squared = 0;  ///< of the mean over each cell of c^2, in the reference configuration
  std::int64_t bad_particle = -1;    ///< the first with J <= 0 or something not finite
};

struct CellKernels {
  /// v and x of the particles of cells [begin, end), and their momenta to the slots. [D - 2]
  void (*advance[2])(const CellSweep&, std::size_t begin, std::size_t end);
  /// F, history and stress of particles that all have the law, and their forces to the slots. [law][D - 2]
  void (*deform[kLawKinds][2])(const CellSweep&, std::size_t begin, std::size_t end, const LawParameters&, CellResult&);
};

}  // namespace scarp::kernels

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/model/solver_options.hpp"

namespace scarp {

/// What a cell gives to a function of its window, and what a node has in all.
struct NodeSums {
  double mass = 0;         ///< kg
  Vec3 momentum{0, 0, 0};  ///< kg m/s
  Vec3 force{0, 0, 0};     ///< N
};

/// What the search for cells found in a block of particles.
struct KeyBlock {
  std::size_t outside = std::numeric_limits<std::size_t>::max();  ///< first entry of `particles` outside the grid
  bool changed = false;                                           ///< some particle is in another cell than before
};

/// The one grid of all updated-Lagrangian bodies: the domain's lattice. "Node" is a shape function, whether or not
/// it interpolates; a cell's window is the width^dimension functions that do not vanish on it, of index cell to
/// cell + width - 1 on each axis (solver/shapes/shape.hpp).
///
/// Only cells that hold particles, and the nodes of their windows, are kept, found anew after each step in the
/// order of the particles. Cells write into slots of their own, and nodes add up the slots of the cells around them
/// in a fixed order: no atomics, and the same bits for any number of threads. Nothing is allocated once the buffers
/// have grown.
struct UpdatedGrid {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  int dimension = 3;
  ShapeFunction shape = ShapeFunction::linear;
  int width = 2;  ///< functions of a window per axis
  double cell = 0;
  Vec3 origin{0, 0, 0};
  std::array<std::int32_t, 3> cell_count{1, 1, 1};  ///< of the lattice, per axis
  std::array<std::int32_t, 3> node_count{1, 1, 1};
  double light_mass = 0;  ///< kg; 1e-10 of a full cell of the densest particle

  std::vector<std::uint32_t> particles;  ///< those of updated-Lagrangian bodies, ascending
  std::vector<double> half_edge;         ///< per particle of the model, in cells; only where the shape has_size
  std::vector<std::uint8_t>
      held_by_set;  ///< per node of the lattice, axes held by NodeSets; empty where there are none
  std::array<std::uint8_t, 6> held_by_face{};  ///< axes, bit 0 for x to bit 2 for z
  std::uint64_t placings = 0;                  ///< how often the occupied cells have changed

  std::vector<std::uint32_t> cell_of_lattice;  ///< per cell of the lattice: index into cells, or kNone
  std::vector<std::uint32_t> node_of_lattice;  ///< per node of the lattice: index into nodes, or kNone
  std::vector<std::uint32_t> cell_keys;        ///< per entry of `particles`: its cell of the lattice, or kNone
  std::vector<KeyBlock> key_blocks;

  // Of occupied cells:
  std::vector<std::array<std::int32_t, 3>> cells;
  std::vector<std::size_t> cell_begin;  ///< cells + 1: range of a cell in `members`
  std::vector<std::uint32_t> members;   ///< particles by cell, within a cell ascending
  std::vector<Vec3> xi;                 ///< per member: place in its cell
  std::vector<NodeSums> slots;          ///< per cell and function of its window

  // Of their nodes:
  std::vector<std::array<std::int32_t, 3>> nodes;
  std::vector<std::uint8_t> held;      ///< axes held for good
  std::vector<std::uint8_t> held_now;  ///< these, and what act_on_nodes adds until the particles are placed anew
  std::vector<double> mass;            ///< m_I, kg
  std::vector<Vec3> velocity;          ///< v_I, of the momentum mapped last
  std::vector<Vec3> velocity_updated;  ///< v~_I

  std::vector<Mat3> affine;          ///< C_p of apic.hpp, per particle of the model; empty with another transfer
  std::vector<Vec3> filtered, term;  ///< per node v*_I of xpic.hpp and the term of it found last; empty likewise
  std::vector<std::uint8_t> kept;    ///< axes of xpic.hpp's conditions

  std::vector<double> task_maxima;  ///< of a sweep

  bool averages = false;    ///< see average_volumes
  std::vector<Mat3> trial;  ///< per member where it averages: I + dt L

  int window() const { return dimension == 2 ? width * width : width * width * width; }
  std::size_t lattice_cell(const std::array<std::int32_t, 3>& c) const {
    return (static_cast<std::size_t>(c[2]) * cell_count[1] + c[1]) * cell_count[0] + c[0];
  }
  std::size_t lattice_node(const std::array<std::int32_t, 3>& n) const {
    return (static_cast<std::size_t>(n[2]) * node_count[1] + n[1]) * node_count[0] + n[0];
  }
};

/// The grid with its particles placed.
/// @throws Error ("solve") where the domain is not made of whole cells or has too many, a particle lies outside it or
///         is too large for its shape function, or a NodeSet
///         belongs to a lattice other than the domain's.
UpdatedGrid make_updated_grid(const Model& model, ShapeFunction shape, int threads);

/// Finds each particle's cell, the occupied cells and their nodes at the particles' present positions.
/// @return the first particle that lies outside the grid, or -1. If there is one, nothing else has been done.
std::int64_t place_particles(UpdatedGrid& grid, const Particles& particles, int threads);

/// From now on the laws see F-bar, see averaged_stress.hpp: each step's increment has the mean change of volume of the
/// cell that the particle lies in (Coombs, Charlton, Cortis, Augarde 2018 for MPM).
void average_volumes(UpdatedGrid& grid);

/// Of the occupied nodes, m: where their functions stand (Shape::place).
std::vector<Vec3> node_positions(const UpdatedGrid& grid);

/// Of all its arrays.
double memory_bytes(const UpdatedGrid& grid);

}  // namespace scarp

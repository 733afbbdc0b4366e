// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "solver/kernels/kernels.hpp"
#include "solver/model/model.hpp"
#include "solver/model/solver_options.hpp"

namespace scarp {

/// What the particles of a block, or all of them, give to a node. A line of the cache, and a register of the widest
/// kernels.
struct alignas(64) NodeSums {
  double mass = 0;         ///< kg
  Vec3 momentum{0, 0, 0};  ///< kg m/s
  Vec3 force{0, 0, 0};     ///< N
  double unused = 0;
};

/// What the search for cells found in a block of particles.
using KeyBlock = kernels::PlaceResult;

/// What a stress sweep found among the particles of updated-Lagrangian bodies.
struct UpdatedOutcome {
  double largest_wave_speed_squared = 0;  ///< (m/s)^2, in the current configuration
  std::int64_t bad_particle = -1;         ///< the first with J <= 0 or something not finite; -1 if all is well
};

/// Bodies whose particles share nodes: one velocity, where they meet they stick.
struct UpdatedField {
  std::vector<std::int32_t> bodies;  ///< index into Model::bodies
  std::size_t begin = 0, end = 0;    ///< range in UpdatedGrid::particles
  std::uint32_t node_begin = 0, node_end = 0;
  std::vector<std::uint8_t>
      held_by_set;  ///< per node of the lattice, axes held by NodeSets; empty where there are none
};

/// The grid of all updated-Lagrangian bodies: the domain's lattice. "Node" is a shape function, whether or not
/// it interpolates; a cell's window is the width^dimension functions that do not vanish on it, of index cell to
/// cell + width - 1 on each axis (solver/shapes/shape.hpp).
///
/// All bodies are one field, or each is a field of its own (contact.method = "grid"): then a place of the lattice has
/// a cell, a block and a node for each field that is there, and sweeps go over the blocks of all fields alike.
///
/// Only cells that hold particles, and the nodes of their windows, are kept, found anew after each step. Cells stand
/// in blocks of 64, 4 x 4 x 4 or 8 x 8 of the lattice; a block adds up what its particles give in a tile of its own,
/// which holds the windows of all its cells, and tiles are added to the nodes colour by colour, no two blocks of a
/// colour side by side: no atomics, and the same bits for any number of threads. Nothing is allocated once the
/// buffers have grown.
struct UpdatedGrid {
  static constexpr std::uint32_t kNone = kernels::kNoNode;

  int dimension = 3;
  ShapeFunction shape = ShapeFunction::linear;
  int width = 2;  ///< functions of a window per axis
  double cell = 0;
  Vec3 origin{0, 0, 0};
  std::array<std::int32_t, 3> cell_count{1, 1, 1};  ///< of the lattice, per axis
  std::array<std::int32_t, 3> node_count{1, 1, 1};
  double light_mass = 0;  ///< kg; 1e-10 of a full cell of the densest particle

  std::vector<std::uint32_t> particles;        ///< those of updated-Lagrangian bodies, ascending
  std::vector<double> half_edge;               ///< per particle of the model, in cells; only where the shape has_size
  std::vector<UpdatedField> fields;            ///< ascending in particles, blocks and nodes
  std::array<std::uint8_t, 6> held_by_face{};  ///< axes, bit 0 for x to bit 2 for z
  std::uint64_t placings = 0;                  ///< how often the occupied cells have changed

  static constexpr int kBlockCells = 64;
  int block_edge = 4;                                ///< cells of a block per axis
  int tile_edge = 5;                                 ///< functions of a tile per axis: block_edge + width - 1
  std::array<std::int32_t, 3> block_count{1, 1, 1};  ///< of the lattice, per axis

  std::vector<std::uint32_t> block_of_lattice;  ///< per field and block of the lattice: index into blocks, or kNone
  std::vector<std::uint32_t> node_of_lattice;  ///< per node of the lattice: index into the last field's nodes, or kNone
  std::vector<std::uint32_t> cell_keys;        ///< per entry of `particles`: lattice_block x 64 + cell in it, or kNone
  std::vector<Vec3> xi;                        ///< per particle of the model: place in its cell
  std::vector<KeyBlock> key_blocks;

  // Of occupied blocks:
  std::vector<std::array<std::int32_t, 3>> blocks;
  std::vector<std::uint32_t> block_field;  ///< per block: its field
  std::vector<std::uint32_t> counts;       ///< per block and cell in it: where its members end; before, how many
  std::vector<std::uint32_t> block_begin;  ///< blocks + 1: range of a block in `cells`
  std::vector<std::uint32_t> tile_nodes;   ///< per block and function of its tile: index into nodes, or kNone
  std::vector<std::array<double, 4>>
      momentum_tiles;           ///< the same of a sweep that maps momenta only; the last is unused
  std::vector<NodeSums> tiles;  ///< per block and function of its tile
  std::array<std::vector<std::uint32_t>, 8> colours;  ///< blocks by the parity of their place

  // Of occupied cells, by block:
  std::vector<std::array<std::int32_t, 3>> cells;
  std::vector<std::uint32_t> cell_begin;     ///< cells + 1: range of a cell in `members`
  std::vector<std::uint32_t> first_in_tile;  ///< first function of the cell's window in the tile of its block
  std::vector<std::uint32_t> occupied, occupied_before;  ///< keys of the cells
  std::vector<std::uint32_t> members;                    ///< particles by cell, within a cell ascending

  // Of their nodes:
  std::vector<std::array<std::int32_t, 3>> nodes;
  std::vector<std::uint8_t> held;      ///< axes held for good
  std::vector<std::uint8_t> held_now;  ///< these, and what act_on_nodes adds until the particles are placed anew
  std::vector<NodeSums> sums;          ///< of all tiles
  std::vector<double> mass;            ///< m_I, kg
  std::vector<Vec3> velocity;          ///< v_I, of the momentum mapped last
  std::vector<Vec3> velocity_updated;  ///< v~_I

  std::vector<Mat3> affine;          ///< C_p of apic.hpp, per particle of the model; empty with another transfer
  std::vector<Vec3> filtered, term;  ///< per node v*_I of xpic.hpp and the term of it found last; empty likewise
  std::vector<std::uint8_t> kept;    ///< axes of xpic.hpp's conditions

  std::vector<double> task_maxima;            ///< of a sweep
  std::vector<UpdatedOutcome> task_outcomes;  ///< of a sweep over stresses

  // Of use_kernels:
  const kernels::Kernels* kernels = nullptr;                          ///< what sweeps run on, or none
  std::vector<std::optional<kernels::LawParameters>> law_parameters;  ///< per material, those that have a kernel
  std::int32_t one_material = -1;                                     ///< of all particles, or -1
  std::vector<double> volume;                                         ///< per particle of the model: J V0

  bool averages = false;    ///< see average_volumes
  std::vector<Mat3> trial;  ///< per member where it averages: I + dt L

  int window() const { return dimension == 2 ? width * width : width * width * width; }
  std::size_t tile() const {
    return static_cast<std::size_t>(tile_edge) * tile_edge * (dimension == 2 ? 1 : tile_edge);
  }
  std::size_t lattice_blocks() const {
    return static_cast<std::size_t>(block_count[0]) * block_count[1] * block_count[2];
  }
  std::size_t lattice_block(std::size_t field, const std::array<std::int32_t, 3>& b) const {
    return ((field * block_count[2] + b[2]) * block_count[1] + b[1]) * block_count[0] + b[0];
  }
  std::size_t lattice_node(const std::array<std::int32_t, 3>& n) const {
    return (static_cast<std::size_t>(n[2]) * node_count[1] + n[1]) * node_count[0] + n[0];
  }
};

inline std::size_t field_of_node(const UpdatedGrid& grid, std::uint32_t node) {
  std::size_t f = 0;
  while (node >= grid.fields[f].node_end) ++f;
  return f;
}

/// The grid with its particles placed; a field for each body where Model::contact asks for it.
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

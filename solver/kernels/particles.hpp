// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels of the updated-Lagrangian method work on. Lanes are the particles of one cell: they share the nodes
// of its window, whose velocities are broadcast, and what they give to a node is summed over the lanes at once, for
// all that a node gets (solver/core/updated_grid.hpp). Fields stand as solver/model/particles.hpp has them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/kernels/nodal.hpp"

namespace scarp::kernels {

/// Shape functions, see solver/shapes.
enum class Shape : std::uint8_t { linear, quadratic_bspline, gimp };
inline constexpr int kShapes = 3;

/// Cells of a block per axis: 64 in all, 4 x 4 x 4 or 8 x 8.
constexpr int block_edge(int dimension) { return dimension == 2 ? 8 : 4; }

/// In place of a node's index where a tile's function has none.
inline constexpr std::uint32_t kNoNode = 0xffffffffu;

/// Fields of the model's particles: 3, 9 or 6 (xx, yy, zz, xy, yz, xz) doubles each, or one.
struct ParticleArrays {
  double* position;
  double* velocity;
  double* deformation_gradient;
  double* stress;                     ///< Cauchy
  double* elastic_left_cauchy_green;  ///< b_e
  double* plastic_strain;
  double* plastic_work;
  const double* mass;
  const double* reference_volume;
};

/// A sweep over particles.
struct ParticleSweep {
  ParticleArrays particles;
  double* volume = nullptr;                  ///< J V0, as the last sweep that moved particles left it
  const double* xi = nullptr;                ///< place in the cell, three each
  const double* half_edge = nullptr;         ///< in cells; GIMP
  const double* velocity = nullptr;          ///< v_I, three per node
  const double* velocity_updated = nullptr;  ///< v~_I
  double per_cell = 0;                       ///< 1 / edge, 1/m
  std::int32_t cell_count[3] = {1, 1, 1};    ///< of the lattice
  double kept = 1, less = 1;                 ///< v_p <- kept v_p + sum phi (v~_I - less v_I)
  double dt = 0;
};

/// Occupied cells of one block of the grid.
struct CellRange {
  std::uint32_t begin, end;
  const std::int32_t (*cells)[3];      ///< place of each cell in the lattice
  const std::uint32_t* cell_begin;     ///< range of a cell in `members`
  const std::uint32_t* first_in_tile;  ///< first function of its window in the tile
  const std::uint32_t* members;        ///< particles
  const std::uint32_t* tile_nodes;     ///< per function of the block's tile: its node
  double*
      tile;  ///< per function of the block's tile: mass, momentum, force, 0; where momenta alone are mapped these, 0
};

/// What a sweep that deforms particles found.
struct DeformResult {
  double largest_speed_squared = 0;  ///< c^2 in the current configuration
  std::int64_t bad_particle = -1;    ///< the first with J <= 0 or something not finite
};

/// The lattice in which particles are placed, in blocks of 64 cells.
struct PlaceSweep {
  const double* position;   ///< three per particle of the model, m
  const double* half_edge;  ///< per particle of the model, or none where particles have no size
  double* xi;               ///< three per particle of the model
  std::uint32_t* keys;      ///< per entry of the list of particles: block of field and lattice x 64 + cell in it
  double origin[3];
  double per_cell;
  double slack, inside;  ///< in cells: how far outside a centre may be; how far from its faces a place is kept
  std::int32_t cell_count[3];
  std::int32_t block_count[3];
  double field;  ///< blocks of the lattice are counted field by field
};

struct PlaceResult {
  std::size_t outside = static_cast<std::size_t>(-1);  ///< first entry outside the lattice
  bool changed = false;                                ///< some entry is in another cell than before
};

struct ParticleKernels {
  /// Finds cells and places of the particles [begin, end) of a list. [D - 2]
  void (*place[2])(const PlaceSweep&, const std::uint32_t* particles, std::size_t begin, std::size_t end, PlaceResult&);
  /// Adds the functions of a tile that have a node to the nodes' sums, eight numbers each; or of momenta, four each,
  /// to the momenta.
  void (*add_tile)(const double* tile, const std::uint32_t* nodes, std::size_t count, double* sums);
  void (*add_momenta)(const double* tile, const std::uint32_t* nodes, std::size_t count, double* sums);
  /// Adds phi m, phi m v and - V sigma grad phi to the tile. [D - 2][shape]
  void (*map[2][kShapes])(const ParticleSweep&, const CellRange&);
  /// v and x of the particles, and phi m v to the tile's momentum. The largest |v|^2.
  double (*advance[2][kShapes])(const ParticleSweep&, const CellRange&);
  /// F, history, stress and volume of particles that all have the law. [law][D - 2][shape]
  void (*deform[kLawKinds][2][kShapes])(const ParticleSweep&, const CellRange&, const LawParameters&, DeformResult&);
};

}  // namespace scarp::kernels

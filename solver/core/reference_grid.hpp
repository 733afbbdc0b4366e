// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "solver/model/model.hpp"

namespace scarp {

using LatticeIndex = std::array<std::int32_t, 3>;

/// A body's grid in its reference configuration: only the cells that hold particles and the nodes of these,
/// each sorted lexicographically (x fastest). In a total-Lagrangian body it does not change, but where its reference
/// configuration moves (moving_reference.hpp).
///
/// Cells write what they give to their corners into `corner` slots of their own, and nodes add up the slots
/// of the cells around them in a fixed order: no atomics, and the same bits for any number of threads.
struct ReferenceGrid {
  int dimension = 3;
  double cell = 0;                          ///< edge, m
  Vec3 origin{0, 0, 0};                     ///< of the lattice, m
  std::vector<LatticeIndex> cells;          ///< lattice index of the lower corner
  std::vector<LatticeIndex> nodes;          ///< lattice index
  std::vector<std::size_t> cell_begin;      ///< cells + 1: range of a cell in Model::particles
  std::vector<std::uint32_t> cell_nodes;    ///< corners() per cell: index into nodes
  std::vector<std::uint32_t> around_begin;  ///< nodes + 1: range of a node in `around`
  std::vector<std::uint32_t> around;        ///< slots (cell * corners() + corner) that give to the node, ascending
  std::vector<Vec3> xi;                     ///< per particle of the body: place in its cell, 0 to 1; may be empty
  std::vector<double> node_mass;            ///< m_I = sum phi_Ip m_p, kg; constant in time

  int corners() const { return 1 << dimension; }

  /// Place of a particle in its cell: xi, or where that is empty found from its reference position X.
  /// @param in_body  index within the body
  Vec3 place(std::size_t cell_index, std::size_t in_body, const Vec3& X) const {
    return xi.empty() ? place_of(cell_index, X) : xi[in_body];
  }
  Vec3 place_of(std::size_t cell_index, const Vec3& X) const {
    Vec3 found{0, 0, 0};
    for (int a = 0; a < dimension; ++a)
      found[a] = std::clamp((X[a] - origin[a]) / cell - cells[cell_index][a], 0.0, 1.0);
    return found;
  }
};

/// Groups each body's particles by cell, within a cell by material, else in the order of their ids, those of
/// updated-Lagrangian bodies by block of cells first; leaves them alone where they already stand so. Their ids keep
/// their identity.
/// @throws Error ("solve") where a particle lies outside its body's lattice.
void sort_by_cell(Model& model);
/// The same of one body, on its lattice as given, for particles where they are now.
void sort_by_current_cell(Model& model, const Body& body);

/// Of the reference positions.
/// @throws Error ("solve") where a particle lies outside the lattice, or so close to a corner of its cell that a
///         node would get no mass.
/// @param keep_places  whether to fill xi
ReferenceGrid build_reference_grid(const Model& model, const Body& body, bool keep_places = true);
/// Of the positions as they are now, sorted so. Particles are weighed a thousandth of a cell inside their cells at
/// least, so that each node has mass, wherever they are.
/// @throws Error ("solve") where a particle lies outside the lattice.
ReferenceGrid build_current_grid(const Model& model, const Body& body);

/// How many cells and nodes build_reference_grid would keep.
struct GridCounts {
  std::size_t cells = 0;
  std::size_t nodes = 0;
};
GridCounts count_grid(const Model& model, const Body& body);

}  // namespace scarp

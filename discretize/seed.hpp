// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "discretize/columns.hpp"
#include "solver/model/particles.hpp"
#include "solver/model/reports.hpp"

namespace scarp {

/// A lattice cell that holds material points: its place across, across, up (2D: the middle one is 0).
struct OccupiedCell {
  std::array<std::int32_t, 3> at{};
  std::uint32_t points = 0;
  std::size_t first = 0;  ///< its first point, counted from the body's begin

  /// Place in the lattice's own order of axes.
  std::array<std::int32_t, 3> in_lattice(bool flat) const { return flat ? std::array{at[0], at[2], 0} : at; }
};

/// Cells with at least one point, lexicographic: x fastest, then y, then z.
std::vector<OccupiedCell> occupied_cells(const SubLattice& grid, const Columns& columns, int threads);

/// Writes id, positions, reference volume and the surface flag of the body's points, from `begin` on in `particles`,
/// which has room for them: cells in order, points within a cell x fastest.
///
/// A point is on the surface if one of its lattice neighbours (6; 2D: 4) is empty; of a terrain solid only if
/// that neighbour is above the scanned surface, not below the base or beyond the skirt.
void seed(const SubLattice& grid, const Columns& columns, const std::vector<OccupiedCell>& cells, std::size_t begin,
          int threads, Particles& particles);

/// Fills in cells, full_cells and isolated_particles.
void count_cells(const SubLattice& grid, const std::vector<OccupiedCell>& cells, VolumeReport& report);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "discretize/seed.hpp"
#include "discretize/terrain_solid.hpp"
#include "solver/model/model.hpp"

namespace scarp {

/// The nodes at which the ground below its base holds a terrain solid; none if the base is free.
///
/// Held are the nodes of occupied cells at or below the base, and the bottom nodes of each column's lowest occupied
/// cell: a base that runs through cells must hold the solid too. Nodes are in lexicographic order, x fastest, each
/// once.
std::vector<NodeSet> hold_base(const TerrainSolid& solid, const SubLattice& grid, const Columns& columns,
                               const std::vector<OccupiedCell>& cells, int threads);

}  // namespace scarp

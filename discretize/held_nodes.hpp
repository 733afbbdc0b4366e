// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "discretize/seed.hpp"
#include "discretize/terrain_solid.hpp"
#include "solver/model/model.hpp"

namespace scarp {

/// The nodes at which the ground around a terrain solid holds it, in up to two sets; each set in lexicographic order,
/// x fastest, each node once.
///
/// "base", unless the base is free: the nodes of occupied cells at or below the base, and the bottom nodes of each
/// column's lowest occupied cell: a base that runs through cells must hold the solid too.
/// "skirt", where asked for: the nodes of occupied cells that have the outside of the plan in a cell beside them.
std::vector<NodeSet> hold_nodes(const TerrainSolid& solid, const SubLattice& grid, const Columns& columns,
                                const std::vector<OccupiedCell>& cells, int threads);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/core/updated_grid.hpp"

namespace scarp {

/// Which axes faces and NodeSets hold. A set's lattice node is held by all functions that do not vanish there.
/// @throws Error ("solve") where a roller's axis is none of the model's, or a NodeSet's lattice has other nodes than
///         the domain's.
void find_held_axes(UpdatedGrid& grid, const Model& model);

/// UpdatedGrid::held of the occupied nodes: those on or beyond a face of the domain, and of NodeSets.
void hold_nodes(UpdatedGrid& grid, int threads);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/core/reference_grid.hpp"

namespace scarp {

/// Per node of the grid the axes along which its velocity is held at zero, bit 0 for x to bit 2 for z: from the
/// domain's faces (nodes on or outside the plane, within 1e-6 cell) and from the body's NodeSets.
/// @throws Error ("solve") where a roller's axis is none of the model's.
std::vector<std::uint8_t> held_axes(const Domain& domain, const Body& body, const ReferenceGrid& grid);

}  // namespace scarp

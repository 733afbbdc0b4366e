// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "discretize/terrain_solid.hpp"
#include "solver/model/mesh.hpp"

namespace scarp {

/// The closed surface of a terrain solid: the TIN, its base and a vertical skirt on its border.
/// @throws Error ("discretize") naming the body for a solid with an outline or between two surfaces, or one whose
/// surface reaches below its base.
TriangleMesh terrain_boundary(const TerrainSolid& solid, const std::string& body);

}  // namespace scarp

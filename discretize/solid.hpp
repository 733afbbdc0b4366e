// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>

#include "discretize/closed_mesh.hpp"
#include "discretize/discretize.hpp"
#include "discretize/simple_shapes.hpp"
#include "discretize/terrain_solid.hpp"

namespace scarp {

/// The table of solids. Each has exact `bounds` and `volume`, and fill(solid, grid, threads) says which sub-cells of
/// a lattice it fills. A new one is one pair of files, one entry here and one line in close_volume.
using Solid = std::variant<TerrainSolid, MeshSolid, BoxSolid, BallSolid, PolygonSolid>;

/// The solid that a body's volume describes.
/// @throws Error ("discretize") naming the body for a scan or mesh that was not loaded, a volume of the other
/// dimension, and whatever the solid itself refuses.
Solid close_volume(const BodyOptions& options, const DiscretizeInput& input);

}  // namespace scarp

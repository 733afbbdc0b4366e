// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "discretize/columns.hpp"
#include "solver/model/mesh.hpp"

namespace scarp {

/// A closed triangle mesh, every part of it oriented so that it bounds the solid (shells inside shells are hollows).
struct MeshSolid {
  TriangleMesh mesh;  ///< vertices of equal position made one
  bool self_intersecting = false;
  double volume = 0;  ///< m3, by the divergence theorem
  Box3 bounds;
};

/// @throws Error ("discretize") naming the body if an index is out of range, a vertex is not finite, the mesh is open
/// (says how many border edges it has) or cannot be oriented, or it encloses no volume.
MeshSolid close_mesh(const TriangleMesh& mesh, const std::string& body, const std::string& file);

/// Sub-cells whose centre lies inside by parity along the vertical.
/// @throws Error if the surface crosses the columns absurdly often.
Columns fill(const MeshSolid& solid, const SubLattice& grid, int threads);

}  // namespace scarp

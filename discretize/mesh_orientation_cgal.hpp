// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/mesh.hpp"

namespace scarp {

struct OrientedMesh {
  bool possible = false;  ///< false: no orientation makes it the border of a solid
  bool self_intersecting = false;
  TriangleMesh mesh;  ///< oriented; vertices where surfaces merely touch may have been doubled
};

/// Orients a closed mesh so that it bounds a solid: outermost shells outwards, nested ones in turns. Of a mesh that
/// intersects itself only the triangles' agreement with their neighbours is mended, since nesting has no meaning.
OrientedMesh orient_to_bound(const TriangleMesh& mesh);

}  // namespace scarp

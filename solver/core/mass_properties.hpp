// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/mesh.hpp"

namespace scarp {

/// Of a body of uniform density (plane strain: per metre of thickness).
struct MassProperties {
  double mass = 0;        ///< kg
  Vec3 centre{0, 0, 0};   ///< m
  Vec3 moments{0, 0, 0};  ///< principal moments of inertia about the centre, kg m2; plane strain: all that about z
  Mat3 axes = kIdentity;  ///< their directions in its columns, a right-handed frame
};

/// Exact for the volume inside the mesh: by the divergence theorem every integral is one of a cubic over its triangles.
/// @param surface  closed; in plane strain a prism (prism_mesh)
/// @param radius   of a ball (plane strain: a disk) about the centre of the mesh's bounds, which counts instead; else 0
MassProperties mass_properties(const TriangleMesh& surface, double radius, double density, int dimension);

}  // namespace scarp

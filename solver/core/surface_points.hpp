// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/mesh.hpp"

namespace scarp {

/// Points all over a surface, its corners among them, with the area (plane strain: length) that belongs to each.
struct SurfacePoints {
  std::vector<Vec3> places;   ///< m
  std::vector<double> areas;  ///< m2 (m)
};

/// Vertices of the surface once edges longer than `spacing` have been halved, again and again; in plane strain, where
/// it is a prism (prism_mesh), of its outline. A vertex has a third of the triangles around it, half of the segments.
SurfacePoints spread_points(const TriangleMesh& surface, double spacing, int dimension);

}  // namespace scarp

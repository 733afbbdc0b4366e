// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/model/error.hpp"
#include "solver/model/mesh.hpp"

namespace scarp {

/// @throws Error unless all coordinates are finite
void check_vertex(const Vec3& vertex, const SourceLocation& where);

/// Adds a face as a fan of triangles. Indices count from 0.
/// @param vertices how many vertices there are, or will be
/// @throws Error for fewer than three corners, or an index outside [0, vertices)
void add_face(const std::vector<double>& corners, std::uint64_t vertices, const SourceLocation& where,
              TriangleMesh& mesh);

}  // namespace scarp

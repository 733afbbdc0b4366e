// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solver/model/mesh.hpp"

namespace scarp {

/// Reads a triangle mesh: PLY (all that read_ply reads), OBJ, or STL, ascii and binary; told apart by content where
/// it tells, else by extension. Faces with more than three corners are split as a fan from their first corner, which
/// is right for convex ones. The orientation is the file's; nothing is repaired, and triangles without area stay.
///
/// - PLY: lists "vertex_indices" or "vertex_index" of the element "face".
/// - OBJ: v and f, with v, v/vt, v//vn, v/vt/vn and negative (relative) indices; all other statements are passed over.
/// - STL: has no shared vertices; those with exactly equal coordinates become one, in the order of the file.
///   Coordinates of a binary STL are single precision: at UTM size steps of 0.5 m.
///
/// @throws Error with line (text) or byte (binary): what is no such file, coordinates that are not finite, an index
/// without its vertex, a face with fewer than three corners, counts above what the file can hold, an early end, no
/// triangles at all.
TriangleMesh read_mesh(const std::filesystem::path& path);

}  // namespace scarp

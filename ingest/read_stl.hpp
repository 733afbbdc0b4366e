// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/read_buffered.hpp"
#include "solver/model/mesh.hpp"

namespace scarp {

/// Whether the size of the file is that of a binary STL with as many triangles as it says. Asked first, because
/// binary files may begin with "solid" too.
bool is_binary_stl(BufferedFile& file);

/// Reads an STL file; see read_mesh.hpp. @throws Error with line or byte
TriangleMesh read_stl(BufferedFile& file);

}  // namespace scarp

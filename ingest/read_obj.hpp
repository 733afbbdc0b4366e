// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/read_buffered.hpp"
#include "solver/model/mesh.hpp"

namespace scarp {

/// Reads a Wavefront OBJ; see read_mesh.hpp. @throws Error with the line
TriangleMesh read_obj(BufferedFile& file);

}  // namespace scarp

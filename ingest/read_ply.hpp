// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solver/model/point_cloud.hpp"

namespace scarp {

/// Reads the element "vertex" of a PLY file: ascii, binary little or big endian; coordinates of any type, as double
/// from text even where the header says float. What property names mean is told in point_table.hpp; colours are
/// uchar, ushort, or real 0..1; list properties and other elements are passed over. A PLY with 0 vertices is an empty
/// cloud. Coordinates that are NaN or infinite come out as NaN.
///
/// @throws Error with line (text) or byte (binary): a broken header, no vertices, no x, y or z, a count or list length
/// above what the file can hold (before anything is allocated), a value that its type cannot hold, an early end.
PointCloud read_ply(const std::filesystem::path& path);

}  // namespace scarp

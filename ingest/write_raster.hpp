// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solver/model/heightfield.hpp"

namespace scarp {

/// Writes an ESRI ASCII grid in the site's coordinates (cell centres: xllcenter, yllcenter), the north row first,
/// no data as -9999, and a .prj beside it when the CRS is known. All digits are kept.
/// @throws Error when a height equals the no-data value.
void write_raster(const std::filesystem::path& path, const Heightfield& field);

}  // namespace scarp

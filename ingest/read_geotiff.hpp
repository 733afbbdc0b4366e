// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "solver/model/heightfield.hpp"

namespace scarp {

/// Whether a file that begins so is a TIFF or BigTIFF.
bool is_tiff(std::string_view beginning);

/// Reads a GeoTIFF of heights (GDAL): one band of real numbers in any compression, square cells along the axes, with
/// its scale and offset applied. What the file masks, calls no data or stores as NaN becomes NaN. The coordinate
/// reference system is kept as WKT.
/// @throws Error: no GeoTIFF; no georeference; several bands, complex or infinite values; cells that are rotated or no
/// squares; more than 2^28 cells; heights in another unit than metres; a build without GDAL.
Heightfield read_geotiff(const std::filesystem::path& path);

}  // namespace scarp

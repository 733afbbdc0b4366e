// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "solver/model/heightfield.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

/// Reads a raster of heights by what the file holds, whatever its extension: a GeoTIFF (read_geotiff) or an ESRI ASCII
/// grid. @throws Error as these do.
Heightfield read_raster(const std::filesystem::path& path);

/// Reads an ESRI ASCII grid. Header words in any case and order: ncols, nrows, xllcorner or
/// xllcenter, yllcorner or yllcenter, cellsize (or dx and dy, if equal), nodata_value (-9999 if absent; may be nan).
/// The file's first row is the north and comes last in the Heightfield. Values equal to nodata (to single precision:
/// -3.4028235e38 is written in many ways) and nan become NaN. Line breaks between values mean nothing.
/// A file of the same name with .prj beside it is taken as the coordinate reference system, as opaque text.
///
/// @throws Error with line and column: a missing, repeated or unknown header word, cells that are no squares, more
/// cells than the file can hold (before anything is allocated), too few or too many values, infinite ones.
Heightfield read_ascii_grid(const std::filesystem::path& path);

/// Whether a file that begins so is an ESRI ASCII grid or a TIFF.
bool is_raster(std::string_view beginning);

/// The centres of the cells with data, row by row from the south, west to east.
PointCloud raster_to_cloud(const Heightfield& field);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "solver/model/point_cloud.hpp"

namespace scarp {

/// Generating software of the files written here.
inline constexpr std::string_view kLasSoftware = "scarp";

/// The names under which normals are stored as extra bytes; other programs use the same.
inline constexpr std::array<std::string_view, 3> kNormalNames{"NormalX", "NormalY", "NormalZ"};

/// Writes a cloud as LAS 1.4 in the site's coordinates (positions + site.origin), whole or not at all.
///
/// - Coordinates are 32-bit multiples of one scale, the finest of 1e-6, 1e-5, 1e-4, 1e-3 m that holds the extent,
///   about a whole-metre offset; the error is at most half a scale step.
/// - A WKT crs is stored byte for byte (record 2112), the point format is 6, or 7 with colour; so too without a crs.
/// - "EPSG:n" is stored as GeoTIFF keys. LAS forbids them in formats 6-10, so the format is 0 to 3, by whether there
///   are gps_time and colour; only classes above 31 or more than 7 returns call for 6 or 7. A code from 4000 to 4999
///   counts as geographic if all coordinates are within +-180, +-90, else as projected.
/// - Absent returns are written as 1 of 1, other absent attributes as 0. Colour is taken to be 16-bit.
/// - Normals and scalars are written as extra bytes (double, NaN stays NaN), units in the description.
/// - The bytes depend on the cloud alone: the creation date is left unset.
/// @throws Error ("write"): attributes of unequal lengths; a coordinate that is not finite or does not fit; a crs that
///   is neither WKT of at most 65534 bytes nor "EPSG:n"; return numbers above 15; more than 341 scalars; a scalar's
///   name of 0 or more than 32 or its unit of more than 26 bytes; the system's reasons (see write_whole).
void write_las(const std::filesystem::path& path, const PointCloud& cloud);

}  // namespace scarp

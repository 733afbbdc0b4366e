// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "ingest/read_las_header.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

/// Reads uncompressed LAS 1.0-1.4, point formats 0-10 (waveforms are passed over), in blocks.
///
/// Positions are in the file's coordinates and units, origin 0, in file order; all points are kept, those
/// flagged as withheld too. Present are:
/// - `colour` for formats 2 3 5 7 8 10; values that stay <= 255 in the whole file are 8-bit and multiplied by 257
///   (not in files that write_las wrote, which are always 16-bit);
/// - `classification` always (5 bits in formats 0-5);
/// - `intensity`, `return_number`, `number_of_returns`, `gps_time` unless zero throughout, which by the
///   specification means "not recorded"; a gps_time that is not finite becomes NaN;
/// - `scalars` for the dimensions of the "extra bytes" record, scaled; no_data and non-finite values are NaN; arrays
///   give NAME0, NAME1, ...; NormalX, NormalY, NormalZ together become `normals` when they are unit vectors.
/// A file without points gives an empty cloud; the caller decides.
/// @param shown_as the name to use in messages; empty: the path
/// @throws Error ("ingest") as read_las_header does, and for a compressed file (see read_laz.hpp).
PointCloud read_las(const std::filesystem::path& path, const std::string& shown_as = {});

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ingest/las_format.hpp"
#include "solver/model/math.hpp"

namespace scarp {

/// What a LAS or LAZ (COPC) file says about itself, without its points.
struct LasHeader {
  int version_major = 1, version_minor = 0;
  int point_format = 0;     ///< 0 to 10, without the compression bits
  bool compressed = false;  ///< LAZ or COPC
  std::uint64_t count = 0;  ///< points promised
  /// Points to be read: `count`, but 0 if the file ends where the points would begin.
  std::uint64_t points_in_file = 0;
  Box3 bounds;  ///< as stated, in the file's coordinates; empty if it states nonsense or has no points
  Vec3 scale{1, 1, 1}, offset{0, 0, 0};
  std::string crs;  ///< WKT byte for byte without trailing NULs, or "EPSG:n", or empty
  std::string system_identifier, generating_software;
  std::uint64_t data_offset = 0;    ///< byte where the points begin
  std::uint32_t record_length = 0;  ///< bytes per point
  std::vector<las::ExtraDimension> extra_dimensions;
  std::vector<std::string> remarks;  ///< what is odd about the file but does not prevent reading it
};

/// Reads the header and the variable length records of LAS 1.0-1.4, plain or compressed, point formats 0-10
/// (ASPRS LAS 1.4 R15). The CRS comes from the WKT record 2112 (VLR, else EVLR), else from the GeoTIFF keys
/// ProjectedCSType 3072 or GeographicType 2048.
///
/// Every count is held against the size of the file before anything is allocated.
/// @param shown_as the name to use in messages; empty: the path
/// @throws Error ("ingest") with the byte: not a LAS file, a version or format unknown, damaged, or truncated.
LasHeader read_las_header(const std::filesystem::path& path, const std::string& shown_as = {});

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "ingest/read_laz.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

/// Reads a cloud of any format that scarp knows: LAS, LAZ and COPC, PLY, PCD, ESRI ASCII grid (its cell centres), and
/// text (XYZ, TXT, CSV, PTS, ASC). The content decides, and the extension only where the content is plain numbers,
/// so that a DEM called .txt and a LAZ called .las are read for what they are.
///
/// @param laz who converts LAZ; nothing: default_laz_converter(), asked only for a compressed file
/// @throws Error: no such file, a folder, an empty file, a format that is not read (with those that are), and what
/// the format's own reader throws. Coordinates are the file's, the origin of the site frame is 0.
PointCloud read_cloud(const std::filesystem::path& path, const std::optional<LazConverter>& laz = {});

}  // namespace scarp

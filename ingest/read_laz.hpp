// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solver/model/point_cloud.hpp"

namespace scarp {

/// How LAZ becomes LAS: a Node.js program run as a child process, because no LAZ library is at hand.
struct LazConverter {
  std::filesystem::path script;  ///< laz2las.mjs, beside its node_modules
  /// Where the temporary folder with the plain LAS goes; on disk rather than in memory, for it is some 5-10 times
  /// as large as the LAZ.
  std::filesystem::path scratch = "/var/tmp";
};

/// The converter of the source tree that this was built from, or else the installed one
/// (../share/scarp/laz2las/laz2las.mjs from the folder of the running program).
LazConverter default_laz_converter();

/// Reads LAZ and COPC: converts to LAS in a temporary folder, which is always removed, and reads that as read_las
/// does. COPC points come in the order of its octree. A file that is not compressed is read as LAS.
///
/// The child runs without a shell and is killed if this throws. The file is held in memory whole by the converter:
/// LAZ files up to 1.9 GB.
/// @throws Error ("ingest"): as read_las; node or its package missing (with the command to run); no room in
///   `scratch` for the points promised; the converter's reason for damaged or unknown data.
PointCloud read_laz(const std::filesystem::path& path, const LazConverter& converter);

}  // namespace scarp

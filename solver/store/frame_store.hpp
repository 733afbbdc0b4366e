// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames as VTKHDF files (version 1.0, an unstructured grid of vertices), which ParaView opens. One thread only.
#pragma once

#include <filesystem>
#include <functional>

#include "solver/model/frame.hpp"
#include "solver/store/series_store.hpp"

namespace scarp {

/// Writes one frame; the extension must be ".hdf", because ParaView 5.11 goes by it.
///
/// /VTKHDF holds Points (n x 3, float64, m, local), one vertex per point and PointData with the fields under
/// their names; each array has an attribute "unit". Beside it stand `time` (s), `step`, `origin` (3, m: add it
/// to Points to get the site's coordinates) and `crs`.
/// @throws Error ("store") for a frame without particles, a field whose length is not particles x components,
///         a name that cannot be one, or another extension; Error ("write") if the disk refuses.
void write_frame(const std::filesystem::path& path, const Frame& frame);

/// The same in parts, for frames that need not be in memory as a whole: `each_part` gives them to its argument, in the
/// order of the particles, all with the same fields. Parts of ParticleStates::kBlock particles are packed at once.
using FrameParts = std::function<void(const std::function<void(const Frame&)>& append)>;
void write_frame(const std::filesystem::path& path, std::size_t particles, const FrameParts& each_part);

/// Everything that write_frame was given, in the same order and types.
/// @throws Error ("store") for a file that is not a whole frame of ours.
Frame read_frame(const std::filesystem::path& path);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace scarp {

/// The times of the frames in the form that ParaView opens: JSON, extension ".hdf.series". Names are relative to
/// the series' folder ("frames/frame_000000.hdf"); times in s.
/// @throws Error ("store") for a time that is not finite; Error ("write") if the disk refuses.
void write_series(const std::filesystem::path& path, const std::vector<std::pair<std::string, double>>& frames);

/// Name and time of every frame, in the order of the file.
/// @throws Error ("store") with the byte at which the file is no series.
std::vector<std::pair<std::string, double>> read_series(const std::filesystem::path& path);

}  // namespace scarp

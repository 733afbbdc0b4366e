// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace scarp {

/// Whether a file begins as an ESRI ASCII grid or a TIFF does.
bool holds_raster(const std::filesystem::path& file);

}  // namespace scarp

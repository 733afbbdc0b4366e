// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "tools/pipeline/pipeline.hpp"

namespace scarp {

/// @throws Error when `artefact` would replace the user's file `input`.
void refuse_to_overwrite(const std::filesystem::path& input, const std::filesystem::path& artefact);

/// The output folder may be where the inputs are, but no artefact may take the place of one: neither of a scan,
/// mesh or raster nor of a scenario that someone wrote.
void refuse_to_overwrite_inputs(const Project& project);

}  // namespace scarp

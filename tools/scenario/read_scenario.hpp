// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/model/scenario.hpp"

namespace scarp {

/// Reads a scenario file (TOML), applies `--set` overrides ("key.path=value", see overrides.hpp) and checks all that
/// can be checked without opening the input files: keys, types, units, ranges, references between entries, and that
/// the input files exist. Defaults that depend on other keys stay open, see resolve.hpp. Input files come back
/// absolute. Points have domain.dimension entries in the file (2D: z = 0 here), except in scans, which are spatial.
/// @throws Error ("scenario") "FILE:LINE:COL: what: found VALUE; allowed: CONSTRAINT"; for overrides the place reads
///         `--set key.path=value`.
Scenario read_scenario(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same for text at hand. `name` is what errors call it, `folder` is where relative input files start.
Scenario parse_scenario(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                        const std::vector<std::string>& overrides = {});

}  // namespace scarp

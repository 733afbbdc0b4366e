// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "tools/scenario/node.hpp"

namespace scarp {

/// The tree of a TOML text; the only door to the TOML library.
/// @param name what errors call the text: a file's name, or `--set ...`
/// @throws Error ("scenario") with line and column for a syntax error or a key that is set twice, and for what the
///         library would choke on: more than 1 MB, brackets or dotted keys nested deeper than 64, lines longer
///         than 4096 characters, control characters.
Node parse_toml(const std::string& text, const std::string& name);

/// Refuses a text that is not safe to hand to the library, see parse_toml.
void check_toml_bounds(const std::string& text, const std::string& name);

constexpr std::size_t kLargestScenario = 1'000'000;  ///< bytes

}  // namespace scarp

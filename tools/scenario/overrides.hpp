// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "tools/scenario/node.hpp"

namespace scarp {

/// Applies one `--set` argument, "key.path=value", to the tree of a scenario. Parts of the path are keys of tables;
/// in a list they are an index from 0 or the `name` of an entry ("bodies.slide.material"); a part with a dot stands
/// in quotes. The value is read as TOML; text that is not TOML is taken as a string. Tables that are missing on the
/// way are made; whether their keys exist is for the reader to say.
/// @throws Error ("scenario") whose location is `--set key.path=value`.
void apply_override(Node& root, const std::string& argument);

}  // namespace scarp

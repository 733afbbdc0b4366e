// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solver/model/scenario.hpp"

namespace scarp {

/// The scenario as TOML text, every key written out, optional ones where they are set, and of one that only compares
/// scans no others than these two need. Doubles are in the shortest
/// form that reads back to the same bits: parse_scenario(to_toml(s)) is s.
/// @throws Error ("scenario") if a number is not finite.
std::string to_toml(const Scenario& scenario);

}  // namespace scarp

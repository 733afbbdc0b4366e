// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/scenario.hpp"
#include "tools/scenario/node.hpp"

namespace scarp {

/// What a single key cannot tell: unique names, references between entries, keys that need or exclude each other,
/// shapes and points per cell that fit the dimension.
/// @param root the tree that the scenario was read from, for the places in the errors
/// @throws Error ("scenario") at the first contradiction.
void check_scenario(const Scenario& scenario, const Node& root);

}  // namespace scarp

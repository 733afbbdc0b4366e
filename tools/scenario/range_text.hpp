// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "solver/model/schema.hpp"

namespace scarp {

/// "above 0 m", "from 0 to 1", "at least 0 deg and below 90 deg"; empty where everything is allowed.
/// @param unit appended to the numbers; pass "" to leave it out
std::string range_text(const Spec& spec, std::string_view unit);

/// Whether a value lies within the bounds of `spec`; never true for NaN and infinities.
bool is_within(double value, const Spec& spec);

}  // namespace scarp

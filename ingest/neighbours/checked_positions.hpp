// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// @throws Error ("neighbours") naming the first position that is not finite or beyond 1e100, or when there are 2^32
/// or more.
void check_positions(const std::vector<Vec3>& positions);

}  // namespace scarp

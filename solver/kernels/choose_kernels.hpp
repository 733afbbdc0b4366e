// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "solver/kernels/kernels.hpp"

namespace scarp::kernels {

/// What this program holds and this processor runs, the widest first. Never empty.
const std::vector<Kernels>& available_kernels();

/// The widest of them.
const Kernels& best_kernels();

/// The one of that name.
/// @throws Error ("solve") where this processor or this program does not have it.
const Kernels& kernels_named(std::string_view name);

}  // namespace scarp::kernels

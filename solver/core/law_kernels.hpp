// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "solver/kernels/nodal.hpp"
#include "solver/materials/material.hpp"
#include "solver/model/model.hpp"

namespace scarp {

/// What the kernel of a law needs, or nothing where the law, or an option of it, has none.
std::optional<kernels::LawParameters> kernel_of(const Material& material);

/// The same for each of the model's materials.
std::vector<std::optional<kernels::LawParameters>> kernels_of(const Model& model);

}  // namespace scarp

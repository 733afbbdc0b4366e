// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/core/total_body.hpp"

namespace scarp {

/// Model::loads onto the nodes of the bodies. Weights and areas are those of the reference configuration: nodal
/// forces at factor 1 are found once.
/// @throws Error ("solve"), see find_particle_forces, and where a motion is imposed on no node, of a model
///         whose bodies are all total-Lagrangian.
void set_loads(std::vector<TotalBody>& bodies, const Model& model);

}  // namespace scarp

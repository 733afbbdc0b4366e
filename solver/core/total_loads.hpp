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
/// Those on one body, whose grid has moved: forces on the same particles, the same as before.
void set_loads(TotalBody& body, const Model& model);

/// (1) The water's force on the body's particles where they are, times `ramp`, into NodeLoads::present.
void map_water_force(const Particles& particles, TotalBody& body, const WaterTable& water, double ramp, int threads);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/core/node_faces.hpp"
#include "solver/model/model.hpp"

namespace scarp {

/// A rigid base is where the model is looked at from: what faces and bodies hold stays, and everything feels - a_g, the
/// acceleration of the base. That is the motion of held nodes in both maps of a step, whatever the update order, and it
/// is exact: the mean of a_g over the step is the change of its velocity.
/// Zero without a rigidly shaken base, m/s2.
Vec3 mean_base_acceleration(const std::vector<GroundMotion>& shaking, double time, double dt);

/// Sends the waves of compliant bases into absorbing faces, with their mean velocity over the step.
void send_waves(NodeFaces& faces, const std::vector<GroundMotion>& shaking, double time, double dt);

/// @throws Error ("solve") where a wave is to come through a face that is not absorbing, a direction is not in the
///         plane, or rigid and compliant bases are mixed.
void check_shaking(const Model& model);

}  // namespace scarp

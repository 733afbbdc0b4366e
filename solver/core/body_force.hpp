// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Accelerations that vary from particle to particle, as those of a manufactured solution do.
#pragma once

#include <vector>

#include "solver/core/total_body.hpp"

namespace scarp {

/// Method.md 1.1, (1): adds sum_p phi_Ip m_p b_p to the force slots.
/// @param acceleration  b_p, per particle of the model, m/s2
void add_body_force(const Particles& particles, TotalBody& body, const std::vector<Vec3>& acceleration);

/// Their work over a step, J, once the nodes' velocities after it are final: over the displacement of the particles, as
/// that of gravity counts.
double work_of_body_force(const Particles& particles, const TotalBody& body, const std::vector<Vec3>& acceleration,
                          double dt);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/model.hpp"
#include "tools/pipeline/pipeline.hpp"

namespace scarp {

/// Gives a discretized model what the scenario says of the run and what is not stored with it: loads, in local
/// coordinates, and the body force.
void add_run_inputs(const Project& project, Model& model);

/// What is watched, in local coordinates.
std::vector<ProbeOptions> local_probes(const Project& project, const Vec3& origin);

}  // namespace scarp

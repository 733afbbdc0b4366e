// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/model.hpp"
#include "tools/pipeline/pipeline.hpp"

namespace scarp {

/// Gives a discretized model what the scenario says of the run and what is not stored with it: loads, in local
/// coordinates, the body force, the water table, and the records that shake it, corrected.
void add_run_inputs(const Project& project, Model& model);

/// Peaks and ends of the records, one sentence each.
std::vector<std::string> describe_shaking(const Project& project, const Model& model);

/// Each record as it is used: shaking_0.csv with time, acceleration, velocity and displacement along its direction;
/// and its peaks in the summary.
void record_shaking(const Project& project, const Model& model);

/// What is watched, in local coordinates.
std::vector<ProbeOptions> local_probes(const Project& project, const Vec3& origin);

}  // namespace scarp

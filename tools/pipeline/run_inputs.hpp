// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/model.hpp"
#include "tools/pipeline/pipeline.hpp"

namespace scarp {

/// Gives a discretized model what the scenario says of the run and what is not stored with it: loads, in local
/// coordinates.
void add_run_inputs(const Project& project, Model& model);

}  // namespace scarp

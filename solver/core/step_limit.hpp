// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which particle sets the time step. The sweeps keep only the largest speed; this looks for its place, when asked.
#pragma once

#include <vector>

#include "solver/core/total_body.hpp"
#include "solver/core/updated_grid.hpp"
#include "solver/materials/law.hpp"
#include "solver/model/reports.hpp"

namespace scarp {

/// The stiffest cell of a total-Lagrangian body (see StressOutcome) and the stiffest particle in it. Time step and time
/// are the caller's.
StepLimit find_step_limit(const Particles& particles, const TotalBody& body);

/// One cell of such a body, particles [begin, end): takes the place of what `limit` names where it is stiffer than
/// `most`, the c^2 of that.
/// @param body  asked for its moved reference configuration, if it may have one
void look_at_cell(StepLimit& limit, double& most, const Particles& particles, const std::vector<PreparedLaw>& laws,
                  std::size_t begin, std::size_t end, const TotalBody* body = nullptr);

/// The particle of updated-Lagrangian bodies with the fastest waves, or the fastest one where it outruns them.
StepLimit find_step_limit(const Particles& particles, const UpdatedGrid& grid, const std::vector<PreparedLaw>& laws);

}  // namespace scarp

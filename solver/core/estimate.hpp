// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/model.hpp"
#include "solver/model/solver_options.hpp"

namespace scarp {

/// What a run will take, from the state at t = 0: compression and shear shorten the step later.
struct RunEstimate {
  double time_step = 0;     ///< s, the first
  double steps = 0;         ///< to the end time, output times included
  double memory_bytes = 0;  ///< particles, grids and sweep buffers; frames come on top
  double particle_steps = 0;
};

/// @throws Error ("solve", "materials") where model or options cannot be run.
RunEstimate estimate(const Model& model, const SolverOptions& options, const OutputOptions& output);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/core/frame_sink.hpp"
#include "solver/kernels/choose_kernels.hpp"
#include "solver/model/model.hpp"
#include "solver/model/solver_options.hpp"

namespace scarp {

/// Runs `model` from t = 0 to the end time and leaves it in its last state. Frames, samples and progress go to
/// `sink`. The same model and options give the same bits for any number of threads.
///
/// A failure of the simulation (a particle turned inside out, something not finite, the time step below 1e-6 of
/// the first, max_steps reached) is a value in the report; the sink hears nothing after it.
/// Particles are reordered within their body; their ids keep their identity.
/// @throws Error ("solve", "materials") where model or options cannot be run.
RunReport run(Model& model, const SolverOptions& options, const OutputOptions& output, FrameSink& sink, int threads,
              const kernels::Kernels& kernels = kernels::best_kernels());

}  // namespace scarp

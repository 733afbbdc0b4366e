// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solver/core/formulations.hpp"

namespace scarp {

/// Relaxes `method` to a state at rest under its steady gravity, before t = 0 (RelaxOptions; dynamic relaxation,
/// Cundall 1987). Afterwards stress and history are those of the state at rest, velocities are those that the model
/// came with, particles stand on their reference positions, and displacements count from here: the geometry that was
/// given is the one that carries its load. Takes no step where `options.relax`
/// is not set, but one under absorbing faces with `options.k0`.
/// @return why no state at rest was found, if so; step and time are left out
std::optional<Failure> relax(Formulations& method, const Model& model, const SolverOptions& options);

}  // namespace scarp

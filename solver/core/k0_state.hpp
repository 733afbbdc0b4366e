// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/model.hpp"
#include "solver/model/solver_options.hpp"

namespace scarp {

/// Vertical effective stress at each particle, as a pressure, Pa: what lies above it in its column weighs, less what
/// the water bears of it, and half of its own. Particles are cubes (2D: squares) of their volume; columns are as wide
/// as the smallest of them, and a larger one stands in several. Of all bodies together, at any shape of the ground;
/// loads do not count.
std::vector<double> vertical_effective_pressure(const Model& model, double gravity);

/// Gives particles the stress of SolverOptions::k0, if that is set: vertical from their overburden, horizontal K0 times
/// it, with the deformation and the history under which their law bears it. Level ground is then at rest; a slope is
/// not, as shear is missing: relax it from there. In laws without a history the elastic strain is in F, which leaves a
/// force out of balance of that share of the weight.
/// @throws Error ("solve") where gravity is not straight down, grows by a ramp, or a law cannot bear the stress.
void set_k0_stress(Model& model, const SolverOptions& options, int threads);

}  // namespace scarp

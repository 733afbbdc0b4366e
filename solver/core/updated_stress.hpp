// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "solver/core/updated_grid.hpp"
#include "solver/materials/law.hpp"

namespace scarp {

/// A particle's c^2, or -1 where its state is no longer valid.
inline void note(UpdatedOutcome& outcome, double c2, std::size_t p) {
  outcome.largest_wave_speed_squared = std::max(outcome.largest_wave_speed_squared, c2);
  const auto index = static_cast<std::int64_t>(p);
  if (c2 < 0 && (outcome.bad_particle < 0 || index < outcome.bad_particle)) outcome.bad_particle = index;
}

/// Method.md 1.1, (5) and (6): L = sum v_I x grad phi_Ip, F <- (I + dt L) F, the law's stress.
/// @param laws  prepared, in the order of Model::materials
UpdatedOutcome update_stress(Particles& particles, UpdatedGrid& grid, const std::vector<PreparedLaw>& laws, double dt,
                             int threads);

/// The same outcome for the state that the particles hold, which stays: for the start of a run.
UpdatedOutcome survey(Particles& particles, UpdatedGrid& grid, const std::vector<PreparedLaw>& laws, int threads);

}  // namespace scarp

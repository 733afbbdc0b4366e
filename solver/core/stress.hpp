// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/core/total_body.hpp"
#include "solver/materials/law.hpp"

namespace scarp {

/// What a stress sweep found in a body.
struct StressOutcome {
  /// Largest over the cells of the mean of c^2, weighted by mass, (m/s)^2, in the reference configuration: a cell's
  /// stiffness is the sum of its particles', so that one squeezed particle among eight counts for an eighth.
  double largest_wave_speed_squared = 0;
  std::int64_t bad_particle = -1;  ///< index: J <= 0 or something not finite; -1 if all is well
};

/// Method.md 1.1, (5) and (6), and (1) of the next step: F <- F + dt sum v_I x grad0 phi_Ip, the law's stress, and
/// slots <- - V0 P grad0 phi_Ip.
/// @param laws        prepared, in the order of Model::materials
/// @param find_speed  whether the outcome's wave speed is asked for
StressOutcome update_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws, double dt,
                            int threads, bool find_speed = true);

/// The same from the stress that the particles hold, without moving them: for the start of a run.
StressOutcome map_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws, int threads);

}  // namespace scarp

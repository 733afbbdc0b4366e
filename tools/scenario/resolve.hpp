// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solver/model/scenario.hpp"

namespace scarp {

/// Makes every default explicit that depends on other keys: gravity (9.81 m/s2 down: -z, in 2D -y), output.every (a
/// twentieth of the end time), output.history_every (a tenth of that), output.run_out.threshold (a cell),
/// points_per_cell (4 in 2D, 8 in 3D), names of comparisons, compare.max_distance (ten cells),
/// compare.simulated_spacing (that of the coarsest body). Applying it twice changes nothing more.
void resolve_defaults(Scenario& scenario);

/// What a comparison is called that has no name: "last_after", "last_after_m3c2".
std::string default_name(const CompareOptions& compare);

/// Moves every member of Role::position and Role::elevation from the site's coordinates to local ones by subtracting
/// `origin` (of plan coordinates its x and y, of elevations its z), m.
void localize_scenario(Scenario& scenario, const Vec3& origin);

}  // namespace scarp

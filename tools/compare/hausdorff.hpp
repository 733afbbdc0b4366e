// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "ingest/neighbours/neighbours.hpp"
#include "solver/model/comparison_report.hpp"

namespace scarp {

/// Distances between two clouds as sets of points, with no limit of distance: Hausdorff (the largest, and at 95 %), and
/// chamfer in its two common forms, the formulas in the group's convention. `near_simulated`, `near_observed` search
/// the same points.
MeasureGroup set_distances(const std::vector<Vec3>& simulated, const std::vector<Vec3>& observed,
                           const Neighbours& near_simulated, const Neighbours& near_observed, int threads);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/comparison_report.hpp"

namespace scarp {

/// How much of distances exceeds what noise explains. `distances` and `detections` (levels at 95 %, 1.96 standard
/// deviations) in m, one per point, NaN where unknown; points with both count.
MeasureGroup beyond_noise(const std::vector<double>& distances, const std::vector<double>& detections);

/// Where |distance| > level of detection: 1, else 0; NaN where either is unknown.
std::vector<double> significant(const std::vector<double>& distances, const std::vector<double>& detections);

}  // namespace scarp

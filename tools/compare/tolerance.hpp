// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "solver/model/compare_options.hpp"
#include "solver/model/reports.hpp"

namespace scarp {

/// Whether every statistic with a tolerance is at most that. One that is NaN, because nothing matched, is not. For each
/// excess a sentence is appended to `exceeded`, which may be nullptr.
bool within_tolerance(const DistanceReport& report, const CompareTolerance& tolerance,
                      std::vector<std::string>* exceeded);

}  // namespace scarp

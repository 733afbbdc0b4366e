// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/model/compare_options.hpp"
#include "solver/model/comparison_report.hpp"

namespace scarp {

/// A number of a report, or nothing where the report has none of that name.
std::optional<double> find_number(const ComparisonReport& report, const std::string& group, const std::string& measure);

/// Whether the size of every statistic with a tolerance is at most that, and the overlap of footprints at least. One
/// that is NaN, because nothing matched, or that the method does not have, is not. For each excess a sentence is
/// appended to `exceeded`, which may be nullptr.
bool within_tolerance(const ComparisonReport& report, const CompareTolerance& tolerance,
                      std::vector<std::string>* exceeded);

}  // namespace scarp

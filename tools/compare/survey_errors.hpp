// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solver/model/compare_options.hpp"
#include "solver/model/point_cloud.hpp"
#include "tools/compare/error_propagation.hpp"

namespace scarp {

/// What the options say of both sides' errors, for m3c2.detection = "errors".
/// @param local  observed positions in the frame whose origin is `origin`, which the errors are in too
/// @throws Error for a side of which nothing is known, several scanners without the field "scan_position", a covariance
/// that is none, or a convention or average that has no propagation
SurveyErrors survey_errors(const CompareOptions& options, const PointCloud& simulated, const PointCloud& observed,
                           const std::vector<Vec3>& local, const Vec3& origin);

/// How they are propagated, for the report.
std::string in_words(const SurveyErrors& errors);

}  // namespace scarp

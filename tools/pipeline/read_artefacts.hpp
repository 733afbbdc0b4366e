// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/model/frame.hpp"
#include "solver/model/model.hpp"
#include "solver/model/point_cloud.hpp"
#include "tools/pipeline/pipeline.hpp"

namespace scarp {

/// What earlier stages left. Each throws an Error that names the verb to run when its artefact is missing.
SiteFrame read_site(const Project& project);
PointCloud read_cleaned_scan(const Project& project, const std::string& scan, const SiteFrame& site);
Model read_discretized(const Project& project);
/// Paths and times of the frames, in order.
std::vector<std::pair<std::filesystem::path, double>> read_frame_list(const Project& project);

}  // namespace scarp

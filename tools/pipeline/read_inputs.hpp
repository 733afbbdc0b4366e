// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "ingest/ingest.hpp"
#include "solver/model/heightfield.hpp"
#include "solver/model/mesh.hpp"
#include "solver/model/model.hpp"
#include "tools/pipeline/pipeline.hpp"

namespace scarp {

/// Calls `use` for each scan of the scenario as it is cleaned, one at a time, so that only one raw cloud is in
/// memory. The first scan sets the site frame; a later one with another CRS is refused.
/// @returns the site frame (zero origin when there is no scan).
SiteFrame for_each_cleaned_scan(const Project& project,
                                const std::function<void(const ScanOptions&, IngestResult)>& use);

/// The material points of the scenario.
/// @param scans cleaned, local clouds by name; only those that bodies name are needed
Model build_model(const Project& project, const std::map<std::string, PointCloud>& scans, const SiteFrame& site);

/// Names of the scans whose surface some body is made from.
std::vector<std::string> scans_of_bodies(const Scenario& scenario);

/// A raster of elevations in local coordinates. @throws Error where its reference system is another than the site's.
Heightfield local_surface(const std::string& path, const SiteFrame& site);

/// Every file that the scenario reads.
std::vector<std::filesystem::path> input_files(const Scenario& scenario);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "solver/model/comparison_report.hpp"
#include "solver/model/heightfield.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

/// A raster that a comparison made, in its own frame; `name` becomes a part of the file's name.
struct NamedRaster {
  std::string name;
  Heightfield raster;
};

/// What every method of comparison returns.
struct Comparison {
  PointCloud cloud;  ///< the points that were measured, with one scalar per result; empty if none were
  std::vector<NamedRaster> rasters;
  ComparisonReport report;
};

}  // namespace scarp

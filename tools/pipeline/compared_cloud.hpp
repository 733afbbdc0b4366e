// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One side of a comparison of clouds: the points of a file, or the free surface of a frame.
#pragma once

#include <filesystem>

#include "solver/model/comparison_report.hpp"
#include "solver/model/frame.hpp"
#include "solver/model/point_cloud.hpp"
#include "solver/model/scan_options.hpp"

namespace scarp {

struct ComparedCloud {
  PointCloud cloud;
  std::string words = "points";  ///< what they are
  double spacing = 0;            ///< of a frame's material points, m; 0: of other data, or not known
  std::vector<std::string> warnings;
};

/// The free surface of a frame.
ComparedCloud compared(const Frame& frame, int threads);

/// Points in metres, heights included. @throws Error for a file without points, or not in projected metres
PointCloud read_metric_cloud(const std::filesystem::path& path, HeightUnit height_unit);

/// A frame's free surface (.hdf), or the points of a cloud file.
ComparedCloud read_compared(const std::filesystem::path& path, HeightUnit height_unit, int threads);

/// Says in the report what the sides are, before the other groups.
void add_sides(ComparisonReport& report, const ComparedCloud& simulated, const ComparedCloud& observed);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/compared_cloud.hpp"

#include "ingest/localize.hpp"
#include "ingest/read_cloud.hpp"
#include "solver/model/error.hpp"
#include "solver/store/frame_store.hpp"
#include "tools/compare/free_surface.hpp"

namespace scarp {

ComparedCloud compared(const Frame& frame, int threads) {
  FreeSurface surface = free_surface(frame, threads);
  return {std::move(surface.cloud), std::move(surface.words), surface.spacing, std::move(surface.warnings)};
}

PointCloud read_metric_cloud(const std::filesystem::path& path, HeightUnit height_unit) {
  PointCloud cloud = read_cloud(path);
  if (cloud.empty()) throw Error("compare", path.string() + " holds no points", "0 points", "at least 1");
  require_projected_metres(cloud, path.string());
  heights_to_metres(cloud, height_unit, path.string());
  return cloud;
}

ComparedCloud read_compared(const std::filesystem::path& path, HeightUnit height_unit, int threads) {
  if (path.extension() == ".hdf") return compared(read_frame(path), threads);
  return {read_metric_cloud(path, height_unit), "points", 0, {}};
}

void add_sides(ComparisonReport& report, const ComparedCloud& simulated, const ComparedCloud& observed) {
  MeasureGroup group{"sides", "What was compared; spacing of material points, null where there are none.", {}};
  const auto add = [&](const std::string& name, const ComparedCloud& side) {
    group.measures.push_back({name, side.words});
    group.measures.push_back({name + "_spacing", side.spacing > 0 ? side.spacing : NAN, "m"});
    report.warnings.insert(report.warnings.end(), side.warnings.begin(), side.warnings.end());
  };
  add("simulated", simulated);
  add("observed", observed);
  report.groups.insert(report.groups.begin(), std::move(group));
}

}  // namespace scarp

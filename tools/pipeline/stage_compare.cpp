// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <nlohmann/json.hpp>

#include "ingest/localize.hpp"
#include "ingest/read_cloud.hpp"
#include "ingest/write_las.hpp"
#include "ingest/write_raster.hpp"
#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "solver/store/frame_store.hpp"
#include "tools/compare/compare.hpp"
#include "tools/compare/free_surface.hpp"
#include "tools/compare/per_point_csv.hpp"
#include "tools/compare/tolerance.hpp"
#include "tools/pipeline/made_from.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_artefacts.hpp"
#include "tools/pipeline/refuse_to_overwrite.hpp"
#include "tools/pipeline/stopwatch.hpp"
#include "tools/pipeline/summary.hpp"

namespace scarp {
namespace {

using Json = nlohmann::ordered_json;

void write_comparison(const std::filesystem::path& stem, const Comparison& result) {
  write_json(stem.string() + ".json", to_json(result.report));
  for (const NamedRaster& raster : result.rasters)
    write_raster(stem.string() + "_" + raster.name + ".asc", raster.raster);
  if (result.cloud.empty()) return;
  write_whole(stem.string() + ".csv", per_point_csv(result.cloud));
  write_las(stem.string() + ".las", result.cloud);
}

/// A frame's free surface, or a cloud file, in local coordinates.
PointCloud read_either(const std::filesystem::path& path) {
  if (path.extension() == ".hdf") return free_surface(read_frame(path));
  PointCloud cloud = read_cloud(path);
  if (cloud.empty()) throw Error("compare", path.string() + " holds no points", "0 points", "at least 1");
  require_projected_metres(cloud, path.string());
  return cloud;
}

std::string distance_phrase(const DistanceReport& report) {
  char text[256];
  if (report.matched == 0)
    std::snprintf(text, sizeof text, "none of %zu points has a counterpart within %.6g m", report.points,
                  report.max_distance);
  else
    std::snprintf(text, sizeof text,
                  "%zu of %zu points matched, mean %.4g m, median %.4g m, 95 %% within %.4g m, largest %.4g m",
                  report.matched, report.points, report.mean, report.median, report.percentile_95, report.largest);
  return text;
}

}  // namespace

void compare_stage(Project& project, Outcome& outcome) {
  if (project.scenario.compare.empty()) return;
  const Stopwatch watch;
  project.reporter->begin("compare");
  require_made_from(project, Maker::ingest);
  warn_unless_made_from(project, Maker::solver);
  const SiteFrame site = read_site(project);
  const auto frames = read_frame_list(project);
  Json reports = Json::array();
  for (const CompareOptions& options : project.scenario.compare) {
    const auto& path = (options.simulated == SimulatedFrame::last ? frames.back() : frames.front()).first;
    const Comparison result = compare(free_surface(read_frame(path)),
                                      read_cleaned_scan(project, options.observed, site), options, project.threads);
    write_comparison(project.artefacts.compared(options.name, ""), result);
    reports.push_back(to_json(result.report));
    project.reporter->note(in_one_line(result.report));
    within_tolerance(result.report, options.tolerance, &outcome.exceeded);
    project.reporter->progress(static_cast<double>(reports.size()) /
                               static_cast<double>(project.scenario.compare.size()));
  }
  record_summary(project, "compare", {{"comparisons", reports}, {"wall_s", watch.wall()}});
  project.reporter->end();
}

ComparisonReport compare_files(const DirectComparison& request, int threads) {
  const std::string stem = (request.output / request.options.name).string();
  for (const char* extension : {".csv", ".json", ".las"})
    for (const std::filesystem::path& input : {request.simulated, request.observed})
      refuse_to_overwrite(input, stem + extension);
  PointCloud simulated = read_either(request.simulated);
  const PointCloud observed = read_either(request.observed);
  require_same_crs({request.simulated.string(), request.observed.string()}, {simulated.site.crs, observed.site.crs});
  const Comparison result = compare(std::move(simulated), observed, request.options, threads);
  write_comparison(stem, result);
  return result.report;
}

std::string in_one_line(const ComparisonReport& report) {
  std::string line = report.name + ":";
  if (report.distances) line += " " + distance_phrase(*report.distances);
  return line;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <nlohmann/json.hpp>

#include "ingest/localize.hpp"
#include "ingest/read_cloud.hpp"
#include "ingest/write_las.hpp"
#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "solver/store/frame_store.hpp"
#include "tools/compare/compare_nearest.hpp"
#include "tools/compare/free_surface.hpp"
#include "tools/pipeline/made_from.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_artefacts.hpp"
#include "tools/pipeline/refuse_to_overwrite.hpp"
#include "tools/pipeline/stopwatch.hpp"
#include "tools/pipeline/summary.hpp"

namespace scarp {
namespace {

using Json = nlohmann::ordered_json;

void write_comparison(const std::filesystem::path& stem, const NearestComparison& result) {
  write_json(stem.string() + ".json", to_json(result.report));
  write_whole(stem.string() + ".csv", per_point_csv(result.cloud));
  write_las(stem.string() + ".las", result.cloud);
}

std::string distance_sentence(const DistanceReport& report) {
  char text[256];
  std::snprintf(text, sizeof text, "%s: %zu of %zu points matched, mean %.4g m, median %.4g m, 95 %% below %.4g m",
                report.name.c_str(), report.matched, report.points, report.mean, report.median, report.percentile_95);
  return text;
}

/// A frame's free surface, or a cloud file, in local coordinates.
PointCloud read_either(const std::filesystem::path& path) {
  if (path.extension() == ".hdf") return free_surface(read_frame(path));
  PointCloud cloud = read_cloud(path);
  if (cloud.empty()) throw Error("compare", path.string() + " holds no points", "0 points", "at least 1");
  require_projected_metres(cloud, path.string());
  return cloud;
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
    const NearestComparison result =
        compare_nearest(free_surface(read_frame(path)), read_cleaned_scan(project, options.observed, site),
                        options.max_distance, options.name, project.threads);
    write_comparison(project.artefacts.compared(options.name, ""), result);
    reports.push_back(to_json(result.report));
    project.reporter->note(distance_sentence(result.report));
    within_tolerance(result.report, options.tolerance, &outcome.exceeded);
    project.reporter->progress(static_cast<double>(reports.size()) /
                               static_cast<double>(project.scenario.compare.size()));
  }
  record_summary(project, "compare", {{"comparisons", reports}, {"wall_s", watch.wall()}});
  project.reporter->end();
}

DistanceReport compare_files(const DirectComparison& request, int threads) {
  for (const char* extension : {".csv", ".json", ".las"})
    for (const std::filesystem::path& input : {request.simulated, request.observed})
      refuse_to_overwrite(input, (request.output / request.name).string() + extension);
  PointCloud simulated = read_either(request.simulated);
  PointCloud observed = read_either(request.observed);
  require_same_crs({request.simulated.string(), request.observed.string()}, {simulated.site.crs, observed.site.crs});
  const NearestComparison result =
      compare_nearest(std::move(simulated), observed, request.max_distance, request.name, threads);
  write_comparison(request.output / request.name, result);
  return result.report;
}

}  // namespace scarp

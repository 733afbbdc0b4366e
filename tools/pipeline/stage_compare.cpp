// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <nlohmann/json.hpp>

#include "discretize/plane_geometry_cgal.hpp"
#include "ingest/localize.hpp"
#include "ingest/read_cloud.hpp"
#include "ingest/read_mesh.hpp"
#include "ingest/voxel_thin.hpp"
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

/// A file in metres, heights included.
PointCloud read_metric_cloud(const std::filesystem::path& path, HeightUnit height_unit) {
  PointCloud cloud = read_cloud(path);
  if (cloud.empty()) throw Error("compare", path.string() + " holds no points", "0 points", "at least 1");
  require_projected_metres(cloud, path.string());
  heights_to_metres(cloud, height_unit, path.string());
  return cloud;
}

/// A frame's free surface, or a cloud file.
PointCloud read_either(const std::filesystem::path& path, HeightUnit height_unit) {
  return path.extension() == ".hdf" ? free_surface(read_frame(path)) : read_metric_cloud(path, height_unit);
}

/// Where m3c2 measures, if not at all the simulated points.
std::optional<PointCloud> core_points(const CompareOptions& options, const PointCloud& simulated,
                                      HeightUnit height_unit) {
  const M3c2Options& m = options.m3c2;
  if (options.method != CompareMethod::m3c2 || (!m.core_points && m.core_spacing == 0)) return std::nullopt;
  PointCloud cores = m.core_points ? read_metric_cloud(m.core_points->path, height_unit) : simulated;
  if (m.core_points)
    require_same_crs({"the simulated side", m.core_points->path}, {simulated.site.crs, cores.site.crs});
  if (m.core_spacing > 0) select_points(cores, voxel_thin(cores.positions, {.size = m.core_spacing}));
  return cores;
}

/// A scan as a surface z(x, y) with its normals up.
TriangleMesh triangulated(const PointCloud& cloud) {
  Tin tin = triangulate(cloud.positions, 0);
  return {std::move(tin.points), std::move(tin.triangles), cloud.site};
}

Comparison compare_clouds(PointCloud simulated, const PointCloud& observed, const CompareOptions& options,
                          HeightUnit height_unit, int threads) {
  if (options.method == CompareMethod::c2m)
    return compare(std::move(simulated), triangulated(observed), nullptr, options, threads);
  const std::optional<PointCloud> cores = core_points(options, simulated, height_unit);
  return compare(std::move(simulated), observed, cores ? &*cores : nullptr, options, threads);
}

/// Heights in the unit of the request; meshes say nothing of theirs, nor of their reference system.
TriangleMesh read_metric_mesh(const DirectComparison& request) {
  TriangleMesh mesh = read_mesh(request.observed);
  PointCloud vertices;
  vertices.positions = std::move(mesh.vertices);
  heights_to_metres(vertices, request.height_unit, request.observed.string());
  mesh.vertices = std::move(vertices.positions);
  return mesh;
}

ComparisonReport finish(const Comparison& result, const DirectComparison& request, Outcome& outcome) {
  write_comparison(request.output / request.options.name, result);
  within_tolerance(result.report, request.options.tolerance, &outcome.exceeded);
  return result.report;
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
    const Comparison result =
        compare_clouds(free_surface(read_frame(path)), read_cleaned_scan(project, options.observed, site), options,
                       HeightUnit::metre, project.threads);
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

ComparisonReport compare_files(const DirectComparison& request, int threads, Outcome& outcome) {
  const std::string stem = (request.output / request.options.name).string();
  std::vector<std::filesystem::path> inputs{request.simulated, request.observed};
  if (request.options.m3c2.core_points) inputs.emplace_back(request.options.m3c2.core_points->path);
  for (const char* extension : {".csv", ".json", ".las"})
    for (const std::filesystem::path& input : inputs) refuse_to_overwrite(input, stem + extension);
  PointCloud simulated = read_either(request.simulated, request.height_unit);
  if (request.options.method == CompareMethod::c2m && holds_mesh(request.observed))
    return finish(compare(std::move(simulated), read_metric_mesh(request), nullptr, request.options, threads), request,
                  outcome);
  const PointCloud observed = read_either(request.observed, request.height_unit);
  require_same_crs({request.simulated.string(), request.observed.string()}, {simulated.site.crs, observed.site.crs});
  return finish(compare_clouds(std::move(simulated), observed, request.options, request.height_unit, threads), request,
                outcome);
}

std::string in_one_line(const ComparisonReport& report) {
  std::string line = report.name + ":";
  if (report.distances) line += " " + distance_phrase(*report.distances);
  return line;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <nlohmann/json.hpp>

#include "discretize/plane_geometry_cgal.hpp"
#include "ingest/localize.hpp"
#include "ingest/read_mesh.hpp"
#include "ingest/voxel_thin.hpp"
#include "ingest/write_las.hpp"
#include "ingest/write_raster.hpp"
#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "solver/store/frame_store.hpp"
#include "tools/compare/compare.hpp"
#include "tools/compare/displacement.hpp"
#include "tools/compare/per_point_csv.hpp"
#include "tools/compare/tolerance.hpp"
#include "tools/pipeline/compared_cloud.hpp"
#include "tools/pipeline/compared_vectors.hpp"
#include "tools/pipeline/comparison_pictures.hpp"
#include "tools/pipeline/info.hpp"
#include "tools/pipeline/made_from.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_artefacts.hpp"
#include "tools/pipeline/read_inputs.hpp"
#include "tools/pipeline/refuse_to_overwrite.hpp"
#include "tools/pipeline/stopwatch.hpp"
#include "tools/pipeline/summary.hpp"
#include "tools/pipeline/surface_pair.hpp"
#include "tools/render/canvas.hpp"

namespace scarp {
namespace {

using Json = nlohmann::ordered_json;

void write_numbers(const std::filesystem::path& stem, const Comparison& result) {
  write_json(stem.string() + ".json", to_json(result.report));
  for (const NamedRaster& raster : result.rasters)
    write_raster(stem.string() + "_" + raster.name + ".asc", raster.raster);
  if (result.cloud.empty()) return;
  write_whole(stem.string() + ".csv", per_point_csv(result.cloud));
  write_las(stem.string() + ".las", result.cloud);
}

/// Numbers must not be lost to what pictures need: without fonts they come alone, and the report says so.
bool can_draw(const CompareOptions& options, ComparisonReport& report) {
  if (!options.pictures) return false;
  const std::string font = missing_font();
  if (!font.empty())
    report.warnings.push_back("No pictures were drawn: the font " + font +
                              " is not installed (package fonts-dejavu-core).");
  return font.empty();
}

void write_comparison(const std::filesystem::path& stem, Comparison& result, const CompareOptions& options) {
  const bool draw = can_draw(options, result.report);
  write_numbers(stem, result);
  if (draw) write_pictures(stem, result, nullptr, nullptr);
}

/// A frame is a simulation held against an observation; files are two surveys, or fields of which nobody knows, and go
/// by their names.
SideNames names_of_sides(const std::filesystem::path& simulated, const std::filesystem::path& observed) {
  if (simulated.extension() == ".hdf") return {};
  if (simulated.stem() != observed.stem()) return {simulated.stem(), observed.stem()};
  if (simulated.filename() != observed.filename()) return {simulated.filename(), observed.filename()};
  return {"first", "second"};
}

SideNames names_of_sides(const CompareOptions& options) {
  return options.of_frame() ? SideNames{} : SideNames{options.simulated, options.observed};
}

/// Both sides, the mask of stable ground and the ground before on the same cells.
SurfaceComparison on_same_cells(SurfaceSources sources, CompareOptions options, int threads) {
  if (options.dod.stable.ground == StableGround::mask) {
    if (!options.dod.stable.mask)
      throw Error("compare", "stable ground by a mask", "no mask", "dod.stable.mask (--mask)");
    sources.stable_mask = read_surface_source(options.dod.stable.mask->path, HeightUnit::metre);
  }
  const SurfacePair pair = make_surface_pair(std::move(sources), options, threads);
  return options.method == CompareMethod::dod ? compare_surfaces(pair, options) : compare_thickness(pair, options);
}

void write_comparison(const std::filesystem::path& stem, SurfaceComparison& result, const CompareOptions& options) {
  const bool draw = can_draw(options, result.comparison.report);
  write_numbers(stem, result.comparison);
  if (result.section) write_whole(stem.string() + "_section.csv", section_csv(*result.section));
  if (draw)
    write_pictures(stem, result.comparison, result.ground ? &*result.ground : nullptr,
                   result.section ? &*result.section : nullptr);
}

Comparison compare_vectors(const std::filesystem::path& stem, const DisplacementSources& sources,
                           const SideNames& names, const CompareOptions& options, int threads) {
  Comparison result = compare_displacement(sources, options, threads);
  result.report.sides = names;
  const bool draw = can_draw(options, result.report);
  write_numbers(stem, result);
  if (draw) write_vector_pictures(stem, result, ground_of(sources, result.cloud));
  return result;
}

bool by_rasters(const CompareOptions& options) {
  return options.method == CompareMethod::dod || options.method == CompareMethod::footprint;
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

Comparison compare_clouds(ComparedCloud simulated, const ComparedCloud& observed, CompareOptions options,
                          HeightUnit height_unit, int threads) {
  if (options.simulated_spacing == 0) options.simulated_spacing = simulated.spacing;
  const ComparedCloud words{{}, simulated.words, simulated.spacing, simulated.warnings};
  const std::optional<PointCloud> cores = core_points(options, simulated.cloud, height_unit);
  ComparedSide side;
  if (options.method == CompareMethod::c2m)
    side = triangulated(observed.cloud);
  else
    side = observed.cloud;
  Comparison result = compare(std::move(simulated.cloud), side, cores ? &*cores : nullptr, options, threads);
  add_sides(result.report, words, observed);
  return result;
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

ComparisonReport finish(Comparison result, const DirectComparison& request, Outcome& outcome) {
  result.report.sides = names_of_sides(request.simulated, request.observed);
  write_comparison(request.output / request.options.name, result, request.options);
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

/// The frame that a comparison names.
Frame frame_of(const Project& project, const CompareOptions& options) {
  const auto frames = read_frame_list(project);
  return read_frame((options.simulated == kLastFrame ? frames.back() : frames.front()).first);
}

ComparedCloud cleaned(const Project& project, const std::string& scan, const SiteFrame& site) {
  return {read_cleaned_scan(project, scan, site), "scan, cleaned", 0, {}};
}

ComparisonReport compare_as_clouds(const Project& project, const CompareOptions& options, const SiteFrame& site) {
  ComparedCloud simulated = options.of_frame() ? compared(frame_of(project, options), project.threads)
                                               : cleaned(project, options.simulated, site);
  Comparison result = compare_clouds(std::move(simulated), cleaned(project, options.observed, site), options,
                                     HeightUnit::metre, project.threads);
  result.report.sides = names_of_sides(options);
  write_comparison(project.artefacts.compared(options.name, ""), result, options);
  return result.report;
}

/// A raster that nothing was cleaned from keeps its cells; other scans are points.
SurfaceSource surface_of_scan(const Project& project, const std::string& name, const SiteFrame& site) {
  for (const ScanOptions& scan : project.scenario.scans)
    if (scan.name == name && scan.file && scan.clean.empty() && scan.height_unit == HeightUnit::metre &&
        scan.shift == Vec3{0, 0, 0} && holds_raster(scan.file->path))
      return local_surface(scan.file->path, site);
  return read_cleaned_scan(project, name, site);
}

ComparisonReport compare_as_rasters(const Project& project, const CompareOptions& options, const SiteFrame& site) {
  if (options.method == CompareMethod::footprint && options.of_frame())
    throw Error("compare", "comparison \"" + options.name + "\": method footprint takes two rasters of thickness",
                "a frame and a scan", "method = \"dod\" with a scan of the ground before");
  SurfaceSources sources{options.of_frame() ? SurfaceSource(frame_of(project, options))
                                            : surface_of_scan(project, options.simulated, site),
                         surface_of_scan(project, options.observed, site),
                         {},
                         {}};
  if (options.before) sources.before = surface_of_scan(project, *options.before, site);
  SurfaceComparison result = on_same_cells(std::move(sources), options, project.threads);
  result.comparison.report.sides = names_of_sides(options);
  write_comparison(project.artefacts.compared(options.name, ""), result, options);
  return result.comparison.report;
}

ComparisonReport compare_as_vectors(const Project& project, const CompareOptions& options, const SiteFrame& site) {
  std::variant<PointCloud, Frame> first;
  if (options.of_frame())
    first = frame_of(project, options);
  else
    first = read_cleaned_scan(project, options.simulated, site);
  std::optional<PointCloud> before;
  if (options.before) before = read_cleaned_scan(project, *options.before, site);
  const DisplacementSources sources =
      vector_sources(std::move(first), read_cleaned_scan(project, options.observed, site), std::move(before), options,
                     HeightUnit::metre);
  return compare_vectors(project.artefacts.compared(options.name, ""), sources, names_of_sides(options), options,
                         project.threads)
      .report;
}

ComparisonReport compare_files_as_vectors(const DirectComparison& request, int threads) {
  std::variant<PointCloud, Frame> first;
  if (request.simulated.extension() == ".hdf")
    first = read_frame(request.simulated);
  else
    first = read_metric_cloud(request.simulated, request.height_unit);
  std::optional<PointCloud> before;
  if (request.options.before) before = read_metric_cloud(*request.options.before, request.height_unit);
  const DisplacementSources sources =
      vector_sources(std::move(first), read_metric_cloud(request.observed, request.height_unit), std::move(before),
                     request.options, request.height_unit);
  return compare_vectors(request.output / request.options.name, sources,
                         names_of_sides(request.simulated, request.observed), request.options, threads)
      .report;
}

ComparisonReport compare_files_as_rasters(const DirectComparison& request, int threads) {
  SurfaceSources sources{read_surface_source(request.simulated, request.height_unit),
                         read_surface_source(request.observed, request.height_unit),
                         {},
                         {}};
  std::vector<std::string> names{request.simulated.string(), request.observed.string()};
  std::vector<std::string> crs{site_of(sources.simulated).crs, site_of(sources.observed).crs};
  if (request.options.before) {
    sources.before = read_surface_source(*request.options.before, request.height_unit);
    names.push_back(*request.options.before);
    crs.push_back(site_of(*sources.before).crs);
  }
  require_same_crs(names, crs);
  SurfaceComparison result = on_same_cells(std::move(sources), request.options, threads);
  result.comparison.report.sides = names_of_sides(request.simulated, request.observed);
  write_comparison(request.output / request.options.name, result, request.options);
  return result.comparison.report;
}

}  // namespace

void compare_stage(Project& project, Outcome& outcome) {
  if (project.scenario.compare.empty()) return;
  const Stopwatch watch;
  project.reporter->begin("compare");
  require_made_from(project, Maker::ingest);
  if (!project.scenario.only_surveys()) warn_unless_made_from(project, Maker::solver);
  const SiteFrame site = read_site(project);
  Json reports = Json::array();
  for (const CompareOptions& options : project.scenario.compare) {
    const ComparisonReport report = options.method == CompareMethod::displacement
                                        ? compare_as_vectors(project, options, site)
                                    : by_rasters(options) ? compare_as_rasters(project, options, site)
                                                          : compare_as_clouds(project, options, site);
    reports.push_back(to_json(report));
    project.reporter->note(in_one_line(report));
    for (const std::string& warning : report.warnings) project.reporter->note("warning: " + warning);
    within_tolerance(report, options.tolerance, &outcome.exceeded);
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
  if (request.options.before) inputs.emplace_back(*request.options.before);
  if (request.options.displacement.targets) inputs.emplace_back(request.options.displacement.targets->path);
  if (request.options.dod.stable.mask) inputs.emplace_back(request.options.dod.stable.mask->path);
  for (const char* extension :
       {".csv", ".json", ".las", "_difference.asc", "_level_of_detection.asc", "_footprint.asc", "_section.csv",
        "_difference.png", "_histogram.png", "_footprint.png", "_section.png", "_vectors.png"})
    for (const std::filesystem::path& input : inputs) refuse_to_overwrite(input, stem + extension);
  if (by_rasters(request.options) || request.options.method == CompareMethod::displacement) {
    const ComparisonReport report = by_rasters(request.options) ? compare_files_as_rasters(request, threads)
                                                                : compare_files_as_vectors(request, threads);
    within_tolerance(report, request.options.tolerance, &outcome.exceeded);
    return report;
  }
  ComparedCloud simulated = read_compared(request.simulated, request.height_unit, threads);
  if (request.options.method == CompareMethod::c2m && holds_mesh(request.observed)) {
    const ComparedCloud mesh{{}, "mesh", 0, {}}, words{{}, simulated.words, simulated.spacing, simulated.warnings};
    Comparison result =
        compare(std::move(simulated.cloud), read_metric_mesh(request), nullptr, request.options, threads);
    add_sides(result.report, words, mesh);
    return finish(result, request, outcome);
  }
  const ComparedCloud observed = read_compared(request.observed, request.height_unit, threads);
  require_same_crs({request.simulated.string(), request.observed.string()},
                   {simulated.cloud.site.crs, observed.cloud.site.crs});
  return finish(compare_clouds(std::move(simulated), observed, request.options, request.height_unit, threads), request,
                outcome);
}

std::string in_one_line(const ComparisonReport& report) {
  std::string line = report.name + ":";
  if (report.distances) line += " " + distance_phrase(*report.distances);
  const auto number = [&](const char* group, const char* measure) { return find_number(report, group, measure); };
  char text[256];
  if (const auto net = number("volumes", "net")) {
    std::snprintf(text, sizeof text, " added %.6g m3, removed %.6g m3, net %.6g m3; detected above %.3g m: %.3g %%",
                  *number("volumes", "added"), *number("volumes", "removed"), *net,
                  *number("significance", "level_of_detection"), *number("significance", "significant_share"));
    line += text;
  }
  if (const auto iou = number("footprint", "iou")) {
    std::snprintf(text, sizeof text, " footprint IoU %.3g, precision %.3g, recall %.3g", *iou,
                  *number("footprint", "precision"), *number("footprint", "recall"));
    line += text;
  }
  return line;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/ingest.hpp"

#include "ingest/clean.hpp"
#include "ingest/localize.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

std::string source_of(const ScanOptions& options) {
  return options.file ? options.file->path : "scan \"" + options.name + "\"";
}

/// Returns how many were dropped.
std::size_t drop_not_finite(PointCloud& cloud) {
  std::vector<std::size_t> finite;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (is_finite(cloud.positions[i])) finite.push_back(i);
  const std::size_t dropped = cloud.size() - finite.size();
  if (dropped > 0) select_points(cloud, finite);
  return dropped;
}

std::string extent_of(const Box3& box, const Vec3& origin) {
  std::string text;
  for (int a = 0; a < 3; ++a)
    text += std::string(a ? ", " : "") + "xyz"[a] + " " + shortest(box.min[a] + origin[a]) + " to " +
            shortest(box.max[a] + origin[a]);
  return text;
}

/// One cleaning step; what a filter refuses is said with the scan and the step.
CleanReport apply_step(PointCloud& cloud, const ScanOptions& options, std::size_t step, int threads) {
  const Box3 before = bounds(cloud.positions);
  const std::string here = source_of(options) + ": clean step " + std::to_string(step + 1);
  CleanReport report;
  try {
    report = clean(cloud, options.clean[step], threads);
  } catch (const Error& error) {
    throw Error("ingest", here + ": " + error.what());
  }
  if (cloud.empty())
    throw Error("ingest", here + " (" + report.filter + ") removes the last point",
                std::to_string(report.before) + " points within " + extent_of(before, cloud.site.origin),
                "a step that keeps at least 1 point");
  return report;
}

}  // namespace

IngestResult ingest(PointCloud raw, const ScanOptions& options, const Vec3& origin, int threads) {
  IngestResult result{std::move(raw), {}};
  PointCloud& cloud = result.cloud;
  IngestReport& report = result.report;
  report.scan = options.name;
  report.points_read = cloud.size();
  if (cloud.empty()) throw Error("ingest", source_of(options) + " holds no points", "0 points", "at least 1");
  report.not_finite = drop_not_finite(cloud);
  if (cloud.empty())
    throw Error("ingest", source_of(options) + ": no point has finite coordinates",
                std::to_string(report.points_read) + " points, all NaN or infinite", "at least 1 finite point");
  require_projected_metres(cloud, source_of(options));
  heights_to_metres(cloud, options.height_unit, source_of(options));
  localize(cloud, origin);
  for (std::size_t step = 0; step < options.clean.size(); ++step)
    report.steps.push_back(apply_step(cloud, options, step, threads));
  report.points_kept = cloud.size();
  report.bounds = bounds(cloud.positions);
  return result;
}

}  // namespace scarp

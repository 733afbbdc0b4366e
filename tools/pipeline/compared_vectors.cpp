// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/compared_vectors.hpp"

#include <algorithm>
#include <cmath>

#include "ingest/localize.hpp"
#include "tools/compare/common_frame.hpp"
#include "tools/compare/raster_grid.hpp"
#include "tools/pipeline/compared_cloud.hpp"

namespace scarp {

DisplacementSources vector_sources(std::variant<PointCloud, Frame> first, PointCloud second,
                                   std::optional<PointCloud> before, const CompareOptions& options,
                                   HeightUnit height_unit) {
  DisplacementSources sources;
  std::vector<std::string> names, crs;
  const auto note = [&](const std::string& name, const SiteFrame& site) {
    names.push_back(name);
    crs.push_back(site.crs);
  };
  std::visit([&](const auto& side) { note("the simulated side", side.site); }, first);
  note("the observed side", second.site);
  if (before) note("the survey before", before->site);
  sources.before = std::move(before);
  if (auto* frame = std::get_if<Frame>(&first))
    sources.simulated = std::move(*frame);
  else
    sources.before = std::move(std::get<PointCloud>(first));
  if (options.displacement.targets) {
    sources.targets = read_metric_cloud(options.displacement.targets->path, height_unit);
    note(options.displacement.targets->path, sources.targets->site);
  }
  (find_scalar(second, "dx") && !sources.targets ? sources.targets : sources.after) = std::move(second);
  require_same_crs(names, crs);
  return sources;
}

Heightfield ground_of(const DisplacementSources& sources, const PointCloud& places) {
  const PointCloud& cloud = sources.before ? *sources.before : places;
  const std::vector<Vec3> points = moved(cloud.positions, cloud.site.origin, places.site.origin);
  const Box3 box = bounds(points);
  const double wide = box.max[0] - box.min[0], high = box.max[1] - box.min[1], edge = std::max({wide, high, 1e-3});
  // Room for arrows, which are drawn about as long as places are apart.
  const double apart = std::min(0.3 * edge, std::sqrt(wide * high / static_cast<double>(places.size())) + 0.03 * edge);
  const std::vector<Vec3> corners{box.min - Vec3{apart, apart, 0}, box.max + Vec3{apart, apart, 0}};
  if (!sources.before) return empty_raster(covering_grid(corners, edge / 100), places.site);
  const double cell = 1.5 * std::sqrt(std::max(1e-12, wide * high) / static_cast<double>(points.size()));
  return grid_points(points, places.site, covering_grid(corners, cell), CellPolicy::mean, nullptr);
}

}  // namespace scarp

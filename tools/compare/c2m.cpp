// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/c2m.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/core/triangle_tree.hpp"
#include "solver/model/parallel.hpp"
#include "tools/compare/common_frame.hpp"
#include "tools/compare/statistics.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// "distance", "dx", "dy", "dz", "beyond_border", in this order.
std::vector<PointScalar> measure(const std::vector<Vec3>& simulated, const TriangleTree& tree, double max_distance,
                                 int threads) {
  std::vector<PointScalar> scalars{
      {"distance", "m", {}}, {"dx", "m", {}}, {"dy", "m", {}}, {"dz", "m", {}}, {"beyond_border", "1", {}}};
  for (PointScalar& scalar : scalars) scalar.values.assign(simulated.size(), kNaN);
  parallel_for(simulated.size(), threads, [&](std::size_t i) {
    const auto closest = tree.closest(simulated[i], max_distance);
    if (!closest) return;
    const double distance = std::sqrt(closest->squared_distance);
    scalars[0].values[i] = tree.side(simulated[i], *closest) < 0 ? -distance : distance;
    for (std::size_t a = 0; a < 3; ++a) scalars[1 + a].values[i] = closest->point[a] - simulated[i][a];
    scalars[4].values[i] = tree.on_border(*closest);
  });
  return scalars;
}

MeasureGroup mesh_group(const TriangleMesh& mesh, const TriangleTree& tree, const std::vector<double>& beyond) {
  return {
      "mesh",
      "Normals are those of the triangles, counter-clockwise seen from outside; triangles without area are left out; "
      "bad edges have more than two triangles, or two that disagree about the side. points_beyond_border: nearest "
      "to the border of an open mesh, where a point may have no counterpart.",
      {{"triangles", static_cast<std::int64_t>(mesh.triangles.size())},
       {"triangles_without_area", static_cast<std::int64_t>(tree.triangles_left_out())},
       {"border_edges", static_cast<std::int64_t>(tree.border_edges())},
       {"bad_edges", static_cast<std::int64_t>(tree.bad_edges())},
       {"points_beyond_border", static_cast<std::int64_t>(std::count(beyond.begin(), beyond.end(), 1.0))}}};
}

}  // namespace

Comparison compare_c2m(PointCloud simulated, const TriangleMesh& observed, const CompareOptions& options, int threads) {
  require_max_distance(options);
  require_points(simulated, "simulated");
  const Vec3 origin = common_origin(simulated.site, observed.site);
  TriangleMesh mesh{moved(observed.vertices, observed.site.origin, origin), observed.triangles, {}};
  const TriangleTree tree(mesh);
  std::vector<PointScalar> scalars =
      measure(moved(simulated.positions, simulated.site.origin, origin), tree, options.max_distance, threads);
  Comparison result{std::move(simulated), {}, start_report(options)};
  result.report.distances =
      distance_statistics(scalars[0].values, options.max_distance,
                          "Distance from each simulated point to the nearest point of the observed mesh, positive on "
                          "the side to which its normals point (angle-weighted normals at edges and vertices), null "
                          "beyond max_distance.");
  result.report.groups = {mesh_group(mesh, tree, scalars[4].values)};
  if (tree.bad_edges() > 0)
    result.report.warnings.push_back("The observed mesh has " + std::to_string(tree.bad_edges()) +
                                     " edges of more than two triangles or of two that disagree about the side: signs "
                                     "near them are not to be trusted.");
  put_first(result.cloud, std::move(scalars));
  return result;
}

}  // namespace scarp

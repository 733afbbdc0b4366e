// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/c2c.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ingest/neighbours/neighbours.hpp"
#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "tools/compare/common_frame.hpp"
#include "tools/compare/hausdorff.hpp"
#include "tools/compare/local_surface.hpp"
#include "tools/compare/statistics.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<PointScalar> empty_scalars(std::size_t points, bool with_model) {
  std::vector<PointScalar> scalars{{"distance", "m", {}}, {"dx", "m", {}}, {"dy", "m", {}}, {"dz", "m", {}}};
  if (with_model) scalars.push_back({"signed_distance", "m", {}});
  for (PointScalar& scalar : scalars) scalar.values.assign(points, kNaN);
  return scalars;
}

/// Distance from p to the surface through the observed points around `nearest`, positive where the surface is above;
/// NaN where they span none.
double to_local_surface(const Vec3& p, const Vec3& nearest, const std::vector<Vec3>& observed,
                        const Neighbours& neighbours, const C2cOptions& options) {
  std::vector<Vec3> points;
  for (const Neighbour& n : neighbours.nearest(nearest, static_cast<std::size_t>(options.model_neighbours)))
    points.push_back(observed[n.index]);
  const auto surface = LocalSurface::fit(points, options.local_model == LocalModel::quadric);
  return surface ? -surface->distance(p) : kNaN;
}

/// "distance", "dx", "dy", "dz" and, with a local model, "signed_distance", in this order.
std::vector<PointScalar> measure(const std::vector<Vec3>& simulated, const std::vector<Vec3>& observed,
                                 const Neighbours& neighbours, const CompareOptions& options, int threads) {
  const bool with_model = options.c2c.local_model != LocalModel::nearest;
  std::vector<PointScalar> scalars = empty_scalars(simulated.size(), with_model);
  parallel_for(simulated.size(), threads, [&](std::size_t i) {
    const auto nearest = neighbours.closest(simulated[i], options.max_distance);
    if (!nearest) return;
    const Vec3& there = observed[nearest->index];
    const Vec3 d = there - simulated[i];
    double distance = std::sqrt(nearest->squared_distance);
    if (with_model) {
      const double to_surface = to_local_surface(simulated[i], there, observed, neighbours, options.c2c);
      scalars[4].values[i] = to_surface;
      if (std::abs(to_surface) < distance) distance = std::abs(to_surface);
    }
    scalars[0].values[i] = distance;
    for (std::size_t a = 0; a < 3; ++a) scalars[1 + a].values[i] = d[a];
  });
  return scalars;
}

std::string convention(const C2cOptions& options) {
  const std::string nearest =
      "Unsigned distance from each simulated point to the nearest observed point, null beyond max_distance.";
  if (options.local_model == LocalModel::nearest) return nearest;
  return nearest + " Where it is less, the distance to a " +
         (options.local_model == LocalModel::plane ? "least-squares plane" : "quadratic height function") +
         " through " + std::to_string(options.model_neighbours) +
         " observed points around that takes its place; signed_distance is that to the model, positive where the model "
         "lies above the point, null where the points span none.";
}

MeasureGroup model_group(const C2cOptions& options, const std::vector<PointScalar>& scalars) {
  const std::vector<double>& distances = scalars[0].values;
  std::int64_t without = 0;
  for (std::size_t i = 0; i < distances.size(); ++i)
    without += !std::isnan(distances[i]) && std::isnan(scalars[4].values[i]);
  return {"local_model",
          "points_without_model: their neighbours span no such surface; the distance to the nearest point stands.",
          {{"model", std::string(name_of(options.local_model))},
           {"neighbours", static_cast<std::int64_t>(options.model_neighbours)},
           {"points_without_model", without}}};
}

}  // namespace

Comparison compare_c2c(PointCloud simulated, const PointCloud& observed, const CompareOptions& options, int threads) {
  require_max_distance(options);
  require_points(simulated, "simulated");
  require_points(observed, "observed");
  const Vec3 origin = common_origin(simulated.site, observed.site);
  const std::vector<Vec3> from = moved(simulated.positions, simulated.site.origin, origin);
  const std::vector<Vec3> to = moved(observed.positions, observed.site.origin, origin);
  const Neighbours near_observed(to);
  std::vector<PointScalar> scalars = measure(from, to, near_observed, options, threads);
  Comparison result{std::move(simulated), {}, start_report(options)};
  result.report.distances = distance_statistics(scalars[0].values, options.max_distance, convention(options.c2c));
  result.report.groups = {set_distances(from, to, Neighbours(from), near_observed, threads)};
  if (scalars.size() > 4) result.report.groups.push_back(model_group(options.c2c, scalars));
  put_first(result.cloud, std::move(scalars));
  return result;
}

}  // namespace scarp

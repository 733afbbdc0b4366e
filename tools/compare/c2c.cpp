// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/c2c.hpp"

#include <limits>

#include "ingest/neighbours/neighbours.hpp"
#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "tools/compare/common_frame.hpp"
#include "tools/compare/statistics.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// "distance", "dx", "dy", "dz", in this order.
std::vector<PointScalar> measure(const std::vector<Vec3>& simulated, const std::vector<Vec3>& observed,
                                 double max_distance, int threads) {
  const Neighbours neighbours(observed);
  std::vector<PointScalar> split{{"distance", "m", {}}, {"dx", "m", {}}, {"dy", "m", {}}, {"dz", "m", {}}};
  for (PointScalar& scalar : split) scalar.values.assign(simulated.size(), kNaN);
  parallel_for(simulated.size(), threads, [&](std::size_t i) {
    const auto nearest = neighbours.closest(simulated[i], max_distance);
    if (!nearest) return;
    const Vec3 d = observed[nearest->index] - simulated[i];
    split[0].values[i] = std::sqrt(nearest->squared_distance);
    for (std::size_t a = 0; a < 3; ++a) split[1 + a].values[i] = d[a];
  });
  return split;
}

}  // namespace

Comparison compare_c2c(PointCloud simulated, const PointCloud& observed, const CompareOptions& options, int threads) {
  require_max_distance(options);
  require_points(simulated, "simulated");
  require_points(observed, "observed");
  const Vec3 origin = common_origin(simulated.site, observed.site);
  std::vector<PointScalar> split =
      measure(moved(simulated.positions, simulated.site.origin, origin),
              moved(observed.positions, observed.site.origin, origin), options.max_distance, threads);
  Comparison result{std::move(simulated), {}, start_report(options)};
  result.report.distances = distance_statistics(split[0].values, options.max_distance,
                                                "Unsigned distance from each simulated point to the nearest observed "
                                                "point, null beyond max_distance.");
  put_first(result.cloud, std::move(split));
  return result;
}

}  // namespace scarp

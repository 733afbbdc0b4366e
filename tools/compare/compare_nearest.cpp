// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/compare_nearest.hpp"

#include <algorithm>
#include <limits>

#include "ingest/neighbours/neighbours.hpp"
#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "tools/compare/statistics.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void require_points(const PointCloud& cloud, const char* which) {
  if (cloud.empty()) throw Error("compare", std::string("the ") + which + " cloud is empty", "0 points", "at least 1");
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (!is_finite(cloud.positions[i]))
      throw Error("compare", "point " + std::to_string(i) + " of the " + which + " cloud is not finite");
}

/// Near the farther origin coordinates are small, so that moving there loses no digit; moving away from it would.
Vec3 common_origin(const PointCloud& a, const PointCloud& b) {
  return norm(a.site.origin) >= norm(b.site.origin) ? a.site.origin : b.site.origin;
}

std::vector<Vec3> moved(std::vector<Vec3> positions, const Vec3& shift) {
  if (shift != Vec3{0, 0, 0})
    for (Vec3& p : positions) p = p + shift;
  return positions;
}

/// "distance", "dx", "dy", "dz", in this order.
using Split = std::array<PointScalar, 4>;

Split empty_split(std::size_t points) {
  Split split{PointScalar{"distance", "m", {}}, {"dx", "m", {}}, {"dy", "m", {}}, {"dz", "m", {}}};
  for (PointScalar& scalar : split) scalar.values.assign(points, kNaN);
  return split;
}

Split measure(const std::vector<Vec3>& simulated, const std::vector<Vec3>& observed, double max_distance, int threads) {
  const Neighbours neighbours(observed);
  Split split = empty_split(simulated.size());
  parallel_for(simulated.size(), threads, [&](std::size_t i) {
    const auto nearest = neighbours.closest(simulated[i], max_distance);
    if (!nearest) return;
    const Vec3 d = observed[nearest->index] - simulated[i];
    split[0].values[i] = std::sqrt(nearest->squared_distance);
    for (int a = 0; a < 3; ++a) split[1 + a].values[i] = d[a];
  });
  return split;
}

/// Puts the new scalars first; older ones of the same names give way.
void put_first(PointCloud& cloud, Split split) {
  std::erase_if(cloud.scalars, [&](const PointScalar& old) {
    return std::any_of(split.begin(), split.end(), [&](const PointScalar& s) { return s.name == old.name; });
  });
  cloud.scalars.insert(cloud.scalars.begin(), std::make_move_iterator(split.begin()),
                       std::make_move_iterator(split.end()));
}

}  // namespace

NearestComparison compare_nearest(PointCloud simulated, const PointCloud& observed, double max_distance,
                                  const std::string& name, int threads) {
  if (!(max_distance > 0))
    throw Error("compare", "max_distance of comparison \"" + name + "\"", shortest(max_distance), "above 0 m");
  require_points(simulated, "simulated");
  require_points(observed, "observed");
  const Vec3 origin = common_origin(simulated, observed);
  Split split = measure(moved(simulated.positions, simulated.site.origin - origin),
                        moved(observed.positions, observed.site.origin - origin), max_distance, threads);
  NearestComparison result{std::move(simulated), distance_statistics(split[0].values)};
  result.report.name = name;
  result.report.method = "nearest";
  result.report.max_distance = max_distance;
  put_first(result.cloud, std::move(split));
  return result;
}

}  // namespace scarp

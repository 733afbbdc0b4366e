// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/hausdorff.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/parallel.hpp"
#include "tools/compare/statistics.hpp"

namespace scarp {
namespace {

/// From every point to the nearest of the other cloud, ascending.
std::vector<double> nearest_distances(const std::vector<Vec3>& points, const Neighbours& others, int threads) {
  std::vector<double> distances(points.size());
  parallel_for(points.size(), threads,
               [&](std::size_t i) { distances[i] = std::sqrt(others.closest(points[i])->squared_distance); });
  std::sort(distances.begin(), distances.end());
  return distances;
}

double mean_power(const std::vector<double>& distances, int power) {
  double sum = 0;
  for (double d : distances) sum += power == 2 ? d * d : d;
  return sum / static_cast<double>(distances.size());
}

}  // namespace

MeasureGroup set_distances(const std::vector<Vec3>& simulated, const std::vector<Vec3>& observed,
                           const Neighbours& near_simulated, const Neighbours& near_observed, int threads) {
  const std::vector<double> there = nearest_distances(simulated, near_observed, threads);
  const std::vector<double> back = nearest_distances(observed, near_simulated, threads);
  const double there95 = quantile(there, 0.95), back95 = quantile(back, 0.95);
  return {"sets",
          "S simulated, O observed points, d(p, Q) the Euclidean distance from p to the nearest point of Q, without a "
          "limit. hausdorff_to_observed = max over S of d(s, O); hausdorff_to_simulated = max over O of d(o, S); "
          "hausdorff = the larger; _95 with the 95th percentile for the max. chamfer = mean over S of d(s, O) + mean "
          "over O of d(o, S), a sum, not half of it; chamfer_squared = the same of d^2.",
          {{"hausdorff_to_observed", there.back(), "m"},
           {"hausdorff_to_simulated", back.back(), "m"},
           {"hausdorff", std::max(there.back(), back.back()), "m"},
           {"hausdorff_95_to_observed", there95, "m"},
           {"hausdorff_95_to_simulated", back95, "m"},
           {"hausdorff_95", std::max(there95, back95), "m"},
           {"chamfer", mean_power(there, 1) + mean_power(back, 1), "m"},
           {"chamfer_squared", mean_power(there, 2) + mean_power(back, 2), "m2"}}};
}

}  // namespace scarp

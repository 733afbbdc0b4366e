// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/detection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/compare/statistics.hpp"

namespace scarp {

std::vector<double> significant(const std::vector<double>& distances, const std::vector<double>& detections) {
  std::vector<double> flags(distances.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < flags.size(); ++i)
    if (!std::isnan(distances[i]) && !std::isnan(detections[i])) flags[i] = std::abs(distances[i]) > detections[i];
  return flags;
}

MeasureGroup beyond_noise(const std::vector<double>& distances, const std::vector<double>& detections) {
  const std::vector<double> flags = significant(distances, detections);
  std::int64_t count = 0, above = 0, below = 0;
  double misfit = 0, noise = 0, excess = 0;
  std::vector<double> levels;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (std::isnan(flags[i])) continue;
    const double d = distances[i], sigma = detections[i] / 1.96;
    ++count;
    levels.push_back(detections[i]);
    above += flags[i] == 1 && d > 0;
    below += flags[i] == 1 && d < 0;
    misfit += d * d;
    noise += sigma * sigma;
    excess += std::max(0.0, std::abs(d) - detections[i]);
  }
  std::sort(levels.begin(), levels.end());
  const auto n = static_cast<double>(count);
  double sum = 0;
  for (double level : levels) sum += level;
  return {"detection",
          "Over points with a distance d and a level of detection lod at 95 %, whose standard deviation is lod / 1.96. "
          "significant: abs(d) > lod; above: the observed surface lies on the normal's side of the simulated one; "
          "mean_excess: mean of max(0, abs(d) - lod); misfit_beyond_noise: sqrt(max(0, mean d^2 - mean (lod/1.96)^2)), "
          "what noise does not explain.",
          {{"points", count},
           {"significant", above + below},
           {"significant_above", above},
           {"significant_below", below},
           {"significant_share", 100 * static_cast<double>(above + below) / n, "%"},
           {"mean_lod", sum / n, "m"},
           {"median_lod", quantile(levels, 0.5), "m"},
           {"noise", std::sqrt(noise / n), "m"},
           {"misfit", std::sqrt(misfit / n), "m"},
           {"misfit_beyond_noise", std::sqrt(std::max(0.0, misfit - noise) / n), "m"},
           {"mean_excess", excess / n, "m"}}};
}

}  // namespace scarp

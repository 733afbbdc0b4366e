// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/stable_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/model/error.hpp"
#include "tools/compare/statistics.hpp"
#include "tools/compare/volume_uncertainty.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFewest = 30;

/// Derivative along one axis from what neighbours there are.
double derivative(double before, double here, double after, double cell) {
  if (!std::isnan(before) && !std::isnan(after)) return (after - before) / (2 * cell);
  if (!std::isnan(after)) return (after - here) / cell;
  return (here - before) / cell;
}

std::vector<double> chosen_values(const Heightfield& difference, const std::vector<std::uint8_t>& stable) {
  std::vector<double> values;
  for (std::size_t i = 0; i < stable.size(); ++i)
    if (stable[i]) values.push_back(difference.z[i]);
  std::sort(values.begin(), values.end());
  return values;
}

bool candidate(const Heightfield& difference, std::size_t i, double slope, const StableOptions& options,
               const Heightfield* mask) {
  if (std::isnan(difference.z[i]) || !(slope <= options.steepest)) return false;
  if (options.ground == StableGround::mask) return !std::isnan(mask->z[i]) && mask->z[i] != 0;
  if (options.ground != StableGround::polygon) return true;
  const RasterGrid grid = grid_of(difference);
  const int columns = grid.columns;
  return inside_polygon(options.polygon, grid.x(static_cast<int>(i % columns)), grid.y(static_cast<int>(i / columns)));
}

int clip(const Heightfield& difference, double deviations, std::vector<std::uint8_t>& stable) {
  for (int round = 1;; ++round) {
    const RobustSpread spread = robust_spread(chosen_values(difference, stable));
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < stable.size(); ++i) {
      if (!stable[i] || std::abs(difference.z[i] - spread.median) <= deviations * spread.nmad) continue;
      stable[i] = 0;
      ++left_out;
    }
    if (left_out == 0) return round;
  }
}

std::string in_words(const StableOptions& options) {
  const std::string slope = "slope of the observed surface up to " + shortest(options.steepest) + " deg";
  if (options.ground == StableGround::polygon) return "cells inside the given polygon, " + slope;
  if (options.ground == StableGround::mask) return "cells of the given mask, " + slope;
  return "automatic: " + slope + ", differences within " + shortest(options.clip) +
         " x nmad of the median, repeated until none is left out";
}

}  // namespace

std::vector<double> slopes(const Heightfield& surface) {
  std::vector<double> result(surface.z.size(), kNaN);
  const auto at = [&](int c, int r) {
    return c >= 0 && r >= 0 && c < surface.columns && r < surface.rows ? surface.at(c, r) : kNaN;
  };
  for (int r = 0; r < surface.rows; ++r)
    for (int c = 0; c < surface.columns; ++c) {
      const double dx = derivative(at(c - 1, r), at(c, r), at(c + 1, r), surface.cell);
      const double dy = derivative(at(c, r - 1), at(c, r), at(c, r + 1), surface.cell);
      result[static_cast<std::size_t>(r) * surface.columns + c] =
          std::atan(std::hypot(dx, dy)) * 180 / std::numbers::pi;
    }
  return result;
}

StableCells find_stable(const Heightfield& difference, const std::vector<double>& slope, const StableOptions& options,
                        const Heightfield* mask, double correlation_range) {
  if (options.ground == StableGround::none) throw Error("compare", "no stable ground is asked for");
  StableCells found;
  found.stable.assign(difference.z.size(), 0);
  StableReport& report = found.report;
  report.method = in_words(options);
  for (std::size_t i = 0; i < found.stable.size(); ++i) {
    found.stable[i] = candidate(difference, i, slope[i], options, mask);
    report.considered += found.stable[i];
  }
  if (options.ground == StableGround::automatic && report.considered > 0)
    report.rounds = clip(difference, options.clip, found.stable);
  const std::vector<double> values = chosen_values(difference, found.stable);
  if (values.size() < kFewest)
    throw Error("compare", "cells of stable ground", std::to_string(values.size()),
                "at least " + std::to_string(kFewest) + "; widen the polygon or mask, or raise the steepest slope");
  const RobustSpread spread = robust_spread(values);
  const DistanceReport moments = distance_statistics(values);
  report.cells = values.size();
  report.area = static_cast<double>(values.size()) * difference.cell * difference.cell;
  report.bias = spread.median;
  report.nmad = spread.nmad;
  report.mean = moments.mean;
  report.standard_deviation = moments.standard_deviation;
  const double n = static_cast<double>(values.size());
  double variance = n;
  if (correlation_range > 0) {
    const std::vector<double> weights(found.stable.begin(), found.stable.end());
    variance = correlated_variance(grid_of(difference), weights, correlation_range);
  }
  report.bias_standard_error = std::sqrt(std::numbers::pi / 2 * variance) / n * spread.nmad;
  return found;
}

}  // namespace scarp

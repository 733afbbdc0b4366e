// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/dod.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/error.hpp"
#include "tools/compare/statistics.hpp"

namespace scarp {
namespace {

Heightfield subtract(const DodInput& input, DodReport& report) {
  const Heightfield &a = input.simulated, &b = input.observed;
  require_same_grid(a, b);
  Heightfield difference = a;
  for (std::size_t i = 0; i < a.z.size(); ++i) {
    difference.z[i] = b.z[i] - a.z[i];
    report.cells_compared += !std::isnan(difference.z[i]);
    report.only_simulated += !std::isnan(a.z[i]) && std::isnan(b.z[i]);
    report.only_observed += std::isnan(a.z[i]) && !std::isnan(b.z[i]);
  }
  if (report.cells_compared == 0)
    throw Error("compare", "no cell has both a simulated and an observed height", "0 cells", "at least 1");
  return difference;
}

/// What CloudCompare calls average neighbours per cell: how full of holes a difference is.
double average_neighbours(const Heightfield& difference) {
  double neighbours = 0, cells = 0;
  for (int row = 0; row < difference.rows; ++row)
    for (int column = 0; column < difference.columns; ++column) {
      if (std::isnan(difference.at(column, row))) continue;
      cells += 1;
      for (int r = std::max(0, row - 1); r <= std::min(difference.rows - 1, row + 1); ++r)
        for (int c = std::max(0, column - 1); c <= std::min(difference.columns - 1, column + 1); ++c)
          neighbours += (r != row || c != column) && !std::isnan(difference.at(c, r));
    }
  return neighbours / cells;
}

void find_bias(const DodInput& input, const DodOptions& options, Heightfield& difference, DodReport& report) {
  if (options.stable.ground == StableGround::none) return;
  report.stable =
      find_stable(difference, slopes(input.observed), options.stable, input.stable_mask, options.correlation_range)
          .report;
  report.bias_removed = options.stable.remove_bias;
  if (report.bias_removed)
    for (double& d : difference.z) d -= report.stable->bias;
}

DodStatistics statistics_of(const Heightfield& difference) {
  std::vector<double> values;
  std::copy_if(difference.z.begin(), difference.z.end(), std::back_inserter(values),
               [](double d) { return !std::isnan(d); });
  std::sort(values.begin(), values.end());
  const DistanceReport moments = distance_statistics(values);
  const RobustSpread spread = robust_spread(values);
  return {moments.mean,   moments.median,         moments.standard_deviation, spread.nmad,  moments.root_mean_square,
          values.front(), quantile(values, 0.05), moments.percentile_95,      values.back()};
}

/// Standard deviation of the difference of each cell, 0 where nothing is compared; what it is made of goes to the
/// report.
std::vector<double> sigma_of(const DodInput& input, const DodOptions& options, const Heightfield& difference,
                             DodReport& report) {
  const bool given = options.uncertainty_simulated.has_value(), each = !given && !input.sigma_simulated.empty();
  report.sigma_simulated_from = given ? "given" : each ? "spread of the free surface" : "none";
  const auto simulated = [&](std::size_t i) {
    return each ? input.sigma_simulated[i] : options.uncertainty_simulated.value_or(0);
  };
  double squares = 0;
  for (std::size_t i = 0; i < difference.z.size(); ++i)
    if (!std::isnan(difference.z[i])) squares += simulated(i) * simulated(i);
  squares /= static_cast<double>(report.cells_compared);
  report.sigma_simulated = std::sqrt(squares);
  report.sigma_observed_from = options.uncertainty_observed ? "given" : report.stable ? "stable ground" : "none";
  report.sigma_observed = options.uncertainty_observed.value_or(
      report.stable ? std::sqrt(std::max(0.0, report.stable->nmad * report.stable->nmad - squares)) : 0);
  std::vector<double> sigma(difference.z.size(), 0.0);
  for (std::size_t i = 0; i < sigma.size(); ++i)
    if (!std::isnan(difference.z[i])) sigma[i] = std::hypot(simulated(i), report.sigma_observed);
  return sigma;
}

/// Marks what counts and sums it up.
template <class F>
DodVolume volume_where(const Heightfield& difference, const std::vector<double>& sigma, const DodReport& report,
                       F&& counts) {
  DodVolume volume;
  std::vector<std::uint8_t> chosen(difference.z.size(), 0);
  double sum = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (std::isnan(difference.z[i]) || !counts(i)) continue;
    chosen[i] = 1;
    sum += difference.z[i];
    ++volume.cells;
  }
  volume.volume = sum * report.grid.area();
  volume.area = static_cast<double>(volume.cells) * report.grid.area();
  volume.sigma = volume_sigma(report.grid, sigma, chosen, report.correlation_range, report.shared_sigma);
  return volume;
}

template <class F>
DodVolumes volumes_where(const Heightfield& difference, const std::vector<double>& sigma, const DodReport& report,
                         F&& counts) {
  const std::vector<double>& d = difference.z;
  return {volume_where(difference, sigma, report, [&](std::size_t i) { return counts(i) && d[i] > 0; }),
          volume_where(difference, sigma, report, [&](std::size_t i) { return counts(i) && d[i] < 0; }),
          volume_where(difference, sigma, report, counts)};
}

void detect(const std::vector<double>& sigma, DodResult& result) {
  DodReport& report = result.report;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < sigma.size(); ++i) {
    const double d = result.difference.z[i];
    if (std::isnan(d)) continue;
    const double limit = report.factor * (sigma[i] + report.shared_sigma);
    result.level_of_detection.z[i] = limit;
    result.significant[i] = std::abs(d) > limit;
    sum += limit;
    squares += sigma[i] * sigma[i];
  }
  const auto n = static_cast<double>(report.cells_compared);
  report.level_of_detection = sum / n;
  const double rms = report.statistics.root_mean_square, shared = report.shared_sigma;
  report.misfit_beyond_noise = std::sqrt(std::max(0.0, rms * rms - squares / n - shared * shared));
}

}  // namespace

DodResult dem_of_difference(const DodInput& input, const DodOptions& options) {
  DodResult result;
  DodReport& report = result.report;
  report.grid = grid_of(input.simulated);
  report.confidence = options.confidence;
  report.factor = two_sided_factor(options.confidence);
  report.correlation_range = options.correlation_range;
  result.difference = subtract(input, report);
  report.average_neighbours = average_neighbours(result.difference);
  find_bias(input, options, result.difference, report);
  report.shared_sigma =
      std::hypot(input.registration_error, report.bias_removed ? report.stable->bias_standard_error : 0);
  report.statistics = statistics_of(result.difference);
  const std::vector<double> sigma = sigma_of(input, options, result.difference, report);
  result.level_of_detection = empty_raster(report.grid, input.simulated.site);
  result.significant.assign(sigma.size(), 0);
  detect(sigma, result);
  report.all = volumes_where(result.difference, sigma, report, [](std::size_t) { return true; });
  report.significant =
      volumes_where(result.difference, sigma, report, [&](std::size_t i) { return result.significant[i] != 0; });
  return result;
}

}  // namespace scarp

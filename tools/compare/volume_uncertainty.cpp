// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/volume_uncertainty.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {
namespace {

constexpr double kBlocksPerRange = 16;

/// Sums of weights over square blocks of k x k cells.
struct Blocks {
  int columns = 0, rows = 0;
  double size = 0;
  std::vector<double> weight;
};

Blocks blocks_of(const RasterGrid& grid, const std::vector<double>& weights, int k) {
  Blocks blocks{(grid.columns + k - 1) / k, (grid.rows + k - 1) / k, k * grid.cell, {}};
  blocks.weight.assign(static_cast<std::size_t>(blocks.columns) * blocks.rows, 0.0);
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c)
      blocks.weight[static_cast<std::size_t>(r / k) * blocks.columns + c / k] +=
          weights[static_cast<std::size_t>(r) * grid.columns + c];
  return blocks;
}

/// Sum over cells of w(c, r) w(c + dc, r + dr).
double lag_sum(const Blocks& b, int dc, int dr) {
  double sum = 0;
  const int first = std::max(0, -dc), last = std::min(b.columns, b.columns - dc);
  for (int r = 0; r + dr < b.rows; ++r) {
    const double* here = b.weight.data() + static_cast<std::size_t>(r) * b.columns;
    const double* there = b.weight.data() + static_cast<std::size_t>(r + dr) * b.columns + dc;
    for (int c = first; c < last; ++c) sum += here[c] * there[c];
  }
  return sum;
}

}  // namespace

double two_sided_factor(double confidence) {
  double low = 0, high = 40;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    (1 - std::erfc(middle / std::sqrt(2.0)) < confidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double spherical_correlation(double h, double a) {
  if (h == 0) return 1;
  if (!(h < a)) return 0;
  const double t = h / a;
  return 1 - 1.5 * t + 0.5 * t * t * t;
}

double correlated_variance(const RasterGrid& grid, const std::vector<double>& weights, double range) {
  const double in_cells = range / grid.cell;
  const int k = in_cells > 2 * kBlocksPerRange ? static_cast<int>(std::min(in_cells / kBlocksPerRange, 1e6)) : 1;
  const Blocks blocks = blocks_of(grid, weights, k);
  const int reach = static_cast<int>(std::min(range / blocks.size, 1e6));
  double variance = lag_sum(blocks, 0, 0);
  // Lags (dc, dr) and (-dc, -dr) have the same sum: half of them, twice.
  for (int dr = 0; dr <= std::min(reach, blocks.rows - 1); ++dr)
    for (int dc = dr == 0 ? 1 : std::max(-reach, 1 - blocks.columns); dc <= std::min(reach, blocks.columns - 1); ++dc) {
      const double rho = spherical_correlation(blocks.size * std::hypot(dc, dr), range);
      if (rho > 0) variance += 2 * rho * lag_sum(blocks, dc, dr);
    }
  return variance;
}

VolumeSigma volume_sigma(const RasterGrid& grid, const std::vector<double>& sigma,
                         const std::vector<std::uint8_t>& chosen, double range, double shared) {
  std::vector<double> weights(grid.cells(), 0.0);
  double sum = 0, squares = 0, cells = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!chosen[i]) continue;
    weights[i] = sigma[i];
    sum += sigma[i];
    squares += sigma[i] * sigma[i];
    ++cells;
  }
  VolumeSigma result;
  result.independent = grid.area() * std::sqrt(squares);
  if (range > 0) result.correlated = grid.area() * std::sqrt(correlated_variance(grid, weights, range));
  result.fully_correlated = grid.area() * sum;
  result.systematic = grid.area() * cells * shared;
  return result;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "tools/compare/raster_grid.hpp"

namespace scarp {

/// z such that a normal variable is within +-z standard deviations with this probability (0 < confidence < 1): 1.96
/// for 0.95.
double two_sided_factor(double confidence);

/// Correlation of two errors a distance h apart, spherical with range a: 1 - 3/2 h/a + 1/2 (h/a)^3, 0 from a on.
double spherical_correlation(double h, double a);

/// Variance of the sum of weighted errors with the spherical correlation, unit variance each:
/// sum over i, j of w_i w_j rho(|x_i - x_j|), one weight per cell of the grid. The double sum itself over the cells
/// that count, not its closed form for a circle (Rolstad et al. 2009, J. Glaciol. 55, eq. 8). Where the range is above
/// 32 cells, square blocks of cells (at least 16 of them along the range) are taken as one point each.
double correlated_variance(const RasterGrid& grid, const std::vector<double>& weights, double range);

/// Standard deviations of a volume, m3, by what is known of the errors of the heights.
struct VolumeSigma {
  double independent = 0;            ///< no two cells share an error: area sqrt(sum sigma_i^2)
  std::optional<double> correlated;  ///< with the correlation range: area sqrt(sum_ij sigma_i sigma_j rho_ij)
  double fully_correlated = 0;       ///< all cells err alike: area sum sigma_i
  /// Of the shift that all cells share (registration, and the removed bias); independent of the others, so that it adds
  /// in squares.
  double systematic = 0;
};

/// Uncertainty of the sum of heights over the cells with `chosen` != 0, times the area of a cell.
/// @param sigma  standard deviation of the height difference of each cell, m
/// @param range  of correlation, m; 0: none known
/// @param shared standard deviation of the vertical shift of all, m
VolumeSigma volume_sigma(const RasterGrid& grid, const std::vector<double>& sigma,
                         const std::vector<std::uint8_t>& chosen, double range, double shared);

}  // namespace scarp

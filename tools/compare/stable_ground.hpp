// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tools/compare/raster_grid.hpp"

namespace scarp {

/// What stable ground says about two surfaces.
struct StableReport {
  std::string method;          ///< in words
  std::size_t considered = 0;  ///< cells with a difference inside the polygon, mask or slope limit
  std::size_t cells = 0;       ///< of these taken as stable
  double area = 0;             ///< m2
  int rounds = 0;              ///< of clipping
  double bias = 0;             ///< median difference, m
  double mean = 0;
  double nmad = 0;                ///< 1.4826 x median absolute deviation from the median, m
  double standard_deviation = 0;  ///< m, with n - 1
  /// Of the bias, m: that of a median of normal errors, sqrt(pi / 2) nmad / sqrt(effective n), with the given
  /// correlation range; n itself without one.
  double bias_standard_error = 0;
};

struct StableCells {
  std::vector<std::uint8_t> stable;  ///< 1 where stable, one per cell
  StableReport report;
};

/// Slope of a surface at each cell, degrees, by central differences (one-sided beside no data); NaN where there are
/// none.
std::vector<double> slopes(const Heightfield& surface);

/// Finds stable ground among the differences and takes its statistics.
///
/// Candidates are the cells with a difference whose slope is at most `options.steepest`, inside the polygon or where
/// `mask` is neither 0 nor without data. `automatic` then repeats: median and nmad of what is left, everything farther
/// than options.clip x nmad from the median goes, until nothing does. It assumes that most of the gentle ground has
/// stayed; what has moved alike everywhere it cannot tell from a bias.
/// @param mask for ground = mask, on the grid of the differences; else ignored
/// @throws Error when fewer than 30 cells are stable, or for ground = none.
StableCells find_stable(const Heightfield& difference, const std::vector<double>& slope, const StableOptions& options,
                        const Heightfield* mask, double correlation_range);

}  // namespace scarp

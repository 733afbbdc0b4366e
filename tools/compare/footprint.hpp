// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/heightfield.hpp"

namespace scarp {

/// A cell where two footprints meet, or do not.
enum class Overlap : std::uint8_t { neither = 0, both = 1, simulated_only = 2, observed_only = 3 };

/// How well the simulated footprint covers the observed one. The names are those of AvaFrame's code: true positive in
/// both, false positive simulated only, false negative observed only. Ratios whose denominator is 0 are NaN.
struct FootprintReport {
  double threshold_simulated = 0, threshold_observed = 0;  ///< a cell belongs where its value is above (not at) it
  double cell_area = 0;                                    ///< m2
  std::size_t both = 0, simulated_only = 0, observed_only = 0, neither = 0;  ///< cells
  double iou = 0;        ///< TP / (TP + FP + FN), also Jaccard or critical success index
  double precision = 0;  ///< TP / (TP + FP)
  double recall = 0;     ///< TP / (TP + FN)
  double f1 = 0;         ///< 2 TP / (2 TP + FP + FN), also Dice
  /// Areas over that of the observed footprint, TP + FN: AvaFrame's normalisation.
  double false_positive_ratio = 0, false_negative_ratio = 0;

  double area_of(std::size_t cells) const { return static_cast<double>(cells) * cell_area; }
};

struct FootprintResult {
  std::vector<Overlap> cells;  ///< as the rasters
  FootprintReport report;
};

/// Holds the cells of one raster above its threshold against those of another on the same cells; no data is below any
/// threshold. @throws Error when the cells differ.
FootprintResult compare_footprints(const Heightfield& simulated, double threshold_simulated,
                                   const Heightfield& observed, double threshold_observed);

}  // namespace scarp

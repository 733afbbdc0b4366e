// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/footprint.hpp"

#include <cmath>

#include "tools/compare/raster_grid.hpp"

namespace scarp {
namespace {

double ratio(std::size_t part, std::size_t whole) {
  return whole ? static_cast<double>(part) / static_cast<double>(whole) : NAN;
}

}  // namespace

FootprintResult compare_footprints(const Heightfield& simulated, double threshold_simulated,
                                   const Heightfield& observed, double threshold_observed) {
  require_same_grid(simulated, observed);
  FootprintResult result;
  FootprintReport& r = result.report;
  r.threshold_simulated = threshold_simulated;
  r.threshold_observed = threshold_observed;
  r.cell_area = simulated.cell * simulated.cell;
  result.cells.reserve(simulated.z.size());
  for (std::size_t i = 0; i < simulated.z.size(); ++i) {
    const bool s = simulated.z[i] > threshold_simulated, o = observed.z[i] > threshold_observed;  // false for NaN
    result.cells.push_back(s && o ? Overlap::both
                           : s    ? Overlap::simulated_only
                           : o    ? Overlap::observed_only
                                  : Overlap::neither);
    r.both += s && o;
    r.simulated_only += s && !o;
    r.observed_only += !s && o;
    r.neither += !s && !o;
  }
  r.iou = ratio(r.both, r.both + r.simulated_only + r.observed_only);
  r.precision = ratio(r.both, r.both + r.simulated_only);
  r.recall = ratio(r.both, r.both + r.observed_only);
  r.f1 = ratio(2 * r.both, 2 * r.both + r.simulated_only + r.observed_only);
  r.false_positive_ratio = ratio(r.simulated_only, r.both + r.observed_only);
  r.false_negative_ratio = ratio(r.observed_only, r.both + r.observed_only);
  return result;
}

}  // namespace scarp

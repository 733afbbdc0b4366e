// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The wording and units of the raster comparisons' reports.
#include <cmath>

#include "solver/model/error.hpp"
#include "tools/compare/surface_comparison.hpp"

namespace scarp {
namespace {

std::int64_t count(std::size_t n) { return static_cast<std::int64_t>(n); }

MeasureGroup cells_group(const DodReport& r, const Vec3& origin) {
  const auto share = [all = static_cast<double>(r.cells_compared + r.only_simulated + r.only_observed)](
                         std::size_t cells) { return 100 * static_cast<double>(cells) / all; };
  return {
      "cells",
      "difference = observed - simulated, in every cell where both have a height. x0 and y0: site coordinates of "
      "the centre of the cell in the south-west. Shares are of the cells that have either height; average_neighbours "
      "counts, of the 8 around a compared cell, those that are compared too.",
      {{"columns", std::int64_t{r.grid.columns}},
       {"rows", std::int64_t{r.grid.rows}},
       {"cell", r.grid.cell, "m"},
       {"x0", r.grid.x0 + origin[0], "m"},
       {"y0", r.grid.y0 + origin[1], "m"},
       {"compared", count(r.cells_compared)},
       {"only_simulated", count(r.only_simulated)},
       {"only_observed", count(r.only_observed)},
       {"matching", share(r.cells_compared), "%"},
       {"only_simulated_share", share(r.only_simulated), "%"},
       {"only_observed_share", share(r.only_observed), "%"},
       {"average_neighbours", r.average_neighbours},
       {"compared_area", static_cast<double>(r.cells_compared) * r.grid.area(), "m2"}}};
}

MeasureGroup difference_group(const DodReport& r) {
  const DodStatistics& s = r.statistics;
  return {"difference",
          std::string("Of the cells compared, ") +
              (r.bias_removed ? "after the datum bias was subtracted" : "as they are") +
              "; standard deviation with n - 1; nmad = 1.482602 median(abs(d - median)); percentiles linear between "
              "ranks. misfit_beyond_noise = sqrt(max(0, rms^2 - mean of sigma^2 - shared_sigma^2)).",
          {{"mean", s.mean, "m"},
           {"median", s.median, "m"},
           {"standard_deviation", s.standard_deviation, "m"},
           {"nmad", s.nmad, "m"},
           {"root_mean_square", s.root_mean_square, "m"},
           {"smallest", s.smallest, "m"},
           {"percentile_5", s.percentile_5, "m"},
           {"percentile_95", s.percentile_95, "m"},
           {"largest", s.largest, "m"},
           {"misfit_beyond_noise", r.misfit_beyond_noise, "m"}}};
}

MeasureGroup stable_group(const DodReport& r) {
  const StableReport& s = *r.stable;
  return {"stable_ground",
          "Stable: " + s.method +
              ". bias = median difference there before any removal; bias_standard_error = sqrt(pi / 2) nmad / "
              "sqrt(effective number of cells), with the correlation range if one is given.",
          {{"considered", count(s.considered)},
           {"cells", count(s.cells)},
           {"area", s.area, "m2"},
           {"rounds_of_clipping", std::int64_t{s.rounds}},
           {"bias", s.bias, "m"},
           {"bias_standard_error", s.bias_standard_error, "m"},
           {"mean", s.mean, "m"},
           {"nmad", s.nmad, "m"},
           {"standard_deviation", s.standard_deviation, "m"},
           {"bias_removed", r.bias_removed}}};
}

MeasureGroup significance_group(const DodReport& r) {
  return {"significance",
          "level of detection = factor (sqrt(sigma_simulated^2 + sigma_observed^2) + shared_sigma), factor two-sided "
          "normal for the confidence; a cell is significant where abs(difference) is above it. Sigmas are root mean "
          "squares over the cells compared; level_of_detection is the mean.",
          {{"confidence", r.confidence},
           {"factor", r.factor},
           {"sigma_simulated", r.sigma_simulated, "m"},
           {"sigma_simulated_from", r.sigma_simulated_from},
           {"sigma_observed", r.sigma_observed, "m"},
           {"sigma_observed_from", r.sigma_observed_from},
           {"shared_sigma", r.shared_sigma, "m"},
           {"level_of_detection", r.level_of_detection, "m"},
           {"significant_cells", count(r.significant.net.cells)},
           {"significant_share",
            100.0 * static_cast<double>(r.significant.net.cells) / static_cast<double>(r.cells_compared), "%"}}};
}

void add(std::vector<Measure>& measures, const std::string& name, const DodVolume& v, bool range_known) {
  measures.push_back({name, v.volume, "m3"});
  measures.push_back({name + "_area", v.area, "m2"});
  measures.push_back({name + "_sigma_independent", v.sigma.independent, "m3"});
  measures.push_back({name + "_sigma_correlated", range_known ? *v.sigma.correlated : NAN, "m3"});
  measures.push_back({name + "_sigma_fully_correlated", v.sigma.fully_correlated, "m3"});
  measures.push_back({name + "_sigma_systematic", v.sigma.systematic, "m3"});
}

MeasureGroup volume_group(const DodReport& r, const DodVolumes& volumes, const std::string& name,
                          const std::string& which) {
  const bool range_known = r.correlation_range > 0;
  MeasureGroup group{
      name,
      which +
          " added: observed above simulated; removed: below, negative; net: all. The volumes themselves carry no "
          "uncertainty; standard deviations are given for four views of the errors: independent from cell to cell; "
          "correlated over the range (spherical, double sum over the cells; null without a range); fully correlated; "
          "systematic, the shift that all cells share, to be added to one of the others in squares.",
      {}};
  if (range_known) group.measures.push_back({"correlation_range", r.correlation_range, "m"});
  add(group.measures, "added", volumes.added, range_known);
  add(group.measures, "removed", volumes.removed, range_known);
  add(group.measures, "net", volumes.net, range_known);
  return group;
}

}  // namespace

std::vector<MeasureGroup> groups_of(const DodReport& r, const Vec3& origin) {
  std::vector<MeasureGroup> groups{cells_group(r, origin), difference_group(r)};
  if (r.stable) groups.push_back(stable_group(r));
  groups.push_back(significance_group(r));
  groups.push_back(volume_group(r, r.all, "volumes", "Every cell compared."));
  groups.push_back(volume_group(r, r.significant, "significant_volumes", "Significant cells only."));
  return groups;
}

MeasureGroup group_of(const FootprintReport& r) {
  return {"footprint",
          "A cell belongs to a footprint where its thickness is above (not at) the threshold; no data does not. tp: "
          "both, fp: simulated only, fn: observed only (as AvaFrame's code has them). iou = tp / (tp + fp + fn), "
          "precision = tp / (tp + fp), recall = tp / (tp + fn), f1 = 2 tp / (2 tp + fp + fn); fp_ratio and fn_ratio "
          "are over tp + fn, the observed area. Undefined ratios are null.",
          {{"threshold", r.threshold_observed, "m"},
           {"tp_area", r.area_of(r.both), "m2"},
           {"fp_area", r.area_of(r.simulated_only), "m2"},
           {"fn_area", r.area_of(r.observed_only), "m2"},
           {"tn_area", r.area_of(r.neither), "m2"},
           {"simulated_area", r.area_of(r.both + r.simulated_only), "m2"},
           {"observed_area", r.area_of(r.both + r.observed_only), "m2"},
           {"iou", r.iou},
           {"precision", r.precision},
           {"recall", r.recall},
           {"f1", r.f1},
           {"fp_ratio", r.false_positive_ratio},
           {"fn_ratio", r.false_negative_ratio}}};
}

MeasureGroup group_of(const RunoutReport& r, const std::string& name, const std::string& path, const Vec3& origin) {
  return {name,
          "Along " + path +
              ", lengths in plan: s of the cell centres of the footprint, start the smallest, front the largest "
              "(AvaFrame: s_runout, delta_sxy = s_runout - s_start, delta_h the drop of the ground between them, "
              "runout_angle = atan(delta_h / delta_sxy)); travel_angle = atan(delta_h / straight distance). Width: of "
              "strips one cell long. Cells beyond the ends or beside the width limit are left out.",
          {{"s_start", r.s_start, "m"},
           {"s_runout", r.s_runout, "m"},
           {"start", std::vector<double>{r.start[0] + origin[0], r.start[1] + origin[1]}, "m"},
           {"front", std::vector<double>{r.front[0] + origin[0], r.front[1] + origin[1]}, "m"},
           {"delta_sxy", r.delta_sxy, "m"},
           {"delta_h", r.delta_h, "m"},
           {"runout_angle", r.runout_angle, "deg"},
           {"straight", r.straight, "m"},
           {"travel_angle", r.travel_angle, "deg"},
           {"width_mean", r.width_mean, "m"},
           {"width_max", r.width_max, "m"},
           {"area", r.area, "m2"},
           {"volume", r.volume, "m3"},
           {"thickness_mean", r.thickness_mean, "m"},
           {"thickness_median", r.thickness_median, "m"},
           {"thickness_percentile_95", r.thickness_percentile_95, "m"},
           {"thickness_max", r.thickness_max, "m"},
           {"cells", count(r.cells)},
           {"cells_left_out", count(r.cells_beside)}}};
}

}  // namespace scarp

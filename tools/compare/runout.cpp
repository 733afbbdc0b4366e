// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/runout.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "solver/model/error.hpp"
#include "tools/compare/raster_grid.hpp"
#include "tools/compare/statistics.hpp"

namespace scarp {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct FlowCell {
  double s = 0, thickness = 0;
  Vec2 centre{0, 0};
};

std::vector<FlowCell> flow_along(const Heightfield& thickness, const PlanPath& path, RunoutReport& report) {
  std::vector<FlowCell> flow;
  const RasterGrid grid = grid_of(thickness);
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      if (!(thickness.at(c, r) > report.threshold)) continue;
      const Vec2 centre{grid.x(c), grid.y(r)};
      const auto on = path.project(centre[0], centre[1]);
      if (!on || (report.width_limit > 0 && std::abs(on->offset) > 0.5 * report.width_limit))
        ++report.cells_beside;
      else
        flow.push_back({on->s, thickness.at(c, r), centre});
    }
  report.cells = flow.size();
  if (flow.empty())
    throw Error("compare", "nothing along the path is thicker than the threshold", "0 cells",
                "a threshold below " + shortest(report.threshold) + " m, or another path");
  return flow;
}

void measure_thickness(const std::vector<FlowCell>& flow, double cell_area, RunoutReport& report) {
  std::vector<double> values;
  for (const FlowCell& cell : flow) values.push_back(cell.thickness);
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (double v : values) sum += v;
  report.area = static_cast<double>(flow.size()) * cell_area;
  report.volume = sum * cell_area;
  report.thickness_mean = sum / static_cast<double>(flow.size());
  report.thickness_median = quantile(values, 0.5);
  report.thickness_percentile_95 = quantile(values, 0.95);
  report.thickness_max = values.back();
}

void measure_width(const std::vector<FlowCell>& flow, double cell, RunoutReport& report) {
  std::map<long long, std::size_t> strips;
  for (const FlowCell& f : flow) ++strips[std::llround((f.s - report.s_start) / cell)];
  std::size_t most = 0;
  for (const auto& [strip, count] : strips) most = std::max(most, count);
  report.width_max = static_cast<double>(most) * cell;
  report.width_mean = static_cast<double>(flow.size()) * cell / static_cast<double>(strips.size());
}

}  // namespace

RunoutReport runout_along(const Heightfield& thickness, const Heightfield* terrain, const PlanPath& path,
                          double threshold, double width_limit) {
  if (!(threshold >= 0)) throw Error("compare", "threshold of a flow", shortest(threshold), "at least 0 m");
  RunoutReport report;
  report.threshold = threshold;
  report.width_limit = width_limit;
  const std::vector<FlowCell> flow = flow_along(thickness, path, report);
  const auto [first, last] =
      std::minmax_element(flow.begin(), flow.end(), [](const FlowCell& a, const FlowCell& b) { return a.s < b.s; });
  report.s_start = first->s;
  report.s_runout = last->s;
  report.start = first->centre;
  report.front = last->centre;
  report.delta_sxy = last->s - first->s;
  report.straight = std::hypot(report.front[0] - report.start[0], report.front[1] - report.start[1]);
  report.delta_h = terrain ? height_at(*terrain, report.start[0], report.start[1]) -
                                 height_at(*terrain, report.front[0], report.front[1])
                           : NAN;
  report.runout_angle = std::atan2(report.delta_h, report.delta_sxy) * kDegrees;
  report.travel_angle = std::atan2(report.delta_h, report.straight) * kDegrees;
  measure_thickness(flow, thickness.cell * thickness.cell, report);
  measure_width(flow, thickness.cell, report);
  return report;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "tools/compare/plan_path.hpp"

namespace scarp {

/// How far a flow came along a path, and what its deposit measures. Lengths in plan, m; angles in degrees.
struct RunoutReport {
  double threshold = 0;              ///< a cell belongs to the flow where its thickness is above (not at) it, m
  double width_limit = 0;            ///< cells farther than half of it from the path are left out, m; 0: none is
  std::size_t cells = 0;             ///< of the flow along the path
  std::size_t cells_beside = 0;      ///< farther than half the width limit, or beyond an end of the path
  double s_start = 0, s_runout = 0;  ///< smallest and largest s of a cell centre (AvaFrame's sRunout)
  Vec2 start{0, 0}, front{0, 0};     ///< the centres of these cells
  double delta_sxy = 0;              ///< s_runout - s_start (AvaFrame's deltaSXY): the length along the path
  double delta_h = 0;                ///< drop of the terrain between them (AvaFrame's deltaH), NaN without a terrain
  double runout_angle = 0;           ///< atan(delta_h / delta_sxy), AvaFrame's runout angle
  double straight = 0;               ///< distance of the two in a straight line
  double travel_angle = 0;           ///< atan(delta_h / straight), the Fahrboeschung
  double width_mean = 0, width_max = 0;  ///< across the path, of strips one cell long: cells x cell area / cell
  double area = 0;                       ///< m2
  double volume = 0;                     ///< m3: sum of thickness x area
  double thickness_mean = 0, thickness_median = 0, thickness_percentile_95 = 0, thickness_max = 0;  ///< m
};

/// @param thickness of the flow or its deposit, m; no data counts as none
/// @param terrain   for the drop; nullptr: none is given
/// @throws Error for a threshold that is negative, or when nothing along the path is thicker
RunoutReport runout_along(const Heightfield& thickness, const Heightfield* terrain, const PlanPath& path,
                          double threshold, double width_limit);

}  // namespace scarp

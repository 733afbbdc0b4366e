// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/plan_path.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/error.hpp"

namespace scarp {

PlanPath::PlanPath(const std::vector<Vec2>& corners) {
  for (const Vec2& p : corners) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1])) throw Error("compare", "corner of a path is not finite");
    if (!corners_.empty() && corners_.back() == p) continue;
    s_.push_back(corners_.empty() ? 0 : s_.back() + std::hypot(p[0] - corners_.back()[0], p[1] - corners_.back()[1]));
    corners_.push_back(p);
  }
  if (corners_.size() < 2)
    throw Error("compare", "corners of a path", std::to_string(corners_.size()) + " different", "at least 2");
}

Vec2 PlanPath::at(double s) const {
  const auto above = std::upper_bound(s_.begin() + 1, s_.end() - 1, s) - s_.begin();
  const auto i = static_cast<std::size_t>(above);
  const double t = std::clamp((s - s_[i - 1]) / (s_[i] - s_[i - 1]), 0.0, 1.0);
  const Vec2 &a = corners_[i - 1], &b = corners_[i];
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

std::optional<OnPath> PlanPath::project(double x, double y) const {
  double nearest = INFINITY;
  std::optional<OnPath> found;
  for (std::size_t i = 1; i < corners_.size(); ++i) {
    const Vec2 &a = corners_[i - 1], &b = corners_[i];
    const double length = s_[i] - s_[i - 1], ux = (b[0] - a[0]) / length, uy = (b[1] - a[1]) / length;
    const double along = (x - a[0]) * ux + (y - a[1]) * uy, t = std::clamp(along, 0.0, length);
    const double distance = std::hypot(x - a[0] - t * ux, y - a[1] - t * uy);
    if (distance >= nearest) continue;
    nearest = distance;
    const bool beyond = (i == 1 && along < 0) || (i + 1 == corners_.size() && along > length);
    const double side = ux * (y - a[1]) - uy * (x - a[0]);
    found = beyond ? std::nullopt : std::optional<OnPath>({s_[i - 1] + t, std::copysign(distance, side)});
  }
  return found;
}

PlanPath steepest_line(const Heightfield& terrain, const Vec2& start) {
  const double step = 0.5 * terrain.cell;
  Vec2 here = start;
  double height = height_at(terrain, here[0], here[1]);
  if (std::isnan(height))
    throw Error("compare", "the terrain has no height at the start of the steepest line",
                "(" + shortest(start[0]) + ", " + shortest(start[1]) + ")", "a place on the terrain");
  std::vector<Vec2> corners{here};
  std::size_t lowest = 0;
  double lowest_height = height;
  while (corners.size() - lowest < 5) {
    const double e = step;
    const double dx = height_at(terrain, here[0] + e, here[1]) - height_at(terrain, here[0] - e, here[1]);
    const double dy = height_at(terrain, here[0], here[1] + e) - height_at(terrain, here[0], here[1] - e);
    const double slope = std::hypot(dx, dy);
    if (!(slope > 0)) break;
    here = {here[0] - step * dx / slope, here[1] - step * dy / slope};
    height = height_at(terrain, here[0], here[1]);
    if (std::isnan(height)) break;
    corners.push_back(here);
    if (height < lowest_height) {
      lowest_height = height;
      lowest = corners.size() - 1;
    }
  }
  corners.resize(lowest + 1);
  if (corners.size() < 2)
    throw Error("compare", "nothing is lower around the start of the steepest line",
                "(" + shortest(start[0]) + ", " + shortest(start[1]) + ")", "a place on a slope");
  return PlanPath(corners);
}

}  // namespace scarp

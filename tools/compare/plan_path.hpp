// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "solver/model/heightfield.hpp"
#include "solver/model/math.hpp"

namespace scarp {

/// Where a point lies relative to a path.
struct OnPath {
  double s = 0;       ///< along the path from its first corner, in plan, m
  double offset = 0;  ///< to the left of the path positive, m
};

/// A line of straight pieces in plan, for sections and run-out.
class PlanPath {
 public:
  /// Corners that repeat the one before are dropped. @throws Error for fewer than two different, finite corners.
  explicit PlanPath(const std::vector<Vec2>& corners);

  const std::vector<Vec2>& corners() const { return corners_; }
  double length() const { return s_.back(); }
  /// The point at s, clamped to the ends.
  Vec2 at(double s) const;
  /// The nearest point of the path; nothing where that is an end of the path and the point lies beyond it.
  std::optional<OnPath> project(double x, double y) const;

 private:
  std::vector<Vec2> corners_;
  std::vector<double> s_;
};

/// The line of steepest descent over a terrain from `start` (x, y): steps of half a cell against the gradient of the
/// bilinear surface, until it leaves the raster, meets no data, or does not get lower within two cells.
/// @throws Error where the terrain has no height at the start, or none below it.
PlanPath steepest_line(const Heightfield& terrain, const Vec2& start);

}  // namespace scarp

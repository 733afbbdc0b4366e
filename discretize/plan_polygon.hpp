// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// A simple polygon in the plane, counter-clockwise, with its edges sorted into slots along x so that questions
/// touch only the edges nearby. A vertical line owns the polygon half-open: lower crossing in, upper one out.
class PlanPolygon {
 public:
  struct Edge {
    Vec2 left, right;  ///< left.x <= right.x
    double sign = 0;   ///< +1: the polygon is below the edge; -1: above it; 0: the edge is vertical
    double height_at(double x) const { return left[1] + (x - left[0]) / (right[0] - left[0]) * (right[1] - left[1]); }
  };

  /// A closing corner that repeats the first one is dropped; either orientation will do.
  /// @throws Error ("discretize") naming `what` if there are fewer than three corners, one is not finite, the area
  /// is zero or the border crosses or touches itself.
  PlanPolygon(std::vector<Vec2> corners, const std::string& what);

  const std::vector<Vec2>& corners() const { return corners_; }
  double area() const { return area_; }
  const Vec2& min() const { return min_; }
  const Vec2& max() const { return max_; }
  bool contains(double x, double y) const;
  /// Heights at which the vertical line at x crosses the border, ascending; an even number.
  void crossings(double x, std::vector<double>& heights) const;

  /// Calls f(edge) once for each edge whose x range overlaps [x0, x1], in a fixed order.
  template <class F>
  void for_each_edge_over(double x0, double x1, F&& f) const {
    if (x1 < min_[0] || x0 > max_[0]) return;
    const std::size_t s0 = slot(x0), s1 = slot(x1);
    for (std::size_t s = s0; s <= s1; ++s)
      for (std::size_t n = slot_first_[s]; n < slot_first_[s + 1]; ++n) {
        const Edge& edge = edges_[slot_edges_[n]];
        // An edge in several slots is met in the first of them that is asked for.
        if (edge.right[0] < x0 || edge.left[0] > x1 || std::max(slot(edge.left[0]), s0) != s) continue;
        f(edge);
      }
  }

 private:
  std::size_t slot(double x) const;
  void sort_into_slots();

  std::vector<Vec2> corners_;
  std::vector<Edge> edges_;
  double area_ = 0;
  Vec2 min_{}, max_{};
  std::size_t slots_ = 1;
  std::vector<std::size_t> slot_first_;
  std::vector<std::uint32_t> slot_edges_;
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// Fixed positions in a tree of boxes, for searches of regions of any shape: balls, cylinders, slabs. (Neighbours is
/// for the nearest ones and for sorted answers.) Points that are near each other stand near each other in memory.
///
/// The order of the points in the tree, and so that of a visit, depends on the positions alone. Visits change nothing
/// and may run on many threads at once. About 50 bytes per point.
class PointTree {
 public:
  /// An axis-aligned box that holds some points: |p - centre| <= half in each coordinate, rounded outwards.
  struct Box {
    Vec3 centre;
    Vec3 half;
  };

  /// @throws Error naming the first position that is not finite or beyond 1e100, or when there are 2^32 or more.
  explicit PointTree(const std::vector<Vec3>& positions);

  std::size_t size() const { return points_.size(); }
  /// The points in the order of the tree, and where each stood among the positions given.
  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<std::uint32_t>& indices() const { return indices_; }

  /// Calls use(begin, end), ranges of places in points(), for every leaf of which no box was refused.
  /// @param may_hold  called with boxes; false means that no point of the box is of interest
  template <class MayHold, class Use>
  void visit(MayHold&& may_hold, Use&& use) const {
    for (std::size_t i = 0; i < nodes_.size();) {
      const Node& node = nodes_[i];
      if (!may_hold(node.box)) {
        i = node.next;
        continue;
      }
      if (node.next == ++i) use(static_cast<std::size_t>(node.begin), static_cast<std::size_t>(node.end));
    }
  }

 private:
  /// Parents stand before their children: the subtree of node i ends at nodes_[i].next, and a leaf's at i + 1.
  struct Node {
    Box box;
    std::uint32_t begin, end, next;
  };
  struct Entry {
    Vec3 position;
    std::uint32_t index;
  };

  void build(std::vector<Entry>& entries, std::size_t begin, std::size_t end);

  std::vector<Vec3> points_;
  std::vector<std::uint32_t> indices_;
  std::vector<Node> nodes_;
};

/// Whether a box can hold points within `radius` of `centre`; never false by rounding.
inline bool may_touch_ball(const PointTree::Box& box, const Vec3& centre, double radius) {
  double squared = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double gap = std::abs(centre[a] - box.centre[a]) - box.half[a];
    if (gap > 0) squared += gap * gap;
  }
  return squared <= radius * radius * (1 + 1e-12);
}

/// Whether a box can hold points within `radius` of the axis centre + t direction, |t| <= half_length (direction of
/// length 1); never false by rounding. It looks at the box's sphere across the axis.
inline bool may_touch_cylinder(const PointTree::Box& box, const Vec3& centre, const Vec3& direction, double radius,
                               double half_length) {
  const Vec3 d = box.centre - centre;
  const double along = dot(d, direction);
  const double reach = box.half[0] * std::abs(direction[0]) + box.half[1] * std::abs(direction[1]) +
                       box.half[2] * std::abs(direction[2]);
  const double slack = 1e-12 * (std::abs(along) + reach + half_length);
  if (std::abs(along) - reach > half_length + slack) return false;
  const Vec3 across = d - along * direction;
  // The extent of the box in the direction of `across`, which is where its nearest point lies at best.
  const double distance = norm(across);
  const double extent =
      (box.half[0] * std::abs(across[0]) + box.half[1] * std::abs(across[1]) + box.half[2] * std::abs(across[2]));
  return distance * distance - extent <= (radius + slack) * distance;
}

}  // namespace scarp

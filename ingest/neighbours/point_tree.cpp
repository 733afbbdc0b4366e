// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/neighbours/point_tree.hpp"

#include <algorithm>

#include "ingest/neighbours/checked_positions.hpp"

namespace scarp {
namespace {

constexpr std::size_t kLeafSize = 16;

PointTree::Box around(const Box3& bounds) {
  PointTree::Box box{};
  for (std::size_t a = 0; a < 3; ++a) {
    box.centre[a] = 0.5 * (bounds.min[a] + bounds.max[a]);
    box.half[a] = std::max(box.centre[a] - bounds.min[a], bounds.max[a] - box.centre[a]) *
                  (1 + 1e-14);  // also covers a query's rounding
  }
  return box;
}

std::size_t longest_axis(const PointTree::Box& box) {
  return static_cast<std::size_t>(std::max_element(box.half.begin(), box.half.end()) - box.half.begin());
}

}  // namespace

PointTree::PointTree(const std::vector<Vec3>& positions) {
  check_positions(positions);
  std::vector<Entry> entries(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) entries[i] = {positions[i], static_cast<std::uint32_t>(i)};
  nodes_.reserve(positions.size() / (kLeafSize / 4) + 1);
  if (!entries.empty()) build(entries, 0, entries.size());
  points_.reserve(entries.size());
  indices_.reserve(entries.size());
  for (const Entry& entry : entries) {
    points_.push_back(entry.position);
    indices_.push_back(entry.index);
  }
}

/// Halves the points across the longest edge of their box until few are left: at most 27 levels deep.
void PointTree::build(std::vector<Entry>& entries, std::size_t begin, std::size_t end) {
  Box3 bounds;
  for (std::size_t i = begin; i < end; ++i) bounds.extend(entries[i].position);
  const std::size_t self = nodes_.size();
  nodes_.push_back({around(bounds), static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), 0});
  if (end - begin > kLeafSize) {
    const std::size_t axis = longest_axis(nodes_[self].box);
    const std::size_t leaves = (end - begin + kLeafSize - 1) / kLeafSize;
    const std::size_t middle = begin + leaves / 2 * kLeafSize;  // full leaves on the left
    const auto at = [&](std::size_t i) { return entries.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [axis](const Entry& a, const Entry& b) {
      return a.position[axis] < b.position[axis] || (a.position[axis] == b.position[axis] && a.index < b.index);
    });
    build(entries, begin, middle);
    build(entries, middle, end);
  }
  nodes_[self].next = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace scarp

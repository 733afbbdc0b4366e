// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// A point found by a search: its index among the positions searched, and how far it is (m2).
struct Neighbour {
  std::size_t index = 0;
  double squared_distance = 0;
};

/// Nearest first; equally near points by index.
inline bool operator<(const Neighbour& a, const Neighbour& b) {
  return a.squared_distance < b.squared_distance || (a.squared_distance == b.squared_distance && a.index < b.index);
}
inline bool operator==(const Neighbour& a, const Neighbour& b) {
  return a.squared_distance == b.squared_distance && a.index == b.index;
}

/// Exact searches among fixed positions, in double precision (KD-tree).
///
/// Every answer is fully determined by the positions and the query: sorted by (distance, index), and of equally
/// near points at the edge of an answer those of the lowest indices are in it. Queries change nothing and may
/// run on many threads at once. A query that is not finite has no neighbours.
///
/// The positions are copied, in an order that makes searches fast: about 50 bytes per point. Any number of
/// copies of one point costs no time.
class Neighbours {
 public:
  /// @throws Error naming the first position that is not finite or beyond 1e100, or when there are 2^32 or more.
  explicit Neighbours(const std::vector<Vec3>& positions);
  ~Neighbours();
  Neighbours(Neighbours&&) noexcept;
  Neighbours& operator=(Neighbours&&) noexcept;

  std::size_t size() const;

  /// The k nearest, or all if there are fewer. The second form reuses the memory of `found`.
  std::vector<Neighbour> nearest(const Vec3& query, std::size_t k) const;
  void nearest(const Vec3& query, std::size_t k, std::vector<Neighbour>& found) const;

  /// All at a distance <= radius (m); none for a radius that is negative or NaN.
  std::vector<Neighbour> within(const Vec3& query, double radius) const;
  void within(const Vec3& query, double radius, std::vector<Neighbour>& found) const;

  /// The nearest one at a distance <= max_distance (m). Allocates nothing.
  std::optional<Neighbour> closest(const Vec3& query, double max_distance = INFINITY) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// Points by the cells of an unbounded lattice, hashed: finds all points near a place without looking at the others.
/// Buffers keep their capacity from build to build. The order of what is found depends on the points alone.
class CellList {
 public:
  /// @param points  index i stands for points[i]; not kept
  /// @param cell    edge, m: the largest distance that each_near can be asked for
  void build(const std::vector<Vec3>& points, double cell, int dimension) {
    per_cell_ = 1 / cell;
    dimension_ = dimension;
    const std::size_t buckets = std::bit_ceil(2 * points.size() + 1);
    mask_ = buckets - 1;
    begin_.assign(buckets + 1, 0);
    keys_.resize(points.size());
    entries_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      keys_[i] = key(cell_of(points[i]));
      ++begin_[bucket(keys_[i]) + 1];
    }
    for (std::size_t b = 0; b < buckets; ++b) begin_[b + 1] += begin_[b];
    for (std::size_t i = 0; i < points.size(); ++i)
      entries_[begin_[bucket(keys_[i])]++] = {keys_[i], static_cast<std::uint32_t>(i)};
    for (std::size_t b = buckets; b > 0; --b) begin_[b] = begin_[b - 1];
    begin_[0] = 0;
  }

  /// f(i) of all points in the cell of x and those around it: all within one edge, and some beyond.
  template <class F>
  void each_near(const Vec3& x, F&& f) const {
    if (entries_.empty()) return;
    const std::array<std::int64_t, 3> middle = cell_of(x);
    for (int k = dimension_ == 3 ? -1 : 0; k <= (dimension_ == 3 ? 1 : 0); ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const std::uint64_t wanted = key({middle[0] + i, middle[1] + j, middle[2] + k});
          const std::size_t b = bucket(wanted);
          for (std::size_t e = begin_[b]; e < begin_[b + 1]; ++e)
            if (entries_[e].key == wanted) f(entries_[e].point);
        }
  }

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t point;
  };

  std::array<std::int64_t, 3> cell_of(const Vec3& x) const {
    std::array<std::int64_t, 3> c{0, 0, 0};
    for (int a = 0; a < dimension_; ++a) c[a] = static_cast<std::int64_t>(std::floor(x[a] * per_cell_));
    return c;
  }
  /// 21 bits per axis: cells 2 million apart look the same, which costs a distance test at worst.
  static std::uint64_t key(const std::array<std::int64_t, 3>& c) {
    constexpr std::uint64_t bits = (1u << 21) - 1;
    return (static_cast<std::uint64_t>(c[0]) & bits) | (static_cast<std::uint64_t>(c[1]) & bits) << 21 |
           (static_cast<std::uint64_t>(c[2]) & bits) << 42;
  }
  std::size_t bucket(std::uint64_t key) const {
    key *= 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(key ^ key >> 32) & mask_;
  }

  double per_cell_ = 1;
  int dimension_ = 3;
  std::size_t mask_ = 0;
  std::vector<std::size_t> begin_;
  std::vector<std::uint64_t> keys_;
  std::vector<Entry> entries_;
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "discretize/gridding.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {

/// Samples [begin, end) of a column.
struct Span {
  std::int32_t begin = 0;
  std::int32_t end = 0;
};

/// Which sub-cells of a lattice are filled: a few spans per column instead of a bit per sub-cell, so that a solid
/// costs memory with its plan, not with its volume.
struct Columns {
  std::vector<std::size_t> first;  ///< spans of column c: [first[c], first[c + 1])
  std::vector<Span> spans;         ///< ascending, disjoint, never touching
  /// Terrain solids only: elevation of the scanned surface over each column, NaN outside its plan.
  std::vector<double> top;

  bool contains(std::size_t column, std::int32_t k) const {
    for (std::size_t s = first[column]; s < first[column + 1]; ++s)
      if (k >= spans[s].begin && k < spans[s].end) return true;
    return false;
  }
  std::size_t points() const {
    std::size_t sum = 0;
    for (const Span& span : spans) sum += static_cast<std::size_t>(span.end - span.begin);
    return sum;
  }
};

/// Appends a span to a column's list; empty ones vanish and touching ones become one.
inline void append_span(std::vector<Span>& column, std::size_t column_begin, Span span) {
  if (span.begin >= span.end) return;
  if (column.size() > column_begin && column.back().end >= span.begin)
    column.back().end = std::max(column.back().end, span.end);
  else
    column.push_back(span);
}

/// Builds Columns from `spans_of(i, j, push)`, which calls push(Span) in ascending order for column (i, j).
template <class F>
Columns collect_columns(const SubLattice& grid, int threads, F&& spans_of) {
  const std::size_t count = grid.columns();
  const std::size_t blocks = (count + kReductionBlock - 1) / kReductionBlock;
  std::vector<std::vector<Span>> found(blocks);
  Columns columns;
  columns.first.assign(count + 1, 0);
  parallel_for(blocks, threads, [&](std::size_t b) {
    const std::size_t end = std::min(count, (b + 1) * kReductionBlock);
    for (std::size_t c = b * kReductionBlock; c < end; ++c) {
      const std::size_t begin = found[b].size();
      spans_of(static_cast<std::int32_t>(c % grid.x.count), static_cast<std::int32_t>(c / grid.x.count),
               [&](Span span) { append_span(found[b], begin, span); });
      columns.first[c + 1] = found[b].size() - begin;
    }
  });
  for (std::size_t c = 0; c < count; ++c) columns.first[c + 1] += columns.first[c];
  columns.spans.reserve(columns.first[count]);
  for (auto& block : found) {
    columns.spans.insert(columns.spans.end(), block.begin(), block.end());
    std::vector<Span>().swap(block);
  }
  return columns;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/nodal_layout.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace scarp {
namespace {

using kernels::kSegment;
using kernels::Segment;

/// Weights of regular cells are constants: points may be off by this share of a cell, which is below what rounding does
/// to their coordinates.
constexpr double kOffPlace = 1e-10;

/// A slab is worth this many segments, so that its copies of shared rows are a small part of its work.
constexpr std::size_t kSegmentsPerSlab = 1024;
constexpr std::size_t kMostSlabs = 64;

/// The cells of one segment, in the order of x.
struct Group {
  std::int32_t x = 0, y = 0, z = 0;  ///< lattice index of the first lane
  std::size_t begin = 0, end = 0;    ///< cells of the ReferenceGrid
};

std::vector<Group> group_cells(const ReferenceGrid& grid) {
  std::vector<Group> groups;
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    const LatticeIndex& i = grid.cells[c];
    const std::int32_t x = i[0] / kSegment * kSegment;
    if (groups.empty() || groups.back().x != x || groups.back().y != i[1] || groups.back().z != i[2])
      groups.push_back({x, i[1], i[2], c, c});
    groups.back().end = c + 1;
  }
  return groups;
}

auto key(const NodeBlock& b) { return std::tuple(b.z, b.y, b.x); }

/// A segment needs its own eight nodes in each row and the one after them.
void find_blocks(NodalLayout& layout, const std::vector<Group>& groups) {
  for (const Group& g : groups)
    for (int dz = 0; dz < layout.dimension - 1; ++dz)
      for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx <= kSegment; dx += kSegment) layout.blocks.push_back({g.x + dx, g.y + dy, g.z + dz});
  const auto less = [](const NodeBlock& a, const NodeBlock& b) { return key(a) < key(b); };
  const auto same = [](const NodeBlock& a, const NodeBlock& b) { return key(a) == key(b); };
  std::sort(layout.blocks.begin(), layout.blocks.end(), less);
  layout.blocks.erase(std::unique(layout.blocks.begin(), layout.blocks.end(), same), layout.blocks.end());
}

std::uint32_t node_at(const NodalLayout& layout, std::int32_t x, std::int32_t y, std::int32_t z) {
  const NodeBlock wanted{x / kSegment * kSegment, y, z};
  const auto block = std::lower_bound(layout.blocks.begin(), layout.blocks.end(), wanted,
                                      [](const NodeBlock& a, const NodeBlock& b) { return key(a) < key(b); });
  return static_cast<std::uint32_t>((block - layout.blocks.begin()) * kSegment + x % kSegment);
}

/// The particles of one material in a cell of a group.
struct Lane {
  std::size_t cell = 0;
  int lane = 0;
  std::size_t begin = 0, end = 0;
};

/// The segments of all groups, first their sizes, so that memory is taken once and no more than needed; then what the
/// kernels know of their particles.
class Builder {
 public:
  Builder(NodalLayout& layout, const Model& model, const TotalBody& body,
          const std::vector<std::optional<kernels::LawParameters>>& laws)
      : layout_(layout), model_(model), body_(body), laws_(laws) {}

  /// One segment for each material of the group.
  void lay(const Group& group) {
    for (std::int32_t material = 0; material < static_cast<std::int32_t>(laws_.size()); ++material)
      if (find_lanes(group, material)) lay(group, material);
  }

  void make_room() {
    layout_.points.assign(points_, 0);
    layout_.slots.assign(slots_, NodalLayout::kEmpty);
  }

  void fill(const Group& group) {
    for (std::int32_t material = 0; material < static_cast<std::int32_t>(laws_.size()); ++material) {
      if (!find_lanes(group, material)) continue;
      const Segment& segment = layout_.segments[filled_];
      segment.kind == kernels::CellKind::regular ? fill_regular(segment) : fill_cut(segment);
      ++filled_;
    }
  }

 private:
  /// Of the material in the group, into lanes_; whether there are any.
  bool find_lanes(const Group& group, std::int32_t material) {
    lanes_.clear();
    const auto& materials = model_.particles.material;
    for (std::size_t c = group.begin; c < group.end; ++c) {
      const auto first = materials.begin() + static_cast<std::ptrdiff_t>(body_.grid.cell_begin[c]);
      const auto last = materials.begin() + static_cast<std::ptrdiff_t>(body_.grid.cell_begin[c + 1]);
      const auto range = std::equal_range(first, last, material);
      if (range.first != range.second)
        lanes_.push_back({c, body_.grid.cells[c][0] - group.x,
                          static_cast<std::size_t>(range.first - materials.begin()),
                          static_cast<std::size_t>(range.second - materials.begin())});
    }
    return !lanes_.empty();
  }

  Vec3 place(const Lane& lane, std::size_t p) const {
    return body_.grid.place(lane.cell, p - body_.begin, model_.particles.reference_position[p]);
  }

  bool is_regular(const Lane& lane) const {
    const Particles& particles = model_.particles;
    const int corners = body_.grid.corners();
    if (lane.end - lane.begin != static_cast<std::size_t>(corners)) return false;
    unsigned seen = 0;
    for (std::size_t p = lane.begin; p < lane.end; ++p) {
      const Vec3 xi = place(lane, p);
      unsigned corner = 0;
      for (int a = 0; a < body_.grid.dimension; ++a) {
        const double off = std::abs(std::abs(xi[a] - 0.5) - 0.25);
        if (off > kOffPlace) return false;
        if (xi[a] > 0.5) corner |= 1u << a;
      }
      seen |= 1u << corner;
      if (particles.mass[p] != particles.mass[lane.begin] ||
          particles.reference_volume[p] != particles.reference_volume[lane.begin])
        return false;
    }
    return seen == (1u << corners) - 1;
  }

  void lay(const Group& group, std::int32_t material) {
    Segment segment{};
    for (int row = 0; row < (layout_.dimension == 2 ? 2 : 4); ++row)
      segment.read[row] = segment.add[row] = node_at(layout_, group.x, group.y + (row & 1), group.z + (row >> 1));
    segment.law = static_cast<std::uint16_t>(material);
    const bool regular = std::all_of(lanes_.begin(), lanes_.end(), [&](const Lane& l) { return is_regular(l); });
    segment.kind = regular ? kernels::CellKind::regular : kernels::CellKind::cut;
    for (const Lane& l : lanes_) segment.places = std::max(segment.places, static_cast<std::uint16_t>(l.end - l.begin));
    const std::size_t places = std::size_t{segment.places} * kSegment;
    segment.points = points_;
    segment.history = layout_.history;
    points_ += regular ? 2 * kSegment : places * static_cast<std::size_t>(layout_.dimension + 2);
    layout_.history += places * static_cast<std::size_t>(history_fields(laws_[material]->kind, layout_.dimension));
    layout_.slot_begin.push_back(slots_);
    slots_ += places;
    layout_.first.push_back(static_cast<std::uint32_t>(body_.grid.cell_begin[group.begin]));
    layout_.segments.push_back(segment);
  }

  std::uint32_t& slot(int place, int lane) {
    return layout_.slots[layout_.slot_begin[filled_] + static_cast<std::size_t>(place * kSegment + lane)];
  }

  void fill_regular(const Segment& segment) {
    double* points = &layout_.points[segment.points];
    for (const Lane& l : lanes_) {
      points[l.lane] = model_.particles.mass[l.begin];
      points[kSegment + l.lane] = model_.particles.reference_volume[l.begin];
      for (std::size_t p = l.begin; p < l.end; ++p) {
        const Vec3 xi = place(l, p);
        slot((xi[0] > 0.5) + 2 * (xi[1] > 0.5) + 4 * (xi[2] > 0.5), l.lane) = static_cast<std::uint32_t>(p);
      }
    }
  }

  /// Empty slots keep the middle of the cell, without mass and volume.
  void fill_cut(const Segment& segment) {
    const int D = layout_.dimension;
    const auto stride = static_cast<std::size_t>((D + 2) * kSegment);
    double* points = &layout_.points[segment.points];
    for (int place = 0; place < segment.places; ++place) std::fill_n(points + place * stride, D * kSegment, 0.5);
    for (const Lane& l : lanes_)
      for (std::size_t p = l.begin; p < l.end; ++p) {
        const int index = static_cast<int>(p - l.begin);
        double* point = points + index * stride + l.lane;
        const Vec3 xi = place(l, p);
        for (int a = 0; a < D; ++a) point[a * kSegment] = xi[a];
        point[D * kSegment] = model_.particles.reference_volume[p];
        point[(D + 1) * kSegment] = model_.particles.mass[p];
        slot(index, l.lane) = static_cast<std::uint32_t>(p);
      }
  }

  NodalLayout& layout_;
  const Model& model_;
  const TotalBody& body_;
  const std::vector<std::optional<kernels::LawParameters>>& laws_;
  std::vector<Lane> lanes_;
  std::size_t points_ = 0, slots_ = 0;  ///< laid so far
  std::size_t filled_ = 0;              ///< segments
};

/// Cuts the segments into slabs, of about equal size, where a new row of cells begins.
/// @param group_of  per segment
void cut_into_slabs(NodalLayout& layout, const std::vector<Group>& groups, const std::vector<std::uint32_t>& group_of) {
  const std::size_t count = layout.segments.size();
  const std::size_t wanted = std::clamp<std::size_t>(count / kSegmentsPerSlab, 1, kMostSlabs);
  for (std::uint32_t s = 0; s < count; ++s) {
    const Group& g = groups[group_of[s]];
    const bool new_row = s == 0 || groups[group_of[s - 1]].y != g.y || groups[group_of[s - 1]].z != g.z;
    const bool full = s > 0 && layout.slabs.back().begin + count / wanted <= s && layout.slabs.size() < wanted;
    if (s == 0 || (new_row && full)) layout.slabs.push_back({s, s, {}});
    layout.slabs.back().end = s + 1;
  }
}

/// Rows of nodes, each as its blocks; blocks of a row stand together.
struct Row {
  std::uint32_t node = 0, count = 0;
};

Row row_of(const NodalLayout& layout, std::uint32_t node) {
  const auto same = [&](std::size_t a, std::size_t b) {
    return layout.blocks[a].y == layout.blocks[b].y && layout.blocks[a].z == layout.blocks[b].z;
  };
  const std::size_t block = node / kSegment;
  std::size_t first = block, last = block + 1;
  while (first > 0 && same(first - 1, block)) --first;
  while (last < layout.blocks.size() && same(last, block)) ++last;
  return {static_cast<std::uint32_t>(first * kSegment), static_cast<std::uint32_t>((last - first) * kSegment)};
}

/// Gives slabs copies of the rows that an earlier one adds to as well.
void share_rows(NodalLayout& layout) {
  layout.sums = layout.nodes();
  std::uint32_t owned = 0;  // nodes below it belong to slabs before the present one
  for (const Slab& slab : layout.slabs) {
    std::vector<SharedRow> mine;
    std::uint32_t highest = owned;
    for (std::uint32_t s = slab.begin; s < slab.end; ++s) {
      Segment& segment = layout.segments[s];
      for (int row = 0; row < (layout.dimension == 2 ? 2 : 4); ++row) {
        const std::uint32_t node = segment.read[row];
        highest = std::max(highest, node);
        if (node >= owned) continue;
        auto found = std::find_if(mine.begin(), mine.end(),
                                  [&](const SharedRow& r) { return node >= r.node && node < r.node + r.count; });
        if (found == mine.end()) {
          const Row whole = row_of(layout, node);
          found = mine.insert(mine.end(), {whole.node, whole.count, static_cast<std::uint32_t>(layout.sums)});
          layout.sums += whole.count;
        }
        segment.add[row] = found->copy + (node - found->node);
      }
    }
    layout.shared.insert(layout.shared.end(), mine.begin(), mine.end());
    const Row last = row_of(layout, highest);
    owned = std::max(owned, last.node + last.count);
  }
  std::stable_sort(layout.shared.begin(), layout.shared.end(),
                   [](const SharedRow& a, const SharedRow& b) { return a.node < b.node; });
}

void find_runs(NodalLayout& layout, const std::vector<std::optional<kernels::LawParameters>>& laws) {
  const int rows = layout.dimension == 2 ? 2 : 4;
  for (Slab& slab : layout.slabs)
    for (std::uint32_t s = slab.begin; s < slab.end; ++s) {
      Segment& segment = layout.segments[s];
      const kernels::LawKind law = laws[segment.law]->kind;
      const bool starts = slab.runs.empty() || slab.runs.back().law != law;
      if (starts) slab.runs.push_back({s, s, law});
      slab.runs.back().end = s + 1;
      segment.follows = !starts;
      for (int row = 0; row < rows && segment.follows; ++row)
        segment.follows = layout.segments[s - 1].add[row] + kSegment == segment.add[row];
    }
}

}  // namespace

NodalLayout lay_out(const Model& model, const TotalBody& body,
                    const std::vector<std::optional<kernels::LawParameters>>& laws) {
  NodalLayout layout;
  layout.dimension = body.grid.dimension;
  layout.cell = body.grid.cell;
  layout.origin = body.grid.origin;
  const std::vector<Group> groups = group_cells(body.grid);
  find_blocks(layout, groups);
  Builder builder(layout, model, body, laws);
  std::vector<std::uint32_t> group_of;
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    builder.lay(groups[g]);
    group_of.resize(layout.segments.size(), g);
  }
  builder.make_room();
  for (const Group& group : groups) builder.fill(group);
  cut_into_slabs(layout, groups, group_of);
  share_rows(layout);
  find_runs(layout, laws);
  layout.node_of.reserve(body.grid.nodes.size());
  for (const LatticeIndex& i : body.grid.nodes) layout.node_of.push_back(node_at(layout, i[0], i[1], i[2]));
  return layout;
}

Vec3 place_in_cell(const NodalLayout& layout, const Segment& segment, int place, int lane) {
  Vec3 xi{0, 0, 0};
  for (int a = 0; a < layout.dimension; ++a)
    xi[a] = segment.kind == kernels::CellKind::regular
                ? (place >> a & 1 ? 0.75 : 0.25)
                : layout.points[segment.points +
                                static_cast<std::size_t>((place * (layout.dimension + 2) + a) * kSegment + lane)];
  return xi;
}

}  // namespace scarp

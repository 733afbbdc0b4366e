// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/neighbours/neighbours.hpp"

#include <algorithm>
#include <limits>
#include <nanoflann.hpp>
#include <numeric>
#include <span>

#include "ingest/neighbours/checked_positions.hpp"

namespace scarp {
namespace {

constexpr std::size_t kLeafSize = 12;

/// The positions, as nanoflann asks for them.
struct Positions {
  std::vector<Vec3> values;

  std::size_t kdtree_get_point_count() const { return values.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return values[i][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// The search limit told to the tree, a little beyond the true one. The tree drops points at exactly the limit
/// and sums its distances to branches in another order than ours; what it offers too much is refused exactly.
double lenient(double squared_distance) { return squared_distance * (1 + 1e-10) + std::numeric_limits<double>::min(); }

/// Which of the caller's points lie at each place of the tree: those of place i are
/// points[begin[i]] ... points[begin[i + 1] - 1], ascending.
struct Members {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> points;

  std::span<const std::uint32_t> of(std::uint32_t place) const {
    return {points.data() + begin[place], points.data() + begin[place + 1]};
  }
};

// What the tree asks of a result: worstDist, and addPoint(squared distance, place), which returns whether to go on.

class Closest {
 public:
  Closest(double squared_limit, const Members& members) : best_{kNone, squared_limit}, members_(members) {}

  double worstDist() const { return lenient(best_.squared_distance); }
  bool full() const { return true; }
  bool addPoint(double squared_distance, std::uint32_t place) {
    best_ = std::min(best_, Neighbour{members_.of(place).front(), squared_distance});
    return true;
  }
  std::optional<Neighbour> found() const { return best_.index == kNone ? std::nullopt : std::optional(best_); }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  Neighbour best_;
  const Members& members_;
};

/// The k best so far, in a heap with the worst of them on top.
class KNearest {
 public:
  KNearest(std::size_t k, const Members& members, std::vector<Neighbour>& heap)
      : k_(k), members_(members), heap_(heap) {}

  double worstDist() const { return full() ? lenient(heap_.front().squared_distance) : INFINITY; }
  bool full() const { return heap_.size() == k_; }
  bool addPoint(double squared_distance, std::uint32_t place) {
    for (std::uint32_t index : members_.of(place))
      if (!offer({index, squared_distance})) break;  // the rest, of higher index, is no better
    return true;
  }

 private:
  bool offer(const Neighbour& candidate) {
    if (full()) {
      if (!(candidate < heap_.front())) return false;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
    }
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
    return true;
  }

  std::size_t k_;
  const Members& members_;
  std::vector<Neighbour>& heap_;
};

class Within {
 public:
  Within(double squared_radius, const Members& members, std::vector<Neighbour>& found)
      : limit_(squared_radius), members_(members), found_(found) {}

  double worstDist() const { return lenient(limit_); }
  bool full() const { return true; }
  bool addPoint(double squared_distance, std::uint32_t place) {
    if (squared_distance <= limit_)
      for (std::uint32_t index : members_.of(place)) found_.push_back({index, squared_distance});
    return true;
  }

 private:
  double limit_;
  const Members& members_;
  std::vector<Neighbour>& found_;
};

}  // namespace

struct Neighbours::Tree {
  using Metric = nanoflann::L2_Simple_Adaptor<double, Positions, double, std::uint32_t>;
  using Index = nanoflann::KDTreeSingleIndexAdaptor<Metric, Positions, 3, std::uint32_t>;

  explicit Tree(const std::vector<Vec3>& values) : size(values.size()) {
    check_positions(values);
    std::vector<std::uint32_t> order(size);
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    build(values, order, false);
    // Searches look at every point that is as near as the best one. Where thousands share a place that would cost
    // more than sorting them out once.
    if (repeats() <= kFewRepeats) return;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return values[a] != values[b] ? values[a] < values[b] : a < b; });
    build(values, order, true);
  }

  /// A tree of the points in this order; of neighbours at the same place one stands for all if they are to be merged.
  void build(const std::vector<Vec3>& values, const std::vector<std::uint32_t>& order, bool merge) {
    positions.values.clear();
    std::vector<std::uint32_t> begin;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (merge && i > 0 && values[order[i]] == values[order[i - 1]]) continue;
      positions.values.push_back(values[order[i]]);
      begin.push_back(static_cast<std::uint32_t>(i));
    }
    begin.push_back(static_cast<std::uint32_t>(order.size()));
    index.emplace(3, positions, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize));
    store_leaf_by_leaf(begin, order);
  }

  /// A leaf's points are read together, so they are stored together: searches of large clouds wait for memory.
  void store_leaf_by_leaf(const std::vector<std::uint32_t>& begin, const std::vector<std::uint32_t>& order) {
    const std::vector<Vec3> places = positions.values;
    members = {{0}, {}};
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::uint32_t& place = index->vAcc[i];
      positions.values[i] = places[place];
      members.points.insert(members.points.end(), order.begin() + begin[place], order.begin() + begin[place + 1]);
      members.begin.push_back(static_cast<std::uint32_t>(members.points.size()));
      place = static_cast<std::uint32_t>(i);
    }
  }

  std::size_t repeats() const {
    std::size_t count = 0;
    for (std::size_t i = 1; i < positions.values.size(); ++i) count += positions.values[i] == positions.values[i - 1];
    return count;
  }

  template <class ResultSet>
  void search(ResultSet& result, const Vec3& query) const {
    if (size > 0 && is_finite(query)) index->findNeighbors(result, query.data(), nanoflann::SearchParams());
  }

  static constexpr std::size_t kFewRepeats = 2000;
  std::size_t size;
  Positions positions;  ///< in the order of the leaves
  Members members;
  std::optional<Index> index;
};

Neighbours::Neighbours(const std::vector<Vec3>& positions) : tree_(std::make_unique<Tree>(positions)) {}
Neighbours::~Neighbours() = default;
Neighbours::Neighbours(Neighbours&&) noexcept = default;
Neighbours& Neighbours::operator=(Neighbours&&) noexcept = default;

std::size_t Neighbours::size() const { return tree_->size; }

void Neighbours::nearest(const Vec3& query, std::size_t k, std::vector<Neighbour>& found) const {
  found.clear();
  k = std::min(k, size());
  if (k == 0) return;
  found.reserve(k);
  KNearest result(k, tree_->members, found);
  tree_->search(result, query);
  std::sort_heap(found.begin(), found.end());
}

std::vector<Neighbour> Neighbours::nearest(const Vec3& query, std::size_t k) const {
  std::vector<Neighbour> found;
  nearest(query, k, found);
  return found;
}

void Neighbours::within(const Vec3& query, double radius, std::vector<Neighbour>& found) const {
  found.clear();
  if (!(radius >= 0)) return;
  Within result(radius * radius, tree_->members, found);
  tree_->search(result, query);
  std::sort(found.begin(), found.end());
}

std::vector<Neighbour> Neighbours::within(const Vec3& query, double radius) const {
  std::vector<Neighbour> found;
  within(query, radius, found);
  return found;
}

std::optional<Neighbour> Neighbours::closest(const Vec3& query, double max_distance) const {
  if (!(max_distance >= 0)) return std::nullopt;
  Closest result(max_distance * max_distance, tree_->members);
  tree_->search(result, query);
  return result.found();
}

}  // namespace scarp

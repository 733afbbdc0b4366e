// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/neighbours/neighbours.hpp"

#include <algorithm>
#include <limits>
#include <nanoflann.hpp>
#include <numeric>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr double kLargestCoordinate = 1e100;  // m; its square is still finite
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

class Closest {
 public:
  Closest(double squared_limit, const std::vector<std::uint32_t>& original)
      : best_{std::numeric_limits<std::size_t>::max(), squared_limit}, original_(original) {}

  double worstDist() const { return lenient(best_.squared_distance); }
  bool full() const { return true; }
  bool addPoint(double squared_distance, std::uint32_t stored) {
    best_ = std::min(best_, Neighbour{original_[stored], squared_distance});
    return true;
  }
  std::optional<Neighbour> found() const {
    if (best_.index == std::numeric_limits<std::size_t>::max()) return std::nullopt;
    return best_;
  }

 private:
  Neighbour best_;
  const std::vector<std::uint32_t>& original_;
};

/// The k best so far, in a heap with the worst of them on top.
class KNearest {
 public:
  KNearest(std::size_t k, const std::vector<std::uint32_t>& original, std::vector<Neighbour>& heap)
      : k_(k), original_(original), heap_(heap) {}

  double worstDist() const { return full() ? lenient(heap_.front().squared_distance) : INFINITY; }
  bool full() const { return heap_.size() == k_; }
  bool addPoint(double squared_distance, std::uint32_t stored) {
    const Neighbour candidate{original_[stored], squared_distance};
    if (full()) {
      if (!(candidate < heap_.front())) return true;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
    }
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
    return true;
  }

 private:
  std::size_t k_;
  const std::vector<std::uint32_t>& original_;
  std::vector<Neighbour>& heap_;
};

class Within {
 public:
  Within(double squared_radius, const std::vector<std::uint32_t>& original, std::vector<Neighbour>& found)
      : limit_(squared_radius), original_(original), found_(found) {}

  double worstDist() const { return lenient(limit_); }
  bool full() const { return true; }
  bool addPoint(double squared_distance, std::uint32_t stored) {
    if (squared_distance <= limit_) found_.push_back({original_[stored], squared_distance});
    return true;
  }

 private:
  double limit_;
  const std::vector<std::uint32_t>& original_;
  std::vector<Neighbour>& found_;
};

const std::vector<Vec3>& checked(const std::vector<Vec3>& positions) {
  if (positions.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error("neighbours", "too many points for a search tree", std::to_string(positions.size()), "below 2^32");
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (double c : positions[i])
      if (!(std::abs(c) <= kLargestCoordinate))
        throw Error("neighbours", "a coordinate of point " + std::to_string(i) + " cannot be searched", shortest(c),
                    "finite numbers");
  return positions;
}

}  // namespace

struct Neighbours::Tree {
  using Metric = nanoflann::L2_Simple_Adaptor<double, Positions, double, std::uint32_t>;
  using Index = nanoflann::KDTreeSingleIndexAdaptor<Metric, Positions, 3, std::uint32_t>;

  explicit Tree(const std::vector<Vec3>& values)
      : positions{checked(values)}, index(3, positions, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {
    store_leaf_by_leaf(values);
  }

  /// A leaf's points are read together, so they are stored together: searches of large clouds wait for memory.
  void store_leaf_by_leaf(const std::vector<Vec3>& values) {
    original.swap(index.vAcc);
    index.vAcc.resize(original.size());
    std::iota(index.vAcc.begin(), index.vAcc.end(), std::uint32_t{0});
    for (std::size_t i = 0; i < original.size(); ++i) positions.values[i] = values[original[i]];
  }

  template <class ResultSet>
  void search(ResultSet& result, const Vec3& query) const {
    if (!positions.values.empty() && is_finite(query))
      index.findNeighbors(result, query.data(), nanoflann::SearchParams());
  }

  Positions positions;                  ///< in the order of the leaves
  std::vector<std::uint32_t> original;  ///< index that the caller knows each of them by
  Index index;
};

Neighbours::Neighbours(const std::vector<Vec3>& positions) : tree_(std::make_unique<Tree>(positions)) {}
Neighbours::~Neighbours() = default;
Neighbours::Neighbours(Neighbours&&) noexcept = default;
Neighbours& Neighbours::operator=(Neighbours&&) noexcept = default;

std::size_t Neighbours::size() const { return tree_->positions.values.size(); }

void Neighbours::nearest(const Vec3& query, std::size_t k, std::vector<Neighbour>& found) const {
  found.clear();
  k = std::min(k, size());
  if (k == 0) return;
  found.reserve(k);
  KNearest result(k, tree_->original, found);
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
  Within result(radius * radius, tree_->original, found);
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
  Closest result(max_distance * max_distance, tree_->original);
  tree_->search(result, query);
  return result.found();
}

}  // namespace scarp

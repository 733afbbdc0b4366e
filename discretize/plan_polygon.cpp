// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/plan_polygon.hpp"

#include <cmath>

#include "discretize/plane_geometry_cgal.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr std::size_t kMostSlots = 512;

/// Twice the signed area, taken about the first corner to keep digits far from the origin.
double doubled_area(const std::vector<Vec2>& p) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    sum += (p[i][0] - p[0][0]) * (p[i + 1][1] - p[0][1]) - (p[i + 1][0] - p[0][0]) * (p[i][1] - p[0][1]);
  return sum;
}

}  // namespace

PlanPolygon::PlanPolygon(std::vector<Vec2> corners, const std::string& what) : corners_(std::move(corners)) {
  if (corners_.size() > 1 && corners_.front() == corners_.back()) corners_.pop_back();
  if (corners_.size() < 3)
    throw Error("discretize", what, std::to_string(corners_.size()) + " corners", "at least 3 corners");
  for (std::size_t i = 0; i < corners_.size(); ++i)
    if (!std::isfinite(corners_[i][0]) || !std::isfinite(corners_[i][1]))
      throw Error("discretize", what + ", corner " + std::to_string(i + 1), "a coordinate that is not finite",
                  "finite coordinates");
  if (!is_simple_polygon(corners_))
    throw Error("discretize", what, "a border that crosses or touches itself", "a simple polygon");
  if (doubled_area(corners_) < 0) std::reverse(corners_.begin(), corners_.end());
  area_ = 0.5 * doubled_area(corners_);
  if (!(area_ > 0)) throw Error("discretize", what, "area " + shortest(area_) + " m2", "an area above 0 m2");
  min_ = max_ = corners_[0];
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec2 &p = corners_[i], &q = corners_[(i + 1) % corners_.size()];
    for (int a = 0; a < 2; ++a) {
      min_[a] = std::min(min_[a], p[a]);
      max_[a] = std::max(max_[a], p[a]);
    }
    const double sign = p[0] < q[0] ? -1 : (p[0] > q[0] ? 1 : 0);
    edges_.push_back(sign <= 0 ? Edge{p, q, sign} : Edge{q, p, sign});
  }
  sort_into_slots();
}

std::size_t PlanPolygon::slot(double x) const {
  const double s = (x - min_[0]) / (max_[0] - min_[0]) * static_cast<double>(slots_);
  return s > 0 ? std::min(slots_ - 1, static_cast<std::size_t>(std::min(s, 1e9))) : 0;
}

void PlanPolygon::sort_into_slots() {
  slots_ = std::min(kMostSlots, edges_.size());
  slot_first_.assign(slots_ + 1, 0);
  for (const Edge& edge : edges_)
    for (std::size_t s = slot(edge.left[0]); s <= slot(edge.right[0]); ++s) ++slot_first_[s + 1];
  for (std::size_t s = 0; s < slots_; ++s) slot_first_[s + 1] += slot_first_[s];
  slot_edges_.resize(slot_first_[slots_]);
  std::vector<std::size_t> next(slot_first_.begin(), slot_first_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    for (std::size_t s = slot(edges_[e].left[0]); s <= slot(edges_[e].right[0]); ++s) slot_edges_[next[s]++] = e;
}

bool PlanPolygon::contains(double x, double y) const {
  bool inside = false;
  for_each_edge_over(x, x, [&](const Edge& edge) {
    if (edge.left[0] <= x && x < edge.right[0] && edge.height_at(x) <= y) inside = !inside;
  });
  return inside;
}

void PlanPolygon::crossings(double x, std::vector<double>& heights) const {
  heights.clear();
  for_each_edge_over(x, x, [&](const Edge& edge) {
    if (edge.left[0] <= x && x < edge.right[0]) heights.push_back(edge.height_at(x));
  });
  std::sort(heights.begin(), heights.end());
}

}  // namespace scarp

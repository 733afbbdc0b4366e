// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/plan_integral.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

/// A convex piece of a triangle: three corners and at most one more for each of four cuts.
struct Piece {
  std::array<Vec3, 8> corner;
  int count = 0;
};

/// The part of a convex piece where side(p) >= 0; side is affine (Sutherland and Hodgman).
template <class Side>
Piece cut(const Piece& piece, Side&& side) {
  Piece kept;
  for (int i = 0; i < piece.count; ++i) {
    const Vec3& p = piece.corner[i];
    const Vec3& q = piece.corner[(i + 1) % piece.count];
    const double sp = side(p), sq = side(q);
    if (sp >= 0) kept.corner[kept.count++] = p;
    if ((sp >= 0) != (sq >= 0) && kept.count < 8) kept.corner[kept.count++] = p + sp / (sp - sq) * (q - p);
  }
  return kept;
}

struct Moments {
  double area = 0;
  double volume = 0;
};

/// Plan area of a piece, and the volume between it and the floor.
Moments moments(const Piece& piece, double floor) {
  Moments sum;
  for (int i = 1; i + 1 < piece.count; ++i) {
    const Vec3 &a = piece.corner[0], &b = piece.corner[i], &c = piece.corner[i + 1];
    const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    sum.area += area;
    sum.volume += area * ((a[2] - floor) + (b[2] - floor) + (c[2] - floor)) / 3;
  }
  return sum;
}

Box3 bounds_of(const Piece& piece) {
  Box3 box;
  for (int i = 0; i < piece.count; ++i) box.extend(piece.corner[i]);
  return box;
}

/// True if an edge of the outline may run through the box (plan).
bool outline_is_near(const PlanPolygon& outline, const Box3& box) {
  bool near = false;
  outline.for_each_edge_over(box.min[0], box.max[0], [&](const PlanPolygon::Edge& e) {
    near = near || !(std::min(e.left[1], e.right[1]) > box.max[1] || std::max(e.left[1], e.right[1]) < box.min[1]);
  });
  return near;
}

Moments moments_inside(const Piece& piece, const PlanPolygon& outline, double floor) {
  const Box3 box = bounds_of(piece);
  Moments sum;
  outline.for_each_edge_over(box.min[0], box.max[0], [&](const PlanPolygon::Edge& e) {
    if (e.sign == 0) return;
    Piece part = cut(piece, [&](const Vec3& p) { return p[0] - e.left[0]; });
    part = cut(part, [&](const Vec3& p) { return e.right[0] - p[0]; });
    part = cut(part, [&](const Vec3& p) {
      return (e.right[0] - e.left[0]) * (e.left[1] - p[1]) + (p[0] - e.left[0]) * (e.right[1] - e.left[1]);
    });
    const Moments m = moments(part, floor);
    sum.area += e.sign * m.area;
    sum.volume += e.sign * m.volume;
  });
  return sum;
}

/// Height of the plane of a triangle at (x, y), kept between its corners'.
double plane_height(const std::array<Vec3, 3>& t, double x, double y) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double z = n[2] != 0 ? t[0][2] - (n[0] * (x - t[0][0]) + n[1] * (y - t[0][1])) / n[2] : t[0][2];
  return std::clamp(z, std::min({t[0][2], t[1][2], t[2][2]}), std::max({t[0][2], t[1][2], t[2][2]}));
}

bool covers(const Piece& piece, const Vec2& c) {
  for (int i = 0; i < piece.count; ++i) {
    const Vec3 &p = piece.corner[i], &q = piece.corner[(i + 1) % piece.count];
    if ((q[0] - p[0]) * (c[1] - p[1]) - (q[1] - p[1]) * (c[0] - p[0]) < 0) return false;
  }
  return piece.count > 2;
}

/// Corners of the part of a piece inside the outline: its own, the outline's, and where their edges cross.
void extend_bounds_inside(const Piece& piece, const std::array<Vec3, 3>& plane, const PlanPolygon& outline, Box3& box) {
  for (int i = 0; i < piece.count; ++i)
    if (outline.contains(piece.corner[i][0], piece.corner[i][1])) box.extend(piece.corner[i]);
  const Box3 own = bounds_of(piece);
  outline.for_each_edge_over(own.min[0], own.max[0], [&](const PlanPolygon::Edge& e) {
    const Vec2 &a = e.left, &b = e.right;
    for (const Vec2& c : {a, b})
      if (covers(piece, c)) box.extend({c[0], c[1], plane_height(plane, c[0], c[1])});
    const auto side = [&](const Vec3& r) { return (b[0] - a[0]) * (r[1] - a[1]) - (b[1] - a[1]) * (r[0] - a[0]); };
    for (int i = 0; i < piece.count; ++i) {
      const Vec3 &p = piece.corner[i], &q = piece.corner[(i + 1) % piece.count];
      const double sp = side(p), sq = side(q);
      if ((sp < 0) == (sq < 0)) continue;
      const Vec3 met = p + sp / (sp - sq) * (q - p);
      const double along = (met[0] - a[0]) * (b[0] - a[0]) + (met[1] - a[1]) * (b[1] - a[1]);
      if (along >= 0 && along <= (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])) box.extend(met);
    }
  });
}

void add_triangle(const std::array<Vec3, 3>& triangle, const std::optional<PlanPolygon>& outline,
                  std::optional<double> floor, PlanIntegral& sum) {
  Piece piece{{triangle[0], triangle[1], triangle[2]}, 3};
  if (floor) piece = cut(piece, [&](const Vec3& p) { return p[2] - *floor; });
  if (piece.count < 3) return;
  const bool crossed = outline && outline_is_near(*outline, bounds_of(piece));
  if (outline && !crossed && !outline->contains(piece.corner[0][0], piece.corner[0][1])) return;
  // Without a floor, heights are taken from the surface itself, so that the volume is none.
  const Moments m = crossed ? moments_inside(piece, *outline, floor.value_or(0)) : moments(piece, floor.value_or(0));
  sum.area += m.area;
  if (floor) sum.volume += m.volume;
  if (crossed)
    extend_bounds_inside(piece, triangle, *outline, sum.bounds);
  else
    for (int i = 0; i < piece.count; ++i) sum.bounds.extend(piece.corner[i]);
}

/// Triangles of a TIN by slots of its plan.
class PlanBins {
 public:
  explicit PlanBins(const Tin& tin) : tin_(tin) {
    for (const Vec3& p : tin.points) bounds_.extend(p);
    side_ = std::clamp(static_cast<int>(std::sqrt(0.5 * static_cast<double>(tin.triangles.size()))), 1, 4096);
    first_.assign(static_cast<std::size_t>(side_) * side_ + 1, 0);
    for (int pass = 0; pass < 2; ++pass) {
      for (std::uint32_t t = 0; t < tin.triangles.size(); ++t)
        each_slot(box_of(t), [&](std::size_t s) {
          if (pass == 0)
            ++first_[s + 1];
          else
            members_[filled_[s]++] = t;
        });
      if (pass == 1) break;
      for (std::size_t s = 1; s < first_.size(); ++s) first_[s] += first_[s - 1];
      members_.resize(first_.back());
      filled_ = first_;
    }
  }

  /// f(triangle) of those whose box in plan meets `box`, each once, in an order that depends on nothing else.
  template <class F>
  void each_over(const Box3& box, F&& f) const {
    each_slot(box, [&](std::size_t s) {
      for (std::size_t m = first_[s]; m < first_[s + 1]; ++m) {
        const Box3 other = box_of(members_[m]);
        const double x = std::max(box.min[0], other.min[0]), y = std::max(box.min[1], other.min[1]);
        if (x > std::min(box.max[0], other.max[0]) || y > std::min(box.max[1], other.max[1])) continue;
        if (slot(y, 1) * side_ + slot(x, 0) == s) f(members_[m]);  // in the first slot that both are in
      }
    });
  }

 private:
  Box3 box_of(std::uint32_t t) const {
    Box3 box;
    for (const Vec3& p : tin_.corners(t)) box.extend(p);
    return box;
  }
  std::size_t slot(double x, int axis) const {
    const double width = bounds_.max[axis] - bounds_.min[axis];
    return static_cast<std::size_t>(std::clamp((x - bounds_.min[axis]) / width * side_, 0.0, side_ - 1.0));
  }
  template <class F>
  void each_slot(const Box3& box, F&& f) const {
    for (std::size_t j = slot(box.min[1], 1); j <= slot(box.max[1], 1); ++j)
      for (std::size_t i = slot(box.min[0], 0); i <= slot(box.max[0], 0); ++i) f(j * side_ + i);
  }

  const Tin& tin_;
  Box3 bounds_;
  int side_ = 1;
  std::vector<std::size_t> first_, filled_;
  std::vector<std::uint32_t> members_;
};

void add_overlap(const std::array<Vec3, 3>& top, const std::array<Vec3, 3>& base,
                 const std::optional<PlanPolygon>& outline, PlanIntegral& sum) {
  Piece piece{{top[0], top[1], top[2]}, 3};
  for (int e = 0; e < 3; ++e) {
    const Vec3 &p = base[e], &q = base[(e + 1) % 3];
    piece = cut(piece, [&](const Vec3& r) { return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]); });
  }
  for (int i = 0; i < piece.count; ++i)
    piece.corner[i][2] -= plane_height(base, piece.corner[i][0], piece.corner[i][1]);
  piece = cut(piece, [](const Vec3& p) { return p[2]; });
  if (piece.count < 3) return;
  const bool crossed = outline && outline_is_near(*outline, bounds_of(piece));
  if (outline && !crossed && !outline->contains(piece.corner[0][0], piece.corner[0][1])) return;
  const Moments m = crossed ? moments_inside(piece, *outline, 0) : moments(piece, 0);
  sum.area += m.area;
  sum.volume += m.volume;
  for (const auto& plane : {top, base}) {
    for (int i = 0; i < piece.count; ++i)
      piece.corner[i][2] = plane_height(plane, piece.corner[i][0], piece.corner[i][1]);
    if (crossed)
      extend_bounds_inside(piece, plane, *outline, sum.bounds);
    else
      for (int i = 0; i < piece.count; ++i) sum.bounds.extend(piece.corner[i]);
  }
}

/// Sums add(triangle, sum) over the triangles of a TIN, in an order that does not depend on the threads.
template <class Add>
PlanIntegral sum_over(const Tin& tin, int threads, Add&& add) {
  const std::size_t blocks = (tin.triangles.size() + kReductionBlock - 1) / kReductionBlock;
  std::vector<PlanIntegral> part(blocks);
  parallel_for(blocks, threads, [&](std::size_t b) {
    const std::size_t end = std::min(tin.triangles.size(), (b + 1) * kReductionBlock);
    for (std::size_t t = b * kReductionBlock; t < end; ++t) add(tin.corners(t), part[b]);
  });
  PlanIntegral sum;
  for (const PlanIntegral& p : part) {
    sum.area += p.area;
    sum.volume += p.volume;
    if (p.bounds.empty()) continue;
    sum.bounds.extend(p.bounds.min);
    sum.bounds.extend(p.bounds.max);
  }
  return sum;
}

}  // namespace

PlanIntegral integrate_tin(const Tin& tin, const std::optional<PlanPolygon>& outline, std::optional<double> floor,
                           int threads) {
  return sum_over(tin, threads, [&](const std::array<Vec3, 3>& triangle, PlanIntegral& sum) {
    add_triangle(triangle, outline, floor, sum);
  });
}

PlanIntegral integrate_between(const Tin& top, const Tin& base, const std::optional<PlanPolygon>& outline,
                               int threads) {
  const PlanBins bins(base);
  return sum_over(top, threads, [&](const std::array<Vec3, 3>& triangle, PlanIntegral& sum) {
    Box3 box;
    for (const Vec3& p : triangle) box.extend(p);
    bins.each_over(box, [&](std::uint32_t t) { add_overlap(triangle, base.corners(t), outline, sum); });
  });
}

}  // namespace scarp

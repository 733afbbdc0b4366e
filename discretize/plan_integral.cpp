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

}  // namespace

PlanIntegral integrate_tin(const Tin& tin, const std::optional<PlanPolygon>& outline, std::optional<double> floor,
                           int threads) {
  const std::size_t blocks = (tin.triangles.size() + kReductionBlock - 1) / kReductionBlock;
  std::vector<PlanIntegral> part(blocks);
  parallel_for(blocks, threads, [&](std::size_t b) {
    const std::size_t end = std::min(tin.triangles.size(), (b + 1) * kReductionBlock);
    for (std::size_t t = b * kReductionBlock; t < end; ++t) add_triangle(tin.corners(t), outline, floor, part[b]);
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

}  // namespace scarp

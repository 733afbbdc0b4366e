// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr std::size_t kLeafSize = 4;

/// Squared distance from a point to a box, never more than to what is in it.
double squared_gap(const Vec3& p, const Vec3& low, const Vec3& high) {
  double squared = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double gap = std::max({low[a] - p[a], p[a] - high[a], 0.0});
    squared += gap * gap;
  }
  return squared;
}

/// The angle at `a` between the edges to `b` and `c`.
double angle_at(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  return std::atan2(norm(cross(u, v)), dot(u, v));
}

ClosestPoint found(const Vec3& p, const Vec3& point, Feature feature) {
  const Vec3 d = p - point;
  return {point, dot(d, d), 0, feature};
}

/// Whether the way from `from` along `way` meets a box.
bool passes(const Vec3& from, const Vec3& way, const Vec3& low, const Vec3& high) {
  double begin = 0, end = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const double slack = 1e-9 * (high[a] - low[a] + std::abs(way[a]));
    const double to_low = low[a] - slack - from[a], to_high = high[a] + slack - from[a];
    if (way[a] == 0) {
      if (to_low > 0 || to_high < 0) return false;
      continue;
    }
    begin = std::max(begin, std::min(to_low / way[a], to_high / way[a]));
    end = std::min(end, std::max(to_low / way[a], to_high / way[a]));
  }
  return begin <= end;
}

/// The share of the way at which it enters a triangle from its front; infinite where it does not. Triangles are taken a
/// little larger than they are, so that nothing slips through between two.
double entry(const Vec3& from, const Vec3& way, const std::array<Vec3, 3>& corners, const Vec3& normal) {
  constexpr double missed = INFINITY, slack = -1e-9;
  const double down = -dot(way, normal), height = dot(from - corners[0], normal);
  if (!(down > 0) || height < 0 || height > down) return missed;
  const double when = height / down;
  const Vec3 at = from + when * way, u = corners[1] - corners[0], v = corners[2] - corners[0], w = at - corners[0];
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double D = uu * vv - uv * uv, s = (vv * wu - uv * wv) / D, t = (uu * wv - uv * wu) / D;
  return s >= slack && t >= slack && s + t <= 1 - slack ? when : missed;
}

}  // namespace

ClosestPoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return found(p, a, Feature::vertex_0);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return found(p, b, Feature::vertex_1);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return found(p, a + (d1 / (d1 - d3)) * ab, Feature::edge_01);
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return found(p, c, Feature::vertex_2);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return found(p, a + (d2 / (d2 - d6)) * ac, Feature::edge_20);
  const double va = d3 * d6 - d5 * d4;
  const double along = (d4 - d3) + (d5 - d6);
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return found(p, b + ((d4 - d3) / along) * (c - b), Feature::edge_12);
  const double scale = 1 / (va + vb + vc);
  return found(p, a + (vb * scale) * ab + (vc * scale) * ac, Feature::face);
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  read_triangles(mesh);
  join_edges();
  weigh_vertices(mesh.vertices.size());
  nodes_.reserve(2 * triangles_.size());
  build(0, triangles_.size());
  place_of_.assign(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < triangles_.size(); ++i) place_of_[triangles_[i].index] = static_cast<std::uint32_t>(i);
}

void TriangleTree::read_triangles(const TriangleMesh& mesh) {
  if (mesh.triangles.size() >= (std::size_t{1} << 31))
    throw Error("mesh", "triangles of the mesh", std::to_string(mesh.triangles.size()), "below 2^31");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!is_finite(mesh.vertices[v])) throw Error("mesh", "vertex " + std::to_string(v) + " of the mesh is not finite");
  triangles_.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    for (std::uint32_t index : v)
      if (index >= mesh.vertices.size())
        throw Error("mesh", "triangle " + std::to_string(t) + " of the mesh names a vertex that is not there",
                    std::to_string(index), "below " + std::to_string(mesh.vertices.size()));
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = mesh.vertices[v[k]];
    const Vec3 area = cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
    const double size = norm(area);
    if (!(size > 0)) {
      ++left_out_;
      continue;
    }
    triangle.vertices = v;
    triangle.index = static_cast<std::uint32_t>(t);
    triangle.normal = (1 / size) * area;
    triangles_.push_back(triangle);
  }
  if (triangles_.empty()) throw Error("mesh", "the mesh has no triangle with an area", "0", "at least 1");
}

/// Sums the normals of the triangles at each edge. Edges are the pairs of their vertices, sorted.
void TriangleTree::join_edges() {
  struct Side {
    std::uint32_t low, high, triangle;
    std::uint8_t edge;
    bool forward;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles_.size());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (std::uint8_t e = 0; e < 3; ++e) {
      const std::uint32_t from = triangles_[t].vertices[e], to = triangles_[t].vertices[(e + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), t, e, from < to});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle, a.edge) < std::tie(b.low, b.high, b.triangle, b.edge);
  });
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    Vec3 sum{0, 0, 0};
    int forward = 0;
    for (end = begin; end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high;
         ++end) {
      sum = sum + triangles_[sides[end].triangle].normal;
      forward += sides[end].forward;
    }
    const bool border = end - begin == 1;
    border_edges_ += border;
    bad_edges_ += end - begin > 2 || (end - begin == 2 && forward != 1);
    for (std::size_t i = begin; i < end; ++i) {
      triangles_[sides[i].triangle].edge_normals[sides[i].edge] = sum;
      triangles_[sides[i].triangle].border[sides[i].edge] = border;
    }
  }
}

void TriangleTree::weigh_vertices(std::size_t vertices) {
  vertex_normals_.assign(vertices, {0, 0, 0});
  border_vertex_.assign(vertices, false);
  for (const Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = angle_at(t.corners[k], t.corners[(k + 1) % 3], t.corners[(k + 2) % 3]);
      vertex_normals_[t.vertices[k]] = vertex_normals_[t.vertices[k]] + angle * t.normal;
      if (t.border[k]) border_vertex_[t.vertices[k]] = border_vertex_[t.vertices[(k + 1) % 3]] = true;
    }
}

void TriangleTree::build(std::size_t begin, std::size_t end) {
  Box3 box, centres;
  const auto centre = [](const Triangle& t) { return t.corners[0] + t.corners[1] + t.corners[2]; };
  for (std::size_t i = begin; i < end; ++i) {
    for (const Vec3& corner : triangles_[i].corners) box.extend(corner);
    centres.extend(centre(triangles_[i]));
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back({box.min, box.max, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), 0});
  if (end - begin > kLeafSize) {
    const Vec3 extent = centres.max - centres.min;
    const auto axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](const Triangle& a, const Triangle& b) {
      const double x = centre(a)[axis], y = centre(b)[axis];
      return x < y || (x == y && a.index < b.index);
    });
    build(begin, middle);
    build(middle, end);
  }
  nodes_[self].next = static_cast<std::uint32_t>(nodes_.size());
}

template <class Accept>
std::optional<ClosestPoint> TriangleTree::closest_of(const Vec3& p, double max_distance, Accept&& accept) const {
  std::optional<ClosestPoint> best;
  if (!is_finite(p) || !(max_distance >= 0)) return best;
  double limit = max_distance * max_distance;
  const auto look = [&](const Triangle& t) {
    if (!accept(t)) return;
    ClosestPoint candidate = closest_on_triangle(p, t.corners[0], t.corners[1], t.corners[2]);
    candidate.triangle = t.index;
    if (candidate.squared_distance > limit) return;
    if (best && candidate.squared_distance == limit && candidate.triangle > best->triangle) return;
    best = candidate;
    limit = candidate.squared_distance;
  };
  // Down the nearer child first: a small stack, two entries per level at most.
  std::array<std::pair<double, std::uint32_t>, 128> stack;
  std::size_t depth = 0;
  stack[depth++] = {squared_gap(p, nodes_[0].low, nodes_[0].high), 0};
  while (depth > 0) {
    const auto [gap, i] = stack[--depth];
    if (gap > limit * (1 + 1e-12)) continue;
    const Node& node = nodes_[i];
    if (node.next == i + 1) {
      for (std::uint32_t t = node.begin; t < node.end; ++t) look(triangles_[t]);
      continue;
    }
    const std::uint32_t left = i + 1, right = nodes_[left].next;
    std::pair<double, std::uint32_t> near{squared_gap(p, nodes_[left].low, nodes_[left].high), left};
    std::pair<double, std::uint32_t> far{squared_gap(p, nodes_[right].low, nodes_[right].high), right};
    if (far.first < near.first) std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return best;
}

std::optional<ClosestPoint> TriangleTree::closest(const Vec3& p, double max_distance) const {
  return closest_of(p, max_distance, [](const Triangle&) { return true; });
}

std::optional<ClosestPoint> TriangleTree::closest_facing(const Vec3& p, double max_distance, const Vec3& facing,
                                                         double least) const {
  return closest_of(p, max_distance, [&](const Triangle& t) { return dot(t.normal, facing) > least; });
}

std::optional<std::uint32_t> TriangleTree::first_entered(const Vec3& from, const Vec3& to) const {
  const Vec3 way = to - from;
  std::optional<std::uint32_t> first;
  double earliest = 1;
  const auto look = [&](const Triangle& t) {
    const double when = entry(from, way, t.corners, t.normal);
    if (!(when <= earliest) || (first && when == earliest && t.index > *first)) return;
    earliest = when;
    first = t.index;
  };
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    if (!passes(from, way, node.low, node.high)) {
      i = node.next;
      continue;
    }
    if (node.next == i + 1)
      for (std::uint32_t t = node.begin; t < node.end; ++t) look(triangles_[t]);
    ++i;
  }
  return first;
}

std::optional<Vec3> TriangleTree::normal_across(const ClosestPoint& closest) const {
  const Triangle& t = triangles_[place_of_[closest.triangle]];
  const auto feature = static_cast<std::size_t>(closest.feature);
  if (feature == 0 || feature > 3) return t.normal;
  if (t.border[feature - 1]) return std::nullopt;
  return t.edge_normals[feature - 1] - t.normal;
}

const Vec3& TriangleTree::normal(const ClosestPoint& closest) const {
  const Triangle& t = triangles_[place_of_[closest.triangle]];
  const auto feature = static_cast<std::size_t>(closest.feature);
  return feature == 0 ? t.normal : feature < 4 ? t.edge_normals[feature - 1] : vertex_normals_[t.vertices[feature - 4]];
}

double TriangleTree::side(const Vec3& p, const ClosestPoint& closest) const {
  return dot(p - closest.point, normal(closest));
}

bool TriangleTree::on_border(const ClosestPoint& closest) const {
  const Triangle& t = triangles_[place_of_[closest.triangle]];
  const auto feature = static_cast<std::size_t>(closest.feature);
  return feature != 0 && (feature < 4 ? t.border[feature - 1] : border_vertex_[t.vertices[feature - 4]]);
}

}  // namespace scarp

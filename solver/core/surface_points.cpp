// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace scarp {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Vertices halfway on edges, one for both triangles at an edge.
class Halves {
 public:
  Halves(std::vector<Vec3>& vertices, double longest) : vertices_(vertices), longest_(longest) {}

  /// Of the edge, or nothing where it is short enough.
  std::optional<std::uint32_t> of(std::uint32_t a, std::uint32_t b) {
    if (!(norm(vertices_[b] - vertices_[a]) > longest_)) return std::nullopt;
    const auto next = static_cast<std::uint32_t>(vertices_.size());
    const auto [entry, made] = halves_.try_emplace({std::min(a, b), std::max(a, b)}, next);
    if (made) vertices_.push_back(0.5 * (vertices_[a] + vertices_[b]));
    return entry->second;
  }

 private:
  std::vector<Vec3>& vertices_;
  double longest_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> halves_;
};

/// A triangle in two, three or four, after which of its edges are halved.
void split(const Triangle& t, const std::array<std::optional<std::uint32_t>, 3>& halves, std::vector<Triangle>& parts) {
  // Turned so that the first edge is halved, and the third one is not unless all are.
  std::size_t k = 0;
  const auto half = [&](std::size_t e) { return halves[(k + e) % 3]; };
  const auto count = std::count_if(halves.begin(), halves.end(), [](const auto& h) { return h.has_value(); });
  if (count == 0) return parts.push_back(t);
  while (!half(0) || (count == 2 && half(2))) ++k;
  const std::uint32_t a = t[k % 3], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = *half(0);
  if (count == 1) {
    parts.push_back({a, ab, c});
    parts.push_back({ab, b, c});
    return;
  }
  const std::uint32_t bc = *half(1);
  parts.push_back({ab, b, bc});
  if (count == 2) {
    parts.push_back({a, ab, bc});
    parts.push_back({a, bc, c});
    return;
  }
  const std::uint32_t ca = *half(2);
  parts.push_back({a, ab, ca});
  parts.push_back({ca, bc, c});
  parts.push_back({ab, bc, ca});
}

SurfacePoints of_triangles(const TriangleMesh& surface, double spacing) {
  SurfacePoints points;
  points.places = surface.vertices;
  std::vector<Triangle> triangles = surface.triangles, parts;
  for (std::size_t before = 0; before != points.places.size();) {
    before = points.places.size();
    Halves halves(points.places, spacing);
    parts.clear();
    for (const Triangle& t : triangles)
      split(t, {halves.of(t[0], t[1]), halves.of(t[1], t[2]), halves.of(t[2], t[0])}, parts);
    triangles = parts;
  }
  points.areas.assign(points.places.size(), 0);
  for (const Triangle& t : triangles) {
    const Vec3 &a = points.places[t[0]], &b = points.places[t[1]], &c = points.places[t[2]];
    for (std::uint32_t v : t) points.areas[v] += norm(cross(b - a, c - a)) / 6;
  }
  return points;
}

/// The first of the two triangles of each side of a prism has its lower edge first.
SurfacePoints of_outline(const TriangleMesh& prism, double spacing) {
  SurfacePoints points;
  std::map<std::uint32_t, std::size_t> corners;
  const auto corner = [&](std::uint32_t v) {
    const auto [entry, made] = corners.try_emplace(v, points.places.size());
    if (made) {
      points.places.push_back({prism.vertices[v][0], prism.vertices[v][1], 0});
      points.areas.push_back(0);
    }
    return entry->second;
  };
  for (std::size_t t = 0; t < prism.triangles.size(); t += 2) {
    std::size_t last = corner(prism.triangles[t][0]);
    const std::size_t end = corner(prism.triangles[t][1]);
    const Vec3 from = points.places[last], way = points.places[end] - from;
    const double parts = std::max(1.0, std::ceil(norm(way) / spacing));
    for (double k = 1; k <= parts; ++k) {
      std::size_t next = end;
      if (k < parts) {
        next = points.places.size();
        points.places.push_back(from + (k / parts) * way);
        points.areas.push_back(0);
      }
      for (std::size_t v : {last, next}) points.areas[v] += 0.5 * norm(way) / parts;
      last = next;
    }
  }
  return points;
}

}  // namespace

SurfacePoints spread_points(const TriangleMesh& surface, double spacing, int dimension) {
  return dimension == 2 ? of_outline(surface, spacing) : of_triangles(surface, spacing);
}

}  // namespace scarp

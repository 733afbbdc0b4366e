// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/plane_geometry_cgal.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Projection_traits_xy_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

namespace scarp {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Plan = CGAL::Projection_traits_xy_3<Kernel>;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Plan>;  // index into the points
using Face = CGAL::Triangulation_face_base_with_info_2<bool, Plan>;               // true: peeled off
using Delaunay = CGAL::Delaunay_triangulation_2<Plan, CGAL::Triangulation_data_structure_2<Vertex, Face>>;

std::vector<Vec3> highest_of_each_place(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) {
    return std::tie(a[0], a[1], b[2]) < std::tie(b[0], b[1], a[2]);  // highest first
  });
  points.erase(std::unique(points.begin(), points.end(),
                           [](const Vec3& a, const Vec3& b) { return a[0] == b[0] && a[1] == b[1]; }),
               points.end());
  return points;
}

bool has_longer_edge(const Delaunay::Face& face, double longest) {
  for (int e = 0; e < 3; ++e) {
    const auto& p = face.vertex(e)->point();
    const auto& q = face.vertex((e + 1) % 3)->point();
    const double dx = p.x() - q.x(), dy = p.y() - q.y();
    if (dx * dx + dy * dy > longest * longest) return true;
  }
  return false;
}

/// A long triangle goes if it is at the border, or beside one that went.
void peel(Delaunay& delaunay, double longest) {
  std::vector<Delaunay::Face_handle> border;
  const auto take = [&](Delaunay::Face_handle face) {
    if (delaunay.is_infinite(face) || face->info() || !has_longer_edge(*face, longest)) return;
    face->info() = true;
    border.push_back(face);
  };
  auto around = delaunay.incident_faces(delaunay.infinite_vertex());
  const auto start = around;
  do take(around->neighbor(around->index(delaunay.infinite_vertex())));
  while (++around != start);
  while (!border.empty()) {
    const Delaunay::Face_handle face = border.back();
    border.pop_back();
    for (int e = 0; e < 3; ++e) take(face->neighbor(e));
  }
}

}  // namespace

Tin triangulate(const std::vector<Vec3>& points, double longest_edge) {
  Tin tin;
  tin.points = highest_of_each_place(points);
  Delaunay delaunay;
  {
    std::vector<std::pair<Kernel::Point_3, std::uint32_t>> indexed;
    indexed.reserve(tin.points.size());
    for (std::uint32_t i = 0; i < tin.points.size(); ++i)
      indexed.emplace_back(Kernel::Point_3(tin.points[i][0], tin.points[i][1], tin.points[i][2]), i);
    delaunay.insert(indexed.begin(), indexed.end());
  }
  if (delaunay.dimension() < 2) return tin;
  for (auto face : delaunay.all_face_handles()) face->info() = false;
  if (longest_edge > 0) peel(delaunay, longest_edge);
  tin.triangles.reserve(delaunay.number_of_faces());
  for (auto face : delaunay.finite_face_handles())
    if (!face->info())
      tin.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return tin;
}

bool is_simple_polygon(const std::vector<Vec2>& corners) {
  std::vector<Kernel::Point_2> points;
  points.reserve(corners.size());
  for (const Vec2& c : corners) points.emplace_back(c[0], c[1]);
  return CGAL::is_simple_2(points.begin(), points.end(), Kernel());
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/mesh_orientation_cgal.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <vector>

namespace scarp {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

TriangleMesh plain(const Mesh& mesh, const SiteFrame& site) {
  TriangleMesh result;
  result.site = site;
  result.vertices.reserve(mesh.number_of_vertices());
  for (auto v : mesh.vertices()) result.vertices.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
  result.triangles.reserve(mesh.number_of_faces());
  for (auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> corners{};
    int n = 0;
    for (auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) corners[n++] = v;
    result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace

OrientedMesh orient_to_bound(const TriangleMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.emplace_back(v[0], v[1], v[2]);
  std::vector<std::array<std::size_t, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) triangles.push_back({t[0], t[1], t[2]});

  OrientedMesh result;
  if (!pmp::is_polygon_soup_a_polygon_mesh(triangles)) pmp::orient_polygon_soup(points, triangles);
  if (!pmp::is_polygon_soup_a_polygon_mesh(triangles)) return result;
  Mesh surface;
  pmp::polygon_soup_to_polygon_mesh(points, triangles, surface);
  if (surface.number_of_faces() != mesh.triangles.size() || !CGAL::is_closed(surface)) return result;
  result.possible = true;
  result.self_intersecting = pmp::does_self_intersect(surface);
  if (!result.self_intersecting) pmp::orient_to_bound_a_volume(surface);
  result.mesh = plain(surface, mesh.site);
  return result;
}

}  // namespace scarp

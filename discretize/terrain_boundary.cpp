// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/terrain_boundary.hpp"

#include <algorithm>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

using Edge = std::array<std::uint32_t, 2>;

/// Directed edges of a TIN that no other triangle shares: the ground is on their left.
std::vector<Edge> border_of(const Tin& tin) {
  std::vector<Edge> edges;
  for (const auto& t : tin.triangles)
    for (std::size_t e = 0; e < 3; ++e) edges.push_back({t[e], t[(e + 1) % 3]});
  std::vector<Edge> sorted = edges;
  std::sort(sorted.begin(), sorted.end());
  std::erase_if(edges, [&](const Edge& e) {
    return std::binary_search(sorted.begin(), sorted.end(), Edge{e[1], e[0]});
  });
  return edges;
}

}  // namespace

TriangleMesh terrain_boundary(const TerrainSolid& solid, const std::string& body) {
  if (solid.outline)
    throw Error("discretize", "outline of rigid body '" + body + "', a terrain", "given",
                "none: crop its scan instead");
  if (solid.close == Closing::surface)
    throw Error("discretize", "close of rigid body '" + body + "', a terrain", "surface", "plane, depth");
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(solid.tin.points.size());
  mesh.vertices = solid.tin.points;
  mesh.triangles = solid.tin.triangles;
  for (const Vec3& p : solid.tin.points) mesh.vertices.push_back({p[0], p[1], solid.base_below(p[2])});
  for (const auto& t : solid.tin.triangles) {
    for (const std::uint32_t v : t)
      if (!(mesh.vertices[v + count][2] < mesh.vertices[v][2]))
        throw Error("discretize", "surface of rigid body '" + body + "', a terrain",
                    shortest(mesh.vertices[v][2]) + " m", "above its base, " + shortest(mesh.vertices[v + count][2]));
    mesh.triangles.push_back({t[0] + count, t[2] + count, t[1] + count});
  }
  for (const auto& [a, b] : border_of(solid.tin)) {
    mesh.triangles.push_back({a + count, b + count, b});
    mesh.triangles.push_back({a + count, b, a});
  }
  return mesh;
}

}  // namespace scarp

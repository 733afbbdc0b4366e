// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/closed_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discretize/mesh_orientation_cgal.hpp"
#include "discretize/raster_triangles.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// Most crossings of a surface with the columns of a lattice that are kept in memory.
constexpr std::size_t kMostCrossings = 1'000'000'000;

void check_indices(const TriangleMesh& mesh, const std::string& who) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!is_finite(mesh.vertices[v]))
      throw Error("discretize", who + ", vertex " + std::to_string(v), "a coordinate that is not finite",
                  "finite coordinates");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t v : mesh.triangles[t])
      if (v >= mesh.vertices.size())
        throw Error("discretize", who + ", triangle " + std::to_string(t), "vertex " + std::to_string(v),
                    "below " + std::to_string(mesh.vertices.size()));
}

/// Vertices of equal position become one (files repeat them at seams); triangles that lose a corner by it go.
TriangleMesh weld(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return mesh.vertices[a] < mesh.vertices[b] || (mesh.vertices[a] == mesh.vertices[b] && a < b);
  });
  TriangleMesh welded;
  welded.site = mesh.site;
  std::vector<std::uint32_t> place(mesh.vertices.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    const Vec3& p = mesh.vertices[order[n]];
    if (n == 0 || welded.vertices.back() != p) welded.vertices.push_back(p);
    place[order[n]] = static_cast<std::uint32_t>(welded.vertices.size() - 1);
  }
  for (const auto& t : mesh.triangles) {
    const std::array<std::uint32_t, 3> c{place[t[0]], place[t[1]], place[t[2]]};
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) welded.triangles.push_back(c);
  }
  return welded;
}

/// Edges that an odd number of triangles share: the border of an open mesh.
std::size_t count_border_edges(const TriangleMesh& mesh) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (int e = 0; e < 3; ++e) {
      const std::uint64_t a = t[e], b = t[(e + 1) % 3];
      edges.push_back(std::min(a, b) << 32 | std::max(a, b));
    }
  std::sort(edges.begin(), edges.end());
  std::size_t border = 0;
  for (std::size_t i = 0; i < edges.size();) {
    const std::size_t end = std::upper_bound(edges.begin() + i, edges.end(), edges[i]) - edges.begin();
    border += (end - i) % 2;
    i = end;
  }
  return border;
}

/// Signed volume by the divergence theorem, about the centre of the bounds.
double signed_volume(const TriangleMesh& mesh, const Vec3& centre) {
  double sum = 0;
  for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += kReductionBlock) {
    double part = 0;
    for (std::size_t t = begin; t < std::min(mesh.triangles.size(), begin + kReductionBlock); ++t) {
      const auto& v = mesh.triangles[t];
      part += dot(mesh.vertices[v[0]] - centre, cross(mesh.vertices[v[1]] - centre, mesh.vertices[v[2]] - centre)) / 6;
    }
    sum += part;
  }
  return sum;
}

/// Heights at which the surface crosses the columns: those of column c stand in [first[c], first[c + 1]).
struct Crossings {
  std::vector<std::size_t> first;
  std::vector<double> z;
};

template <class F>
void for_each_crossing(const TriangleMesh& mesh, const SubLattice& grid, int threads, F&& f) {
  const int bands = std::max(1, std::min(threads, grid.y.count));
  parallel_for(bands, threads, [&](std::size_t b) {
    const auto row = [&](std::size_t n) { return static_cast<std::int32_t>(n * grid.y.count / bands); };
    for (const auto& t : mesh.triangles)
      raster_triangle({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, grid.x, grid.y, row(b),
                      row(b + 1), [&](std::int32_t i, std::int32_t j, double z) { f(grid.column(i, j), z); });
  });
}

Crossings cross_columns(const MeshSolid& solid, const SubLattice& grid, int threads) {
  Crossings crossings;
  crossings.first.assign(grid.columns() + 1, 0);
  for_each_crossing(solid.mesh, grid, threads, [&](std::size_t c, double) { ++crossings.first[c + 1]; });
  for (std::size_t c = 0; c < grid.columns(); ++c) crossings.first[c + 1] += crossings.first[c];
  if (crossings.first.back() > kMostCrossings)
    throw Error("discretize", "a mesh crosses the columns of its lattice too often",
                std::to_string(crossings.first.back()) + " crossings in " + std::to_string(grid.columns()) + " columns",
                "at most " + std::to_string(kMostCrossings) + ": use larger cells or a simpler mesh");
  crossings.z.resize(crossings.first.back());
  std::vector<std::size_t> next(crossings.first.begin(), crossings.first.end() - 1);
  for_each_crossing(solid.mesh, grid, threads, [&](std::size_t c, double z) { crossings.z[next[c]++] = z; });
  return crossings;
}

}  // namespace

MeshSolid close_mesh(const TriangleMesh& input, const std::string& body, const std::string& file) {
  const std::string who = "body '" + body + "': mesh '" + file + "'";
  check_indices(input, who);
  const TriangleMesh welded = weld(input);
  const std::size_t border = count_border_edges(welded);
  if (border > 0)
    throw Error("discretize", who + " is open", std::to_string(border) + " border edges", "a closed mesh");
  if (welded.triangles.empty()) throw Error("discretize", who, "no triangle with an area", "a closed mesh");
  OrientedMesh oriented = orient_to_bound(welded);
  if (!oriented.possible)
    throw Error("discretize", who + " cannot be oriented", std::to_string(welded.triangles.size()) + " triangles",
                "a mesh whose triangles bound a solid");
  MeshSolid solid{std::move(oriented.mesh), oriented.self_intersecting, 0, {}};
  for (const auto& t : solid.mesh.triangles)
    for (std::uint32_t v : t) solid.bounds.extend(solid.mesh.vertices[v]);
  solid.volume = std::abs(signed_volume(solid.mesh, 0.5 * (solid.bounds.min + solid.bounds.max)));
  if (!(solid.volume > 0)) throw Error("discretize", who + " encloses no volume", shortest(solid.volume), "above 0 m3");
  return solid;
}

Columns fill(const MeshSolid& solid, const SubLattice& grid, int threads) {
  Crossings crossings = cross_columns(solid, grid, threads);
  return collect_columns(grid, threads, [&](std::int32_t i, std::int32_t j, auto&& push) {
    const std::size_t c = grid.column(i, j);
    const auto begin = crossings.z.begin() + static_cast<std::ptrdiff_t>(crossings.first[c]);
    const auto end = crossings.z.begin() + static_cast<std::ptrdiff_t>(crossings.first[c + 1]);
    std::sort(begin, end);
    for (auto z = begin; z != end; z += 2) push(Span{grid.up.first_at_or_above(z[0]), grid.up.first_at_or_above(z[1])});
  });
}

}  // namespace scarp

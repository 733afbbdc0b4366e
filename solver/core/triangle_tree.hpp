// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/mesh.hpp"

namespace scarp {

/// Where on a triangle a closest point lies.
enum class Feature : std::uint8_t { face, edge_01, edge_12, edge_20, vertex_0, vertex_1, vertex_2 };

struct ClosestPoint {
  Vec3 point{0, 0, 0};
  double squared_distance = 0;
  std::uint32_t triangle = 0;
  Feature feature = Feature::face;
};

/// The closest point of a triangle with three corners, by the regions of its plane (Ericson 2005, 5.1.5).
ClosestPoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Nearest points on a triangle mesh and the side of it that a point is on.
///
/// The side is the sign of (p - c) . N with the closest point c and the angle-weighted pseudo-normal N there: of a face
/// its normal, of an edge the sum of its faces' unit normals, of a vertex their sum weighted by the faces' angles. For
/// a closed mesh that is right everywhere, also where the face that comes first would not be (Baerentzen & Aanaes
/// 2005). Triangles without area are left out.
class TriangleTree {
 public:
  /// @throws Error ("mesh") for a mesh without any triangle of some area, a vertex that is not finite, an index
  ///   without its vertex, or 2^31 triangles.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// The nearest point at a distance <= max_distance; of triangles that are equally near the first of the mesh.
  std::optional<ClosestPoint> closest(const Vec3& p, double max_distance) const;

  /// The same of those triangles alone whose normals have a cosine above `least` with the unit vector `facing`.
  std::optional<ClosestPoint> closest_facing(const Vec3& p, double max_distance, const Vec3& facing,
                                             double least) const;
  /// The first triangle that the way from `from` to `to` passes from its front to its back, if any.
  std::optional<std::uint32_t> first_entered(const Vec3& from, const Vec3& to) const;

  /// Unit normal of a triangle by its index in the mesh, which has an area.
  const Vec3& face_normal(std::uint32_t triangle) const { return triangles_[place_of_[triangle]].normal; }
  /// Of the face on the other side of the edge that a closest point lies on; elsewhere that of its own face. Nothing
  /// on the border of an open mesh.
  std::optional<Vec3> normal_across(const ClosestPoint& closest) const;

  /// The angle-weighted pseudo-normal there: its direction, not of unit length.
  const Vec3& normal(const ClosestPoint& closest) const;

  /// Positive on the side to which the normals point, negative on the other, 0 on the surface.
  double side(const Vec3& p, const ClosestPoint& closest) const;

  /// Whether it is on the border of an open mesh: what lies beyond has no counterpart.
  bool on_border(const ClosestPoint& closest) const;

  std::size_t triangles_left_out() const { return left_out_; }
  std::size_t border_edges() const { return border_edges_; }
  /// Edges of more than two triangles, or of two that disagree about the side.
  std::size_t bad_edges() const { return bad_edges_; }

 private:
  struct Node {
    Vec3 low, high;
    std::uint32_t begin, end, next;  ///< the subtree ends at `next`; that of a leaf right behind it
  };
  struct Triangle {
    std::array<Vec3, 3> corners;
    std::array<std::uint32_t, 3> vertices;
    std::uint32_t index;  ///< in the mesh
    Vec3 normal;          ///< unit
    std::array<Vec3, 3> edge_normals;
    std::array<bool, 3> border;
  };

  void read_triangles(const TriangleMesh& mesh);
  void join_edges();
  void weigh_vertices(std::size_t vertices);
  void build(std::size_t begin, std::size_t end);
  template <class Accept>
  std::optional<ClosestPoint> closest_of(const Vec3& p, double max_distance, Accept&& accept) const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> place_of_;  ///< in triangles_, by index in the mesh
  std::vector<Vec3> vertex_normals_;
  std::vector<bool> border_vertex_;
  std::vector<Node> nodes_;
  std::size_t left_out_ = 0, border_edges_ = 0, bad_edges_ = 0;
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solver/core/triangle_tree.hpp"
#include "solver/model/mesh.hpp"

namespace scarp {

/// Distances to the closed surface of a body, by a hierarchy of its triangles; of a ball by its radius. In plane strain
/// the surface is a prism (prism_mesh).
///
/// A sheet is what a point sees of the surface that faces one way: the triangles whose normals make less than about 80
/// degrees with it. Who has gone in through one side of a thin plate is, seen from that sheet, ever deeper below it,
/// whatever is on the other side.
class SignedDistance {
 public:
  struct Foot {
    double distance = 0;   ///< m; negative inside
    Vec3 normal{0, 0, 0};  ///< unit: the way on which the distance grows fastest, outward
    Vec3 face{0, 0, 0};    ///< unit normal of the triangle
  };

  /// @param radius  of a ball (plane strain: a disk) about the centre of the mesh's bounds; else 0
  /// @param flat    plane strain: normals have no part along z, not even by rounding
  /// @throws Error ("mesh") where the surface has no triangle with an area.
  explicit SignedDistance(const TriangleMesh& surface, double radius = 0, bool flat = false);

  /// Of a point; nothing where it is farther than max_distance from the surface.
  std::optional<Foot> at(const Vec3& x, double max_distance) const;
  /// The same of the sheet that faces a way. Nothing for who is behind it but beside its rim, where it ends.
  std::optional<Foot> at_sheet(const Vec3& x, const Vec3& facing) const;
  /// Normal of the face by which the way from `from` to `to` goes into the body first, if it does.
  std::optional<Vec3> entered(const Vec3& from, const Vec3& to) const;

  bool is_ball() const { return radius_ > 0; }
  double radius() const { return radius_; }
  const Box3& bounds() const { return bounds_; }
  Vec3 centre() const { return 0.5 * (bounds_.min + bounds_.max); }

 private:
  Foot foot_of(const Vec3& x, const ClosestPoint& closest) const;
  Vec3 in_space(Vec3 a) const {
    if (flat_) a[2] = 0;
    return a;
  }

  TriangleTree tree_;
  double radius_;
  bool flat_;
  Box3 bounds_;
  double rounding_ = 0;  ///< m
};

}  // namespace scarp

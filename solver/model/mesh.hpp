// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/site.hpp"

namespace scarp {

/// Triangles with shared vertices; counter-clockwise seen from outside. Vertices in metres minus site.origin.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  SiteFrame site;
};

/// The prism of a plane outline between z = -half_height and half_height, without its ends: in two dimensions the
/// border of a body. Closest points to what lies at z = 0 lie there too.
/// @param corners  counter-clockwise
TriangleMesh prism_mesh(const std::vector<Vec2>& corners, double half_height);

/// Corners of a regular polygon in a circle, its edges at most `sagitta` from it.
std::vector<Vec2> circle_outline(const Vec2& centre, double radius, double sagitta);

/// A sphere by triangles whose edges are at most about `sagitta` from it.
TriangleMesh sphere_mesh(const Vec3& centre, double radius, double sagitta);

TriangleMesh box_mesh(const Box3& box);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// A triangulated irregular network: a surface z(x, y). Triangles are counter-clockwise in plan.
struct Tin {
  std::vector<Vec3> points;  ///< no two of the same (x, y)
  std::vector<std::array<std::uint32_t, 3>> triangles;

  std::array<Vec3, 3> corners(std::size_t t) const {
    const auto& v = triangles[t];
    return {points[v[0]], points[v[1]], points[v[2]]};
  }
};

/// Delaunay triangulation in plan (exact predicates). Of points with the same (x, y) the highest stays. Triangles at
/// the border with a plan edge longer than `longest_edge` are peeled off from outside until none is left; 0 peels
/// none. The result depends on the set of points, not on their order. Points must be finite; fewer than three that
/// are not on one line give no triangle.
Tin triangulate(const std::vector<Vec3>& points, double longest_edge);

/// True if the closed polygon neither crosses nor touches itself.
bool is_simple_polygon(const std::vector<Vec2>& corners);

}  // namespace scarp

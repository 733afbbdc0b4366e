// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/model/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scarp {
namespace {

using std::numbers::pi;

/// Parts of a circle whose chords are at most `sagitta` from their arcs.
std::uint32_t parts_of_circle(double radius, double sagitta) {
  constexpr double most = 1e5;
  const double half = std::acos(std::max(-1.0, 1 - sagitta / radius));
  return static_cast<std::uint32_t>(std::clamp(std::ceil(pi / half), 12.0, most));
}

}  // namespace

TriangleMesh prism_mesh(const std::vector<Vec2>& corners, double half_height) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(corners.size());
  for (const Vec2& c : corners) {
    mesh.vertices.push_back({c[0], c[1], -half_height});
    mesh.vertices.push_back({c[0], c[1], half_height});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % count);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  return mesh;
}

std::vector<Vec2> circle_outline(const Vec2& centre, double radius, double sagitta) {
  const std::uint32_t count = parts_of_circle(radius, sagitta);
  std::vector<Vec2> corners;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    corners.push_back({centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
  }
  return corners;
}

/// By latitude and longitude: rings of `around` vertices between the poles.
TriangleMesh sphere_mesh(const Vec3& centre, double radius, double sagitta) {
  constexpr std::uint32_t most = 4000;
  const std::uint32_t bands = std::min(most, (parts_of_circle(radius, sagitta) + 1) / 2), around = 2 * bands;
  TriangleMesh mesh;
  mesh.vertices.push_back(centre - Vec3{0, 0, radius});
  for (std::uint32_t j = 1; j < bands; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double latitude = pi * j / bands - pi / 2, longitude = 2 * pi * i / around;
      mesh.vertices.push_back(centre + radius * Vec3{std::cos(latitude) * std::cos(longitude),
                                                     std::cos(latitude) * std::sin(longitude), std::sin(latitude)});
    }
  mesh.vertices.push_back(centre + Vec3{0, 0, radius});
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto at = [&](std::uint32_t j, std::uint32_t i) { return 1 + (j - 1) * around + i % around; };
  for (std::uint32_t i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, at(1, i + 1), at(1, i)});
    for (std::uint32_t j = 1; j + 1 < bands; ++j) {
      mesh.triangles.push_back({at(j, i), at(j, i + 1), at(j + 1, i + 1)});
      mesh.triangles.push_back({at(j, i), at(j + 1, i + 1), at(j + 1, i)});
    }
    mesh.triangles.push_back({at(bands - 1, i), at(bands - 1, i + 1), top});
  }
  return mesh;
}

TriangleMesh box_mesh(const Box3& box) {
  TriangleMesh mesh;
  for (std::uint32_t k = 0; k < 8; ++k)
    mesh.vertices.push_back(
        {k & 1 ? box.max[0] : box.min[0], k & 2 ? box.max[1] : box.min[1], k & 4 ? box.max[2] : box.min[2]});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "solver/model/mesh.hpp"

namespace scarp::test {

/// The unit cube, normals out.
inline TriangleMesh cube() {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) mesh.vertices.push_back({1.0 * (k & 1), 1.0 * ((k >> 1) & 1), 1.0 * (k >> 2)});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// A spike: a very sharp pyramid, at whose tip single faces tell the wrong side.
inline TriangleMesh spike() {
  TriangleMesh mesh;
  mesh.vertices = {{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0}, {-0.1, 0.1, 0}, {0.3, 0, 5}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return mesh;
}

/// A rough, bumpy height field of 2 n^2 triangles.
inline TriangleMesh terrain(std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      mesh.vertices.push_back({1.0 * i, 1.0 * j, std::sin(1.3 * i) + 2 * std::cos(0.9 * j + 0.4 * i)});
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// Points anywhere in a box.
inline std::vector<Vec3> scattered(std::size_t count, const Vec3& low, const Vec3& high, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (std::size_t a = 0; a < 3; ++a) p[a] = low[a] + (high[a] - low[a]) * unit(generator);
  return points;
}

}  // namespace scarp::test

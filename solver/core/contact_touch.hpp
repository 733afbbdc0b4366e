// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the parts of Contact share.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/core/contact.hpp"

namespace scarp {

/// Surfaces press where they face each other, not where a point is beside a rim: cosine between the normals.
inline constexpr double kFacing = -0.2;

/// A point and the other body's surface.
struct Contact::Touch {
  double depth = 0;      ///< m
  Vec3 n{0, 0, 0};       ///< of the other body, outward
  double stiffness = 0;  ///< N/m
  double weight = 0;     ///< sum of the masters' weights
  Vec3 first{0, 0, 0};   ///< sum of weight times d, from the point to the master, m
  Sym6 second{};         ///< of weight times d (x) d, m2
  std::uint32_t nearest = 0;
};

inline double distance(const Box3& a, const Box3& b, int dimension) {
  double square = 0;
  for (int i = 0; i < dimension; ++i) {
    const double d = std::max({0.0, a.min[i] - b.max[i], b.min[i] - a.max[i]});
    square += d * d;
  }
  return std::sqrt(square);
}

inline bool within(const Box3& box, const Vec3& x, double margin, int dimension) {
  for (int i = 0; i < dimension; ++i)
    if (!(x[i] >= box.min[i] - margin && x[i] <= box.max[i] + margin)) return false;
  return true;
}

}  // namespace scarp

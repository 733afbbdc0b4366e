// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plain value types that cross every border between rooms. They hold no heap memory and no alignment
// requirement, so that translation units built with different instruction sets can exchange them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace scarp {

using Vec2 = std::array<double, 2>;
using Vec3 = std::array<double, 3>;
/// Symmetric tensor in the order xx, yy, zz, xy, yz, xz (tension positive for stress).
using Sym6 = std::array<double, 6>;
/// Row-major 3 x 3 matrix.
using Mat3 = std::array<double, 9>;
using Rgb16 = std::array<std::uint16_t, 3>;
using Rgb8 = std::array<std::uint8_t, 3>;

inline constexpr Mat3 kIdentity{1, 0, 0, 0, 1, 0, 0, 0, 1};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline bool is_finite(const Vec3& a) { return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]); }

/// Axis-aligned box; empty until the first `extend`.
struct Box3 {
  Vec3 min{INFINITY, INFINITY, INFINITY};
  Vec3 max{-INFINITY, -INFINITY, -INFINITY};

  void extend(const Vec3& p) {
    for (int a = 0; a < 3; ++a) {
      min[a] = p[a] < min[a] ? p[a] : min[a];
      max[a] = p[a] > max[a] ? p[a] : max[a];
    }
  }
  bool empty() const { return !(min[0] <= max[0]); }
};

}  // namespace scarp

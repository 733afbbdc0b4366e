// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/model/math.hpp"

namespace scarp {

/// A surface through a few points: a least-squares plane, and on it a quadratic height function
///   w(u, v) = c0 + c1 u + c2 v + c3 u^2 + c4 u v + c5 v^2
/// in the plane's frame, whose origin is the points' mean.
class LocalSurface {
 public:
  /// @param quadric whether to fit the height function; the plane's has only zeros
  /// @returns nothing for fewer than three points (six for a quadric), or points within 1e-6 of a line (a conic)
  static std::optional<LocalSurface> fit(const std::vector<Vec3>& points, bool quadric);

  /// Signed distance from the surface, positive on the normal's side (up): (height of p - w) / sqrt(1 + |grad w|^2),
  /// for a plane exact, for a quadric to first order in the distance times its curvature.
  double distance(const Vec3& p) const;
  const Vec3& normal() const { return normal_; }

  /// The surface above or below a point.
  struct Foot {
    Vec3 position;     ///< along the plane's normal from the point
    Vec3 normal;       ///< unit, of the surface there, up as the plane's
    double curvature;  ///< w_uu + w_vv, 1/m
  };
  Foot foot(const Vec3& p) const;

 private:
  /// p in the plane's frame, in units of the neighbourhood's size.
  Vec3 local(const Vec3& p) const;
  bool fit_heights(const std::vector<Vec3>& points);

  Vec3 origin_{0, 0, 0}, u_{1, 0, 0}, v_{0, 1, 0}, normal_{0, 0, 1};
  double size_ = 1;  ///< m
  std::array<double, 6> heights_{};
};

}  // namespace scarp

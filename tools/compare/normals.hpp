// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "ingest/neighbours/point_tree.hpp"
#include "solver/model/m3c2_options.hpp"

namespace scarp {

/// Which of several neighbourhoods gives the normal, by the eigenvalues l0 <= l1 <= l2 of its covariance.
enum class ScaleChoice {
  planarity,      ///< the largest (l1 - l0) / l2 above zero; of equal ones the first
  dimensionality  ///< the largest 2 s2 + 4 s1 - 2 with s_i = l_i^2 / (l0^2 + l1^2 + l2^2): 1 for a plane, 0 for a line
                  ///< or a ball (Brodu & Lague 2012); of equal ones the largest radius
};

struct NormalRules {
  std::vector<double> radii;  ///< m
  bool closed_ball = false;   ///< distance <= radius; else <
  ScaleChoice choice = ScaleChoice::planarity;
  NormalSide side = NormalSide::up;
  Vec3 viewpoint{0, 0, 0};  ///< in the frame of the points
};

struct Normal {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Vec3 direction{kNaN, kNaN, kNaN};  ///< unit vector; NaN where no neighbourhood has one
  double radius = kNaN;              ///< of the neighbourhood that was chosen, m
};

/// Normals of a cloud by principal components at several scales. A neighbourhood of fewer than three points, of points
/// within 1e-6 of a line, or without a preferred direction has no normal.
class NormalSearch {
 public:
  NormalSearch(const PointTree& tree, NormalRules rules);

  /// The normal at a point. `scratch` is memory for reuse by calls on the same thread.
  Normal at(const Vec3& point, std::vector<Vec3>& scratch) const;

 private:
  const PointTree& tree_;
  NormalRules rules_;
  double largest_ = 0;
};

/// The normal of a few points, of either sign; nothing where a neighbourhood would have none.
std::optional<Vec3> plane_normal(const std::vector<Vec3>& points);

/// The direction with the sign that the side asks for: non-negative towards it. On the border the sign stays.
Vec3 oriented(const Vec3& direction, const Vec3& at, NormalSide side, const Vec3& viewpoint);

}  // namespace scarp

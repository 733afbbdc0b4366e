// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How pieces of a surface moved as rigid bodies between two surveys.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "ingest/neighbours/neighbours.hpp"
#include "solver/model/math.hpp"

namespace scarp {

/// Why a motion is not known; a sum of these, 0 where it is.
enum MotionFlag : std::uint8_t {
  kFewPoints = 1,      ///< fewer points in the block than asked for
  kLittleOverlap = 2,  ///< too few of them have a counterpart
  kLargeResidual = 4,  ///< the block does not fit where it went: it did not move as a rigid body
  kUndetermined = 8,   ///< too smooth: a surface that slides in itself looks the same
  kNotConverged = 16
};

struct BlockMotion {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Vec3 at{kNaN, kNaN, kNaN};            ///< the place asked for, or the mean of the block's points before, m
  Vec3 displacement{kNaN, kNaN, kNaN};  ///< of that place, m; NaN where flags are not 0
  Vec3 sigma{kNaN, kNaN, kNaN};         ///< standard deviations of its components, m
  double worst_sigma = kNaN;            ///< in the direction that is known worst, m
  double rotation = kNaN;               ///< angle, degrees
  double residual = kNaN;               ///< root mean square of the distances from the planes after, m
  double overlap = 0;                   ///< share of the points with a counterpart
  std::size_t points = 0;
  int iterations = 0;
  std::uint8_t flags = 0;
};

struct MotionSettings {
  double reach = 0;  ///< how far a counterpart may be, m: at least the largest displacement
  std::size_t minimum_points = 30;
  double least_overlap = 0.5;
  double largest_residual = 0;  ///< m
  double largest_sigma = 0;     ///< m
};

/// The surface after, as points with the planes through their 12 nearest neighbours.
class MovedSurface {
 public:
  MovedSurface(const std::vector<Vec3>& points, int threads);

  /// The motion of a block by iterated closest points, each to the plane of its counterpart (Chen & Medioni 1992):
  /// least squares over small rotations about the mean and translations, until a step is below a tenth of its
  /// standard deviation. A counterpart counts if the point is over its plane, no farther from it along the plane than
  /// the points that it was laid through, and if it is not farther from the plane than 3 robust standard deviations.
  ///
  /// With residuals e_i and derivatives J_i of m counterparts, and B what the noise of the normals n_i alone would add
  /// to J^T J (their variance by the fit of the plane), the covariance of rotation and translation is sum(e^2) / (m -
  /// 6) (J^T J - B)^-1, and that of the vector follows from it. Where J^T J is not above 2 B in every direction, as on
  /// a plane that slides in itself, the motion is undetermined. It takes errors as independent from point to point.
  /// @param place  whose displacement is wanted; nullptr: that of the mean of the points
  BlockMotion motion_of(const std::vector<Vec3>& block, const MotionSettings& settings,
                        const Vec3* place = nullptr) const;

 private:
  friend class BlockFit;
  std::vector<Vec3> points_, normals_;
  std::vector<double> radius_;  ///< of the neighbours of the plane, m
  std::vector<double> tilt_;    ///< variance of the normal in either direction across it
  Neighbours near_;
};

/// Points by the square of plan that they are in, whole multiples of `edge`; squares from west to east, south to north.
std::vector<std::vector<std::uint32_t>> blocks_in_plan(const std::vector<Vec3>& points, double edge);

}  // namespace scarp

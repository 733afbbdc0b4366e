// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the errors of measurements to that of a mean, and to a level of detection (M3C2-EP: Winiwarter, Anders & Hoefle
// 2021).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/survey_error_options.hpp"

namespace scarp {

/// Whose formulas: those of propagation as it follows, or as py4dgeo has coded them.
enum class PropagationRule {
  /// Covariance of the mean of n points: sum C_i / n^2, plus that of the alignment at the mean.
  /// Level of detection: 1.96 (sqrt(n^T S n) + registration error), S the sum of both sides.
  mean,
  /// Of py4dgeo: sum C_i / n, plus the mean of the points' covariances by alignment, the mean weighted by C_i^-1, the
  /// variance of a range s^2 + 1e-6 s r^2; sqrt(chi2(0.95, 3) / (n^T S^-1 n)).
  py4dgeo
};

/// One side's errors, in the frame of its points.
struct SideErrors {
  ScannerOptions scanner;                 ///< without positions: a simulation, of which `floor` is all that is known
  std::vector<std::uint16_t> scanner_of;  ///< index of its position, per point; empty: the first
  double floor = 0;                       ///< m: isotropic, shared by all points of a cylinder
};

/// Covariance of the 12 numbers a11 a12 ... a33 tx ty tz, row by row.
using AlignmentCovariance = std::array<double, 144>;

/// Of a rigid motion with small independent rotations about each axis (rad) and translations (m).
AlignmentCovariance rigid_alignment(double sigma_translation, double sigma_rotation);

struct SurveyErrors {
  SideErrors simulated, observed;
  AlignmentCovariance alignment{};  ///< of the observed side
  Vec3 centre{0, 0, 0};
  PropagationRule rule = PropagationRule::mean;
};

/// Covariance of one measured point, m2: of range r, azimuth and elevation seen from `scanner`.
///   C = s_r^2 e_r e_r^T + (r cos(elevation) s_a)^2 e_a e_a^T + (r s_e)^2 e_e e_e^T,  s_r^2 = sigma^2 + (scale r)^2
Mat3 point_covariance(const ScannerOptions& options, const Vec3& scanner, const Vec3& point, PropagationRule rule);

/// Of a point moved by an uncertain alignment: B C B^T, B the derivative of A d + t, `d` from the centre.
Mat3 alignment_covariance(const AlignmentCovariance& C, const Vec3& d);

/// What a cylinder's points of one side amount to.
struct PropagatedMean {
  Vec3 mean{0, 0, 0};  ///< plain, or weighted by the rule
  Mat3 measured{};     ///< covariance by measurement, m2
  Mat3 aligned{};      ///< and by alignment
};

/// @param members indices of the points in the cylinder, not empty
PropagatedMean propagate(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& members,
                         const SurveyErrors& errors, bool observed);

/// At 95 %, m; NaN where the rule has none.
double propagated_detection(const Mat3& covariance, const Vec3& normal, double registration_error,
                            PropagationRule rule);

/// n^T C n
double variance_along(const Mat3& C, const Vec3& n);

}  // namespace scarp

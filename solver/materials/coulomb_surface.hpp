// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "solver/model/math.hpp"

namespace scarp {

/// Mohr-Coulomb's planes, f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) <= 0, cut off by Rankine's, s1 <= tension,
/// in principal stresses s1 >= s2 >= s3; with the return to them under Hooke's law (method.md 1.5; de Souza Neto,
/// Peric, Owen 2008, chapter 8.2): along the gradient of the potential with psi in place of phi, and along s1 for the
/// cut-off.
///
/// Both functions are homogeneous in (stress, cohesion, tension): every function takes the factor J by which the
/// strength is multiplied when tau = J sigma stands in place of sigma.
class CoulombSurface {
 public:
  /// @param cohesion  Pa
  /// @param friction_angle,dilatancy_angle  degrees, dilatancy_angle <= friction_angle
  /// @param tension  Pa, at most the apex c / tan(phi); infinite: no cut-off
  CoulombSurface(double shear_modulus, double bulk_modulus, double cohesion, double friction_angle,
                 double dilatancy_angle, double tension);

  /// The same planes with another strength of the material between them.
  CoulombSurface with_strength(double cohesion, double tension) const {
    CoulombSurface other = *this;
    other.cohesion_ = cohesion;
    other.tension_ = tension;
    return other;
  }

  /// f, Pa; the cut-off does not enter.
  double yield(const Vec3& s, double J) const { return plane(s[0], s[2], J * cohesion_ * cos_phi_); }

  /// s1 - J tension, Pa.
  double above_cut_off(const Vec3& s, double J) const { return s[0] - J * tension_; }

  bool exceeded(const Vec3& s, double J) const { return yield(s, J) > 0 || s[0] > J * tension_; }

  /// Brings s1 >= s2 >= s3 beyond the surface back to it.
  void return_map(Vec3& s, double J) const;

 private:
  double plane(double s1, double s3, double cohesion_cos_phi) const {
    return (s1 - s3) + (s1 + s3) * sin_phi_ - 2 * cohesion_cos_phi;
  }
  void return_to_planes(Vec3& s, double cohesion_cos_phi) const;
  Vec3 return_to_cut_off(const Vec3& s, double cohesion_cos_phi, double tension) const;

  double cohesion_, tension_;
  double sin_phi_, cos_phi_, sin_psi_;
  double stiff_, across_;  ///< lambda + 2 mu and lambda
  // Changes of (s1, s2, s3) per unit of the plastic multiplier of the main plane, and the constants of the
  // consistency conditions: a for one plane, b for the pairs that meet at the right and the left edge.
  double fall_, middle_, rise_, a_, b_right_, b_left_;
};

}  // namespace scarp

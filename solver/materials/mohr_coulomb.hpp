// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/materials/elastic_parameters.hpp"
#include "solver/materials/motion.hpp"

namespace scarp {

/// Mohr-Coulomb, perfectly plastic, non-associated, on a Hencky (logarithmic) elastic law:
/// f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) <= 0 in the Cauchy stress, s1 >= s2 >= s3.
struct MohrCoulomb : ElasticParameters {
  static constexpr std::string_view name = "mohr-coulomb";
  double cohesion = 0;
  double friction_angle = 0;
  double dilatancy_angle = 0;

  template <class V>
  void describe(V&& v) {
    describe_elastic(v);
    v("cohesion", cohesion, Spec{.text = "cohesion", .unit = "Pa", .at_least = 0, .required = true});
    v("friction_angle", friction_angle,
      Spec{.text = "angle of internal friction", .unit = "deg", .at_least = 0, .below = 90, .required = true});
    v("dilatancy_angle", dilatancy_angle,
      Spec{.text = "angle of dilatancy; at most the friction angle", .unit = "deg", .at_least = 0, .below = 90});
  }
  class Law;
};

/// Return map on b_e with the logarithmic strain (de Souza Neto, Peric, Owen 2008, chapters 8.2 and 14): the
/// elastic trial b_e = f b_e f^T is spectrally decomposed, the small-strain map of method.md 1.5 is applied to
/// the principal Kirchhoff stresses, and b_e is composed again from the principal elastic strains.
///
/// The yield function is homogeneous in (stress, cohesion), so f(sigma) = 0 with c is f(tau) = 0 with J c: the
/// map runs in tau = J sigma with J c, and the strength holds in the Cauchy stress at any volume change.
class MohrCoulomb::Law {
 public:
  static constexpr bool has_history = true;

  explicit Law(const MohrCoulomb& m);

  Sym6 stress(const Motion& motion, PointHistory& history) const;

  /// Hencky energy G |dev e|^2 + K/2 (tr e)^2 of the elastic log strain e = ln(b_e) / 2.
  double stored_energy(const Motion& motion, const PointHistory& history) const;

  /// (lambda + 2 mu) / lambda_min^2, raised by the elastic strain: the Hencky tangent departs from Hooke's by
  /// stresses, and stress / (lambda + 2 mu) is below |b_e - I|. Tested for elastic strains up to 0.2.
  double wave_speed_squared(const Motion& motion, const PointHistory& history) const;

  /// f of a Cauchy stress, Pa.
  double yield_function(const Sym6& sigma) const;

 private:
  void return_map(Vec3& tau, double cohesion) const;

  double G_, K_, per_2G_, per_3K_, per_density_;
  double cohesion_, sin_phi_, cos_phi_, sin_psi_;
  // Changes of (s1, s2, s3) per unit of the plastic multiplier of the main plane, and the constants of the
  // consistency conditions: a for one plane, b for the pairs that meet at the right and the left edge.
  double fall_, middle_, rise_, a_, b_right_, b_left_;
};

}  // namespace scarp

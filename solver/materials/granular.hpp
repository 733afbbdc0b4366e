// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/materials/elastic_parameters.hpp"
#include "solver/materials/motion.hpp"

namespace scarp {

/// Dense granular flow, mu(I) (Jop, Forterre, Pouliquen 2006), on a Hencky elastic law, after Dunatunga and Kamrin
/// (2015): plastic flow keeps the volume, with sqrt(J2) = mu(I) p,
///   mu(I) = mu_s + (mu_2 - mu_s) / (I_0 / I + 1),   I = rate d sqrt(grain_density / p),
/// rate the plastic shear rate and p the pressure, and sqrt(J2) <= mu_s p without flow. `density` is the critical one,
/// at which the grains just touch: denser, p follows the change of volume elastically; looser (J > 1) they are apart
/// and without stress, until they meet again.
struct Granular : ElasticParameters {
  static constexpr std::string_view name = "granular";
  double mu_s = 0;
  double mu_2 = 0;
  double I_0 = 0.279;
  double grain_diameter = 0;
  double grain_density = 0;

  template <class V>
  void describe(V&& v) {
    describe_elastic(v);
    v("mu_s", mu_s, Spec{.text = "coefficient of friction of the slowest flow", .above = 0, .required = true});
    v("mu_2", mu_2,
      Spec{.text = "coefficient of friction that fast flow approaches; at least mu_s", .above = 0, .required = true});
    v("I_0", I_0, Spec{.text = "inertial number at which friction is half way from mu_s to mu_2", .above = 0});
    v("grain_diameter", grain_diameter, Spec{.text = "diameter of a grain", .unit = "m", .above = 0, .required = true});
    v("grain_density", grain_density,
      Spec{.text = "density of the grains themselves; `density` is that of grains and voids as they just touch",
           .unit = "kg/m3",
           .above = 0,
           .required = true});
  }
  class Law;
};

class Granular::Law {
 public:
  static constexpr bool has_history = true;

  explicit Law(const Granular& m);

  /// Return in the deviator alone; the volumetric elastic strain is ln J where the grains touch. Implicit in the rate:
  /// a quadratic equation, stable for any step.
  Sym6 stress(const Motion& motion, PointHistory& history) const;

  /// Hencky energy of b_e.
  double stored_energy(const Motion& motion, const PointHistory& history) const;

  /// See hencky_stiffness_bound.
  double wave_speed_squared(const Motion& motion, const PointHistory& history) const;

  /// Of a Cauchy stress: the larger of sqrt(J2) - mu_s p and the tension - p, Pa.
  double yield_function(const Sym6& sigma, const PointHistory& history = {}) const;

 private:
  double flowing(double trial, double P, const Motion& motion) const;

  double G_, K_, per_density_, mu_s_, mu_2_;
  double rate_;  ///< G I_0 / (d sqrt(grain_density)), so that rate_ sqrt(p) is in Pa/s
};

}  // namespace scarp

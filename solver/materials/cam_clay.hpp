// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "solver/materials/motion.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// Modified Cam-clay (Roscoe and Burland 1968) in logarithmic strain (Borja and Tamagnini 1998), associated:
///   f = q^2 / M^2 + p (p - p_c) <= 0   in the effective Cauchy stress, p the pressure, M the same at all Lode angles
///   J p = initial_pressure exp(-tr e / kappa*),   s = 2 G dev e   in the elastic logarithmic strain e, J sigma = tau
///   p_c = p_c0 exp(compressive plastic volumetric strain / (lambda* - kappa*))
/// with kappa* = kappa / (1 + void_ratio) and lambda* alike. The bulk modulus grows with pressure, the shear modulus is
/// constant: one that grows with pressure at a constant Poisson's ratio would create energy in closed cycles.
///
/// The clay has no stiffness without pressure: it starts with the pressure initial_pressure in the undeformed state,
/// equal in all directions, and `relax` brings it to its weight. Pressure falls towards zero in expansion and never
/// passes it: there is no tension.
struct CamClay {
  static constexpr std::string_view name = "cam-clay";
  double density = 0;
  double shear_modulus = 0;
  double kappa = 0;
  double lambda = 0;
  double void_ratio = 0;
  double initial_pressure = 0;
  std::optional<double> critical_stress_ratio = std::nullopt;
  std::optional<double> friction_angle = std::nullopt;
  std::optional<double> preconsolidation = std::nullopt;
  std::optional<double> overconsolidation_ratio = std::nullopt;

  double swelling() const { return kappa / (1 + void_ratio); }              ///< kappa*
  double hardening() const { return (lambda - kappa) / (1 + void_ratio); }  ///< lambda* - kappa*
  double first_yield_pressure() const {                                     ///< p_c0, Pa
    return preconsolidation.value_or(overconsolidation_ratio.value_or(1) * initial_pressure);
  }
  /// M; from the angle of friction, that in triaxial compression, 6 sin(phi) / (3 - sin(phi)).
  double M() const;
  Sym6 rest_stress() const { return {-initial_pressure, -initial_pressure, -initial_pressure, 0, 0, 0}; }
  /// Under the initial pressure: sqrt((K + 4/3 G + p) / density), K = p / kappa*.
  double wave_speed() const {
    return std::sqrt((initial_pressure / swelling() + initial_pressure + 4 * shear_modulus / 3) / density);
  }
  double shear_wave_speed() const { return std::sqrt(shear_modulus / density); }

  template <class V>
  void describe(V&& v) {
    v("density", density,
      Spec{.text = "mass density in the reference configuration", .unit = "kg/m3", .above = 0, .required = true});
    v("shear_modulus", shear_modulus, Spec{.text = "constant", .unit = "Pa", .above = 0, .required = true});
    v("kappa", kappa,
      Spec{.text = "slope of the swelling line, void ratio per natural logarithm of pressure",
           .above = 0,
           .required = true});
    v("lambda", lambda,
      Spec{.text = "slope of the line of virgin compression; above kappa", .above = 0, .required = true});
    v("void_ratio", void_ratio, Spec{.text = "at the start", .above = 0, .required = true});
    v("initial_pressure", initial_pressure,
      Spec{.text = "effective pressure of the undeformed state, equal in all directions",
           .unit = "Pa",
           .above = 0,
           .required = true});
    v("critical_stress_ratio", critical_stress_ratio,
      Spec{.text = "M, q / p in the critical state; or friction_angle", .above = 0});
    v("friction_angle", friction_angle,
      Spec{.text = "critical angle of friction in triaxial compression, from which M follows",
           .unit = "deg",
           .above = 0,
           .below = 90});
    v("preconsolidation", preconsolidation,
      Spec{.text = "preconsolidation pressure at first, the same everywhere; at least initial_pressure",
           .unit = "Pa",
           .above = 0});
    v("overconsolidation_ratio", overconsolidation_ratio,
      Spec{.text = "preconsolidation pressure over initial_pressure; default 1", .at_least = 1});
  }
  class Law;
};

class CamClay::Law {
 public:
  static constexpr bool has_history = true;
  static constexpr bool has_hardening = true;  ///< ln(p_c / p_c0)

  explicit Law(const CamClay& m);

  Sym6 stress(const Motion& motion, PointHistory& history) const;

  /// kappa* initial_pressure (exp(-tr e / kappa*) - 1) + G |dev e|^2; below zero where the initial pressure has done
  /// work.
  double stored_energy(const Motion& motion, const PointHistory& history) const;

  double wave_speed_squared(const Motion& motion, const PointHistory& history) const;

  /// f / p_c of a Cauchy stress, Pa.
  double yield_function(const Sym6& sigma, const PointHistory& history = {}) const;

 private:
  double G_, per_density_, pressure_, yield_pressure_, per_M_squared_;
  double per_swelling_, per_hardening_;  ///< 1 / kappa*, 1 / (lambda* - kappa*)
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string_view>

#include "solver/materials/motion.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// Weakly compressible Newtonian fluid: sigma = - p I + 2 viscosity dev D with the pressure of Tait's equation (Cole
/// 1948), p = density sound_speed^2 / exponent (J^-exponent - 1). Unless `tension` is allowed, p >= 0: water that is
/// pulled apart (J > 1) cavitates, and no free surface, jet or wall is pulled by it. The cut-off is of the pressure
/// alone; viscous stresses act at any volume.
struct Water {
  static constexpr std::string_view name = "water";
  double density = 0;
  double sound_speed = 0;
  double viscosity = 0;
  double exponent = 7;
  bool tension = false;

  double wave_speed() const { return sound_speed; }
  double shear_wave_speed() const { return 0; }

  template <class V>
  void describe(V&& v) {
    v("density", density, Spec{.text = "mass density without pressure", .unit = "kg/m3", .above = 0, .required = true});
    v("sound_speed", sound_speed,
      Spec{.text =
               "speed of sound without pressure; ten times the fastest flow keeps changes of density below 1 %, and "
               "the real one, 1480 m/s, makes the time step needlessly short",
           .unit = "m/s",
           .above = 0,
           .required = true});
    v("viscosity", viscosity, Spec{.text = "dynamic viscosity, 0.001 Pa s for water", .unit = "Pa s", .at_least = 0});
    v("exponent", exponent, Spec{.text = "exponent of Tait's equation", .above = 1, .at_most = 20});
    v("tension", tension,
      Spec{.text = "whether the pressure may fall below zero; otherwise the fluid parts (cavitates)"});
  }
  class Law;
};

class Water::Law {
 public:
  static constexpr bool has_history = true;  ///< of what viscosity dissipates only; no shape is remembered
  static constexpr bool purely_viscous = true;

  /// @param cell  edge of the cells that the law is used in, m, for the viscous limit of the time step; 0: not known,
  ///              which leaves the limit out
  explicit Law(const Water& m, double cell = 0)
      : modulus_(m.density * m.sound_speed * m.sound_speed / m.exponent),
        exponent_(m.exponent),
        viscosity_(m.viscosity),
        longitudinal_(cell > 0 ? 4.0 / 3 * m.viscosity / m.density / cell : 0),
        sound_speed_squared_(m.sound_speed * m.sound_speed),
        tension_(m.tension) {}

  Sym6 stress(const Motion& motion, PointHistory& history) const;

  /// B [(J^(1 - exponent) - 1) / (exponent - 1) + J - 1] with B = density sound_speed^2 / exponent.
  double stored_energy(const Motion& motion, const PointHistory& history) const;

  /// sound_speed^2 J^(1 - exponent) / lambda_min^2; what cavitates counts as if at rest, since it may close again.
  double wave_speed_squared(const Motion& motion, const PointHistory&) const {
    const double shrunk = inverse_square_of_least_stretch(motion);
    return limited(sound_squared(motion.J) * shrunk, motion.J * shrunk);
  }
  /// In the current configuration: a fluid has no memory of its reference shape.
  double current_wave_speed_squared(const Motion& motion, const PointHistory&) const {
    return limited(sound_squared(motion.J), motion.J);
  }

 private:
  double sound_squared(double J) const { return sound_speed_squared_ * std::pow(J < 1 ? J : 1, 1 - exponent_); }
  double limited(double c2, double stretch) const;

  double modulus_, exponent_, viscosity_;
  double longitudinal_;  ///< 4/3 kinematic viscosity / cell, m/s
  double sound_speed_squared_;
  bool tension_;
};

}  // namespace scarp

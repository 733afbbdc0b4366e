// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "solver/materials/coulomb_surface.hpp"
#include "solver/materials/elastic_parameters.hpp"
#include "solver/materials/motion.hpp"
#include "solver/materials/overstress.hpp"

namespace scarp {

/// How strength falls with the equivalent plastic strain a: the part of the way to the residual values that is gone is
/// min(1, a / softening_strain) or 1 - exp(-a / softening_strain).
enum class Softening { linear, exponential };
template <>
struct enum_names<Softening> {
  static constexpr std::array<std::pair<std::string_view, Softening>, 2> value{
      {{"linear", Softening::linear}, {"exponential", Softening::exponential}}};
};

/// Mohr-Coulomb, non-associated, on a Hencky (logarithmic) elastic law:
/// f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) <= 0 in the Cauchy stress, s1 >= s2 >= s3. Perfectly plastic and
/// without a cut-off in tension unless their parameters are given.
struct MohrCoulomb : ElasticParameters {
  static constexpr std::string_view name = "mohr-coulomb";
  double cohesion = 0;
  double friction_angle = 0;
  double dilatancy_angle = 0;
  std::optional<double> tension_strength = std::nullopt;
  std::optional<double> residual_cohesion = std::nullopt;
  std::optional<double> residual_friction_angle = std::nullopt;
  std::optional<double> residual_dilatancy_angle = std::nullopt;
  Softening softening = Softening::linear;
  std::optional<double> softening_strain = std::nullopt;
  std::optional<double> softening_length = std::nullopt;
  double relaxation_time = 0;

  bool softens() const { return residual_cohesion || residual_friction_angle || residual_dilatancy_angle; }

  template <class V>
  void describe(V&& v) {
    describe_elastic(v);
    v("cohesion", cohesion, Spec{.text = "cohesion", .unit = "Pa", .at_least = 0, .required = true});
    v("friction_angle", friction_angle,
      Spec{.text = "angle of internal friction", .unit = "deg", .at_least = 0, .below = 90, .required = true});
    v("dilatancy_angle", dilatancy_angle,
      Spec{.text = "angle of dilatancy; at most the friction angle", .unit = "deg", .at_least = 0, .below = 90});
    v("tension_strength", tension_strength,
      Spec{.text = "largest principal stress; default: no cut-off before the apex, cohesion / tan(friction_angle)",
           .unit = "Pa",
           .at_least = 0});
    v("residual_cohesion", residual_cohesion,
      Spec{.text = "cohesion after softening; otherwise it stays", .unit = "Pa", .at_least = 0});
    v("residual_friction_angle", residual_friction_angle,
      Spec{.text = "angle of friction after softening; otherwise it stays", .unit = "deg", .at_least = 0, .below = 90});
    v("residual_dilatancy_angle", residual_dilatancy_angle,
      Spec{
          .text = "angle of dilatancy after softening; otherwise it stays", .unit = "deg", .at_least = 0, .below = 90});
    v("softening", softening,
      Spec{.text = "how the residual values are reached with equivalent plastic strain: in a straight line at "
                   "softening_strain, or exponentially, 63 % of the way at softening_strain"});
    v("softening_strain", softening_strain,
      Spec{.text = "equivalent plastic strain over which strength falls; needed with a residual value", .above = 0});
    v("softening_length", softening_length,
      Spec{.text = "width of the shear band in which softening_strain was found: the strain is scaled by this over the "
                   "cell, so that the energy to break through does not depend on the grid; default: no scaling",
           .unit = "m",
           .above = 0});
    describe_relaxation(v, relaxation_time);
  }
  class Law;
};

/// Return map on b_e with the logarithmic strain (de Souza Neto, Peric, Owen 2008, chapters 8.2 and 14): the
/// elastic trial b_e = f b_e f^T is spectrally decomposed, the small-strain map of CoulombSurface is applied to the
/// principal Kirchhoff stresses with J times the strength, which so holds in the Cauchy stress at any change of volume,
/// and b_e is composed again from the principal elastic strains.
///
/// With softening the strength is that after the step's own plastic strain, a scalar equation per plastic step. The
/// cut-off never exceeds the apex of the strength that is left. Softening that elastic unloading cannot follow (without
/// friction: cohesion falls by more than G per unit of plastic shear, sqrt(3) times the equivalent plastic strain)
/// falls within one step; what that sets free is not in plastic_work, and softening_length no longer keeps the energy
/// to break through: the cells are then too large for it. With a relaxation_time the stress stops short of the surface,
/// see overstress.hpp, and softening takes time.
class MohrCoulomb::Law {
 public:
  static constexpr bool has_history = true;

  /// @param cell  edge of the cells that the law is used in, m, for softening_length; 0: not known, no scaling
  explicit Law(const MohrCoulomb& m, double cell = 0);

  Sym6 stress(const Motion& motion, PointHistory& history) const;

  /// Hencky energy G |dev e|^2 + K/2 (tr e)^2 of the elastic log strain e = ln(b_e) / 2.
  double stored_energy(const Motion& motion, const PointHistory& history) const;

  /// See hencky_stiffness_bound.
  double wave_speed_squared(const Motion& motion, const PointHistory& history) const;

  /// The larger of f and s1 - tension_strength of a Cauchy stress after a plastic strain, Pa.
  double yield_function(const Sym6& sigma, const PointHistory& history = {}) const;

 private:
  CoulombSurface surface_after(double equivalent_plastic_strain) const;
  bool return_softening(Vec3& tau, double J, double equivalent_plastic_strain) const;
  double plastic_strain(const Vec3& trial, const Vec3& tau) const;

  double G_, K_, per_2G_, per_3K_, per_density_;
  CoulombSurface surface_;  ///< before softening
  bool softens_;
  MohrCoulomb parameters_;
  double per_softening_strain_ = 0;
};

}  // namespace scarp

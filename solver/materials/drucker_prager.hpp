// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "solver/materials/elastic_parameters.hpp"
#include "solver/materials/motion.hpp"
#include "solver/materials/overstress.hpp"

namespace scarp {

/// The state of stress in which the cone has Mohr-Coulomb's strength.
enum class ConeMatch { plane_strain, plane_strain_associated, inner, outer };
template <>
struct enum_names<ConeMatch> {
  static constexpr std::array<std::pair<std::string_view, ConeMatch>, 4> value{
      {{"plane-strain", ConeMatch::plane_strain},
       {"plane-strain-associated", ConeMatch::plane_strain_associated},
       {"inner", ConeMatch::inner},
       {"outer", ConeMatch::outer}}};
};

/// Drucker-Prager (1952), perfectly plastic, non-associated, with a cap on the mean stress, on a Hencky (logarithmic)
/// elastic law: f = sqrt(J2) + q p - k <= 0 and p <= tension_strength in the Cauchy stress, p the mean, tension
/// positive.
struct DruckerPrager : ElasticParameters {
  static constexpr std::string_view name = "drucker-prager";
  double cohesion = 0;
  double friction_angle = 0;
  double dilatancy_angle = 0;
  std::optional<double> tension_strength = std::nullopt;
  ConeMatch match = ConeMatch::plane_strain;
  double relaxation_time = 0;

  template <class V>
  void describe(V&& v) {
    describe_elastic(v);
    v("cohesion", cohesion, Spec{.text = "Mohr-Coulomb cohesion", .unit = "Pa", .at_least = 0, .required = true});
    v("friction_angle", friction_angle,
      Spec{.text = "Mohr-Coulomb angle of friction", .unit = "deg", .at_least = 0, .below = 90, .required = true});
    v("dilatancy_angle", dilatancy_angle,
      Spec{.text = "angle of dilatancy; at most the friction angle", .unit = "deg", .at_least = 0, .below = 90});
    v("tension_strength", tension_strength,
      Spec{.text = "largest mean stress; default: the cone's apex, cohesion / tan(friction_angle)",
           .unit = "Pa",
           .at_least = 0});
    v("match", match,
      Spec{.text =
               "where the cone has Mohr-Coulomb's strength: sliding in plane strain, the same with associated flow, "
               "triaxial extension (inner), triaxial compression (outer: unsafe in all other states)"});
    describe_relaxation(v, relaxation_time);
  }
  class Law;
};

/// q and k of the cone, and q_flow of the plastic potential sqrt(J2) + q_flow p.
struct Cone {
  double q = 0;
  double k = 0;  ///< Pa
  double q_flow = 0;
};

/// Plane strain: steady flow without strain across the plane gives s_zz = -(2/3) q_flow sqrt(J2), so that the largest
/// in-plane shear is sqrt(J2) B with B = sqrt(1 - q_flow^2 / 3) and p is the in-plane mean less q_flow sqrt(J2) / 3.
/// For the dilatancy angle psi of the plane, sin(psi) = q_flow / B: q_flow = 3 sin(psi) / sqrt(9 + 3 sin(psi)^2), and
/// for Mohr-Coulomb's strength in the plane q = sin(phi) sqrt(9 + 3 sin(psi)^2) / (3 + sin(phi) sin(psi)). With psi =
/// 0, q = sin(phi); with psi = phi it is Drucker and Prager's 3 tan(phi) / sqrt(9 + 12 tan(phi)^2), which
/// "plane-strain-associated" takes whatever psi is.
/// Inner, outer: q = 6 sin(phi) / (sqrt(3) (3 +- sin(phi))), and q_flow alike with psi.
/// Every cone has its apex at p = c / tan(phi).
Cone fit_cone(const DruckerPrager& m);

/// Return map on b_e in the logarithmic strain (de Souza Neto, Peric, Owen 2008, chapters 8.3 and 14): to the cone, to
/// the cap or to the circle in which they meet; an apex is such a circle of radius zero. The map runs in tau = J sigma
/// with J k and J tension_strength, so that the strength holds in the Cauchy stress at any change of volume. With a
/// relaxation_time the stress stops short of the surface, see overstress.hpp.
class DruckerPrager::Law {
 public:
  static constexpr bool has_history = true;

  explicit Law(const DruckerPrager& m);

  Sym6 stress(const Motion& motion, PointHistory& history) const;

  /// Hencky energy of b_e.
  double stored_energy(const Motion& motion, const PointHistory& history) const;

  /// See hencky_stiffness_bound.
  double wave_speed_squared(const Motion& motion, const PointHistory& history) const;

  /// The larger of f and p - tension_strength of a Cauchy stress, Pa; the plastic strain does not enter.
  double yield_function(const Sym6& sigma, const PointHistory& history = {}) const;

 private:
  double G_, K_, per_density_, per_cone_stiffness_, relaxation_time_;
  Cone cone_;
  double cap_;  ///< largest mean stress; infinite where there is neither apex nor cut-off
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solver/materials/elastic_parameters.hpp"
#include "solver/materials/motion.hpp"
#include "solver/materials/overstress.hpp"

namespace scarp {

/// J2 plasticity with isotropic hardening on a Hencky (logarithmic) elastic law, associated:
/// f = sqrt(3/2) |dev sigma| - s(a) <= 0 in the Cauchy stress, a the equivalent plastic strain, with
/// s(a) = yield_stress + hardening_modulus a + (saturation_stress - yield_stress) (1 - exp(-a / saturation_strain)),
/// the last part (Voce 1948) only where it is given.
struct VonMises : ElasticParameters {
  static constexpr std::string_view name = "von-mises";
  double yield_stress = 0;
  double hardening_modulus = 0;
  std::optional<double> saturation_stress = std::nullopt;
  std::optional<double> saturation_strain = std::nullopt;
  double relaxation_time = 0;

  template <class V>
  void describe(V&& v) {
    describe_elastic(v);
    v("yield_stress", yield_stress,
      Spec{.text = "uniaxial stress at first yield", .unit = "Pa", .above = 0, .required = true});
    v("hardening_modulus", hardening_modulus,
      Spec{.text = "linear rise of the yield stress per unit of equivalent plastic strain",
           .unit = "Pa",
           .at_least = 0});
    v("saturation_stress", saturation_stress,
      Spec{.text = "yield stress that is approached exponentially, beside the linear rise; at least yield_stress",
           .unit = "Pa",
           .above = 0});
    v("saturation_strain", saturation_strain,
      Spec{.text = "equivalent plastic strain after which 63 % of the way to saturation_stress is gone", .above = 0});
    describe_relaxation(v, relaxation_time);
  }
  class Law;
};

/// Radial return on b_e in the logarithmic strain (de Souza Neto, Peric, Owen 2008, boxes 7.3 and 14.3). The map runs
/// in tau = J sigma with J s(a), so that the strength holds in the Cauchy stress at any change of volume. With a
/// relaxation_time the stress stops short of the surface, see overstress.hpp.
class VonMises::Law {
 public:
  static constexpr bool has_history = true;

  explicit Law(const VonMises& m);

  Sym6 stress(const Motion& motion, PointHistory& history) const;

  /// Hencky energy of b_e; what hardening stores in the lattice counts as plastic work.
  double stored_energy(const Motion& motion, const PointHistory& history) const;

  /// See hencky_stiffness_bound.
  double wave_speed_squared(const Motion& motion, const PointHistory& history) const;

  /// f of a Cauchy stress after the plastic strain `history` holds, Pa.
  double yield_function(const Sym6& sigma, const PointHistory& history = {}) const;

 private:
  double strength(double a) const;
  double plastic_increment(double trial, double a, double J) const;

  double G_, K_, per_density_;
  double yield_, modulus_, saturation_rise_, per_saturation_strain_, relaxation_time_;
};

}  // namespace scarp

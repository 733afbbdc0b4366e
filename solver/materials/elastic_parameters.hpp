// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <optional>

#include "solver/model/schema.hpp"

namespace scarp {

/// The parameters that every isotropic elastic law shares.
struct ElasticParameters {
  double density = 0;
  double youngs_modulus = 0;
  double poissons_ratio = 0;
  std::optional<double> saturated_density = std::nullopt;

  double shear_modulus() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }
  /// Lame's first parameter.
  double lambda() const { return youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio)); }
  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }
  /// Speed of compression waves, sqrt((lambda + 2 mu) / rho), m/s.
  double wave_speed() const { return std::sqrt((lambda() + 2 * shear_modulus()) / density); }
  double shear_wave_speed() const { return std::sqrt(shear_modulus() / density); }

  template <class V>
  void describe_elastic(V&& v) {
    v("density", density,
      Spec{.text = "mass density in the reference configuration", .unit = "kg/m3", .above = 0, .required = true});
    v("youngs_modulus", youngs_modulus, Spec{.text = "Young's modulus", .unit = "Pa", .above = 0, .required = true});
    v("poissons_ratio", poissons_ratio, Spec{.text = "Poisson's ratio", .above = -1, .below = 0.5, .required = true});
    v("saturated_density", saturated_density,
      Spec{.text = "mass density below the water table, pores full; default: density", .unit = "kg/m3", .above = 0});
  }
};

}  // namespace scarp

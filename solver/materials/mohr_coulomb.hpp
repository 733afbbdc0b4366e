// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/materials/elastic_parameters.hpp"

namespace scarp {

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
};

}  // namespace scarp

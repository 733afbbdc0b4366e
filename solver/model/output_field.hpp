// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "solver/model/schema.hpp"

namespace scarp {

/// What a frame can carry per particle beside id, body, material, surface, colour and volume, which it always does.
enum class OutputField {
  displacement,
  velocity,
  stress,
  equivalent_plastic_strain,
  mean_stress,
  von_mises_stress,
  volume_ratio,
  deformation_gradient,
  density,
  pore_pressure
};
template <>
struct enum_names<OutputField> {
  static constexpr std::array<std::pair<std::string_view, OutputField>, 10> value{
      {{"displacement", OutputField::displacement},
       {"velocity", OutputField::velocity},
       {"stress", OutputField::stress},
       {"equivalent_plastic_strain", OutputField::equivalent_plastic_strain},
       {"mean_stress", OutputField::mean_stress},
       {"von_mises_stress", OutputField::von_mises_stress},
       {"volume_ratio", OutputField::volume_ratio},
       {"deformation_gradient", OutputField::deformation_gradient},
       {"density", OutputField::density},
       {"pore_pressure", OutputField::pore_pressure}}};
};

}  // namespace scarp

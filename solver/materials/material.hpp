// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of laws. A new law is one file that holds its parameters and its stress update, one entry in
// `Material`, and one line in the harness's list of admissible parameters.
#pragma once

#include <variant>

#include "solver/materials/cam_clay.hpp"
#include "solver/materials/drucker_prager.hpp"
#include "solver/materials/granular.hpp"
#include "solver/materials/hencky.hpp"
#include "solver/materials/linear_elastic.hpp"
#include "solver/materials/mohr_coulomb.hpp"
#include "solver/materials/neo_hookean.hpp"
#include "solver/materials/von_mises.hpp"
#include "solver/materials/water.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

using Material =
    std::variant<LinearElastic, NeoHookean, MohrCoulomb, Hencky, VonMises, DruckerPrager, CamClay, Water, Granular>;
template <>
struct choice_key<Material> {
  static constexpr std::string_view value = "model";
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How bodies rub and stick: ContactOptions by body and by material.
#pragma once

#include <compare>
#include <optional>
#include <vector>

#include "solver/model/model.hpp"

namespace scarp {

struct ContactLaw {
  double friction = 0;  ///< Coulomb's coefficient
  double adhesion = 0;  ///< Pa
  auto operator<=>(const ContactLaw&) const = default;
};

/// Per pair of materials, by index a * materials + b.
std::vector<ContactLaw> contact_laws_of_materials(const Model& model);

/// What is said of this pair of materials by name, if anything is.
std::optional<ContactLaw> contact_law_of_materials(const Model& model, std::int32_t a, std::int32_t b);

/// What holds for this pair of bodies by name, if anything does: it comes before their materials.
std::optional<ContactLaw> contact_law_of_bodies(const Model& model, std::int32_t a, std::int32_t b);

/// The one law of two bodies, for contact that does not know materials apart.
/// @throws Error ("solve") where their materials have several.
ContactLaw contact_law_between(const Model& model, std::int32_t a, std::int32_t b);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "solver/model/schema.hpp"

namespace scarp {

/// How bodies meet, beside updated-Lagrangian ones that share a grid and stick on it.
enum class ContactMethod { none, penalty, grid };
template <>
struct enum_names<ContactMethod> {
  static constexpr std::array<std::pair<std::string_view, ContactMethod>, 3> value{
      {{"none", ContactMethod::none}, {"penalty", ContactMethod::penalty}, {"grid", ContactMethod::grid}}};
};

/// Two bodies, or two materials, that rub in their own way.
struct ContactPairOptions {
  std::vector<std::string> bodies;
  std::vector<std::string> materials;
  double friction = 0;
  std::optional<double> adhesion = std::nullopt;

  template <class V>
  void describe(V&& v) {
    v("bodies", bodies, Spec{.text = "names of two bodies, or of one twice for where it touches itself"});
    v("materials", materials, Spec{.text = "instead: names of two materials, or of one twice; bodies come first"});
    v("friction", friction, Spec{.text = "their Coulomb coefficient", .at_least = 0, .required = true});
    v("adhesion", adhesion, Spec{.text = "their adhesion; default: contact.adhesion", .unit = "Pa", .at_least = 0});
  }
};

struct ContactOptions {
  ContactMethod method = ContactMethod::none;
  double friction = 0;
  double adhesion = 0;
  double stiffness = 4;
  bool self_contact = false;
  std::vector<ContactPairOptions> pairs;

  template <class V>
  void describe(V&& v) {
    v("method", method,
      Spec{.text =
               "\"none\": total-Lagrangian bodies do not see each other, updated-Lagrangian ones meet and stick on "
               "their grid; \"penalty\": springs between the surfaces of total-Lagrangian bodies, and between them "
               "and updated-Lagrangian bodies (these still share their grid); faces of the domain with friction stop "
               "total-Lagrangian bodies that come to them; \"grid\": updated-Lagrangian bodies have velocities of "
               "their own at the nodes of their grid, and where they meet they slide, stick and part after Coulomb's "
               "law; where there are total-Lagrangian bodies, \"penalty\" holds for these. Rigid bodies are met by "
               "springs with \"penalty\", else as bodies.rigid.surface says"});
    v("friction", friction, Spec{.text = "Coulomb coefficient", .at_least = 0});
    v("adhesion", adhesion,
      Spec{.text =
               "with method \"grid\": tension that surfaces bear where they touch, and which counts as pressure for "
               "friction; once apart they bear none until they touch again",
           .unit = "Pa",
           .at_least = 0});
    v("stiffness", stiffness,
      Spec{.text =
               "of the springs: pressure per depth, as a multiple of the P-wave modulus of the softer body over the "
               "spacing of the finer one's particles; a rigid body counts as neither beside one that deforms",
           .above = 0});
    v("self_contact", self_contact,
      Spec{.text =
               "whether total-Lagrangian bodies touch themselves where they fold; parts within four spacings of their "
               "particles of each other in the reference configuration do not"});
    v("pairs", pairs, Spec{.text = "pairs with a friction of their own"});
  }
};

}  // namespace scarp

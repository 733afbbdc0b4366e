// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/contact_laws.hpp"

#include <algorithm>
#include <set>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

ContactLaw law_of(const Model& model, const ContactPairOptions& pair) {
  return {pair.friction, pair.adhesion.value_or(model.contact.adhesion)};
}

/// The last pair of these names, in either order.
std::optional<ContactLaw> law_of_pair(const Model& model, std::vector<std::string> ContactPairOptions::*names,
                                      const std::string& a, const std::string& b) {
  std::optional<ContactLaw> law;
  for (const ContactPairOptions& pair : model.contact.pairs) {
    const std::vector<std::string>& of = pair.*names;
    if (of.empty()) continue;
    if ((of[0] == a && of[1] == b) || (of[0] == b && of[1] == a)) law = law_of(model, pair);
  }
  return law;
}

std::set<std::int32_t> materials_of(const Model& model, const Body& body) {
  return {model.particles.material.begin() + static_cast<std::ptrdiff_t>(body.begin),
          model.particles.material.begin() + static_cast<std::ptrdiff_t>(body.end)};
}

}  // namespace

std::optional<ContactLaw> contact_law_of_materials(const Model& model, std::int32_t a, std::int32_t b) {
  return law_of_pair(model, &ContactPairOptions::materials, model.materials[a].name, model.materials[b].name);
}

std::vector<ContactLaw> contact_laws_of_materials(const Model& model) {
  const auto count = static_cast<std::int32_t>(model.materials.size());
  std::vector<ContactLaw> laws;
  for (std::int32_t a = 0; a < count; ++a)
    for (std::int32_t b = 0; b < count; ++b)
      laws.push_back(
          contact_law_of_materials(model, a, b).value_or(ContactLaw{model.contact.friction, model.contact.adhesion}));
  return laws;
}

std::optional<ContactLaw> contact_law_of_bodies(const Model& model, std::int32_t a, std::int32_t b) {
  return law_of_pair(model, &ContactPairOptions::bodies, model.bodies[a].name, model.bodies[b].name);
}

ContactLaw contact_law_between(const Model& model, std::int32_t a, std::int32_t b) {
  if (const auto law = contact_law_of_bodies(model, a, b)) return *law;
  const std::vector<ContactLaw> of_materials = contact_laws_of_materials(model);
  std::set<ContactLaw> found;
  for (const std::int32_t i : materials_of(model, model.bodies[a]))
    for (const std::int32_t j : materials_of(model, model.bodies[b]))
      found.insert(of_materials[i * model.materials.size() + j]);
  if (found.size() > 1)
    throw Error("solve",
                "friction between bodies '" + model.bodies[a].name + "' and '" + model.bodies[b].name +
                    "' by the pairs of their materials",
                shortest(found.begin()->friction) + " and " + shortest(found.rbegin()->friction),
                "one: nodes do not know the materials of a body apart; an entry of contact.pairs with these bodies");
  return *found.begin();
}

}  // namespace scarp

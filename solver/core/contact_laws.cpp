// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/contact_laws.hpp"

#include <algorithm>
#include <set>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

std::size_t index_of_material(const Model& model, const std::string& name) {
  return static_cast<std::size_t>(std::find_if(model.materials.begin(), model.materials.end(),
                                               [&](const NamedMaterial& m) { return m.name == name; }) -
                                  model.materials.begin());
}

ContactLaw law_of(const Model& model, const ContactPairOptions& pair) {
  return {pair.friction, pair.adhesion.value_or(model.contact.adhesion)};
}

std::set<std::int32_t> materials_of(const Model& model, const Body& body) {
  return {model.particles.material.begin() + static_cast<std::ptrdiff_t>(body.begin),
          model.particles.material.begin() + static_cast<std::ptrdiff_t>(body.end)};
}

}  // namespace

std::vector<ContactLaw> contact_laws_of_materials(const Model& model) {
  const std::size_t count = model.materials.size();
  std::vector<ContactLaw> laws(count * count, {model.contact.friction, model.contact.adhesion});
  for (const ContactPairOptions& pair : model.contact.pairs) {
    if (pair.materials.empty()) continue;
    const std::size_t a = index_of_material(model, pair.materials[0]), b = index_of_material(model, pair.materials[1]);
    laws[a * count + b] = laws[b * count + a] = law_of(model, pair);
  }
  return laws;
}

std::optional<ContactLaw> contact_law_of_bodies(const Model& model, std::int32_t a, std::int32_t b) {
  std::optional<ContactLaw> law;
  for (const ContactPairOptions& pair : model.contact.pairs) {
    if (pair.bodies.empty()) continue;
    const std::string &first = model.bodies[a].name, &second = model.bodies[b].name;
    if ((pair.bodies[0] == first && pair.bodies[1] == second) || (pair.bodies[0] == second && pair.bodies[1] == first))
      law = law_of(model, pair);
  }
  return law;
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

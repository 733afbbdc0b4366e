// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/check_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/core/moving_reference.hpp"
#include "solver/core/pore_water.hpp"
#include "solver/core/shaking.hpp"
#include "solver/core/step_options.hpp"
#include "solver/core/wave_speeds.hpp"
#include "solver/materials/law.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& value, const std::string& allowed) {
  throw Error("solve", what, value, allowed);
}

std::string text(const Vec3& x) { return "(" + shortest(x[0]) + ", " + shortest(x[1]) + ", " + shortest(x[2]) + ")"; }

void check_arrays(const Particles& particles) {
  const auto check = [&](const char* name, std::size_t values) {
    if (values != particles.size())
      refuse(std::string("number of values of particle field '") + name + "'", std::to_string(values),
             "one per particle, " + std::to_string(particles.size()));
  };
  for_each_constant(
      [&](const char* name, const char*, auto member, const auto&) { check(name, (particles.*member).size()); });
  for_each_of_state([&](const char* name, const char*, auto member, const auto&) {
    if (!(particles.*member).empty()) check(name, (particles.*member).size());
  });
}

void check_bodies(const Model& model) {
  std::size_t expected = 0;
  for (const Body& body : model.bodies) {
    const std::string of = " of body '" + body.name + "'";
    if (body.begin != expected || body.end < body.begin || body.end > model.particles.size())
      refuse("particle range" + of, std::to_string(body.begin) + " to " + std::to_string(body.end),
             "contiguous ranges in the order of the bodies");
    if (body.end == body.begin) refuse("number of particles" + of, "0", "at least one");
    if (!(body.lattice.cell > 0) || !std::isfinite(body.lattice.cell) || !is_finite(body.lattice.origin))
      refuse("cell" + of, shortest(body.lattice.cell), "above 0 m");
    if (body.lattice.dimension() != model.domain.dimension)
      refuse("dimension of the lattice" + of, std::to_string(body.lattice.dimension()),
             "that of the domain, " + std::to_string(model.domain.dimension));
    expected = body.end;
  }
  if (expected != model.particles.size() || expected == 0)
    refuse("particles that belong to a body", std::to_string(expected), "all, and at least one");
}

void check_particle(const Model& model, std::int32_t body, std::size_t p) {
  const Particles& particles = model.particles;
  const auto name = [&] {
    return " of particle " + std::to_string(particles.id[p]) + " of body '" + model.bodies[body].name + "'";
  };
  if (particles.body[p] != body) refuse("body" + name(), std::to_string(particles.body[p]), std::to_string(body));
  if (particles.material[p] < 0 || static_cast<std::size_t>(particles.material[p]) >= model.materials.size())
    refuse("material" + name(), std::to_string(particles.material[p]),
           "0 to " + std::to_string(static_cast<long>(model.materials.size()) - 1));
  if (!(particles.mass[p] > 0) || !std::isfinite(particles.mass[p]))
    refuse("mass" + name(), shortest(particles.mass[p]), "above 0 kg");
  if (!(particles.reference_volume[p] > 0) || !std::isfinite(particles.reference_volume[p]))
    refuse("reference volume" + name(), shortest(particles.reference_volume[p]), "above 0 m3");
  const Vec3 X = particles.reference_position[p], x = current_positions(particles)[p];
  if (!is_finite(X) || !is_finite(x)) refuse("position" + name(), text(x), "finite");
  const Vec3 v = particles.velocity.empty() ? Vec3{0, 0, 0} : particles.velocity[p];
  if (!is_finite(v)) refuse("velocity" + name(), text(v), "finite");
  const Mat3 F = particles.deformation_gradient.empty() ? kIdentity : particles.deformation_gradient[p];
  if (model.domain.dimension == 2 && (v[2] != 0 || F[2] != 0 || F[5] != 0 || F[6] != 0 || F[7] != 0))
    refuse("motion out of the plane" + name(), text(v), "none in plane strain");
}

void check_relaxing(const RelaxOptions& relax) {
  if (!(relax.until > 0 && relax.until < 1)) refuse("relax.until", shortest(relax.until), "above 0, below 1");
  if (relax.time && !(*relax.time > 0 && std::isfinite(*relax.time)))
    refuse("relax.time", shortest(*relax.time), "above 0 s");
  if (!(relax.damping > 0 && relax.damping < 1)) refuse("relax.damping", shortest(relax.damping), "above 0, below 1");
}

/// A grid that moves with the material finds its nodes anew: what nodes alone remember is lost.
void check_moving(const Model& model, double courant) {
  if (!has_formulation(model, Formulation::total_lagrangian))
    refuse("reference_update", "given", "none: no body is total-Lagrangian");
  if (courant > kCourantOfMovedGrids)
    refuse("courant with reference_update", shortest(courant), "at most " + shortest(kCourantOfMovedGrids));
  if (has_absorbing_face(model.domain))
    refuse("reference_update with an absorbing face", "given",
           "none: dashpots belong to the nodes of the first reference configuration");
  for (const Body& body : model.bodies)
    if (!body.rigid.grips.empty())
      refuse("reference_update with grips of rigid body '" + body.name + "'", "given",
             "none: grips hold nodes of the first reference configuration");
  for (const LoadOptions& load : model.loads)
    if (load.velocity || load.displacement)
      refuse("reference_update with load '" + load.name + "', which imposes a motion on nodes", "given",
             "none, or a traction or force: those act on particles");
}

void check_transfer(const SolverOptions& options) {
  if (options.transfer != Transfer::flip) {
    if (options.flip != 1) refuse("flip", shortest(options.flip), "only with transfer = \"flip\"");
    if (options.pic_rate != 0) refuse("pic_rate", shortest(options.pic_rate), "only with transfer = \"flip\"");
  }
  if (options.transfer == Transfer::apic && options.reference_update)
    refuse("reference_update with transfer = \"apic\"", shortest(*options.reference_update),
           "none: affine velocities belong to one reference configuration; or transfer = \"xpic\"");
  if (!options.xpic_order) return;
  if (options.transfer != Transfer::xpic)
    refuse("xpic_order", std::to_string(*options.xpic_order), "only with transfer = \"xpic\"");
  if (*options.xpic_order < 2 || *options.xpic_order > 5)
    refuse("xpic_order", std::to_string(*options.xpic_order), "2 to 5");
}

void check_pair(const Model& model, const ContactPairOptions& pair, const std::string& name) {
  if (pair.bodies.empty() == pair.materials.empty()) refuse(name, "", "one of bodies and materials");
  const std::vector<std::string>& names = pair.bodies.empty() ? pair.materials : pair.bodies;
  if (names.size() != 2) refuse("names of " + name, std::to_string(names.size()), "two");
  const auto known = [&](const std::string& wanted) {
    const auto is = [&](const auto& entry) { return entry.name == wanted; };
    return pair.bodies.empty() ? std::any_of(model.materials.begin(), model.materials.end(), is)
                               : std::any_of(model.bodies.begin(), model.bodies.end(), is);
  };
  for (const std::string& wanted : names)
    if (!known(wanted))
      refuse(name, "'" + wanted + "'", pair.bodies.empty() ? "the name of a material" : "the name of a body");
  if (!pair.bodies.empty() && names[0] == names[1] && !model.contact.self_contact)
    refuse(name, "'" + names[0] + "' twice", "two bodies, or contact.self_contact");
  if (!(pair.friction >= 0) || !std::isfinite(pair.friction))
    refuse("friction of " + name, shortest(pair.friction), "0 or above");
  if (pair.adhesion && (!(*pair.adhesion >= 0) || !std::isfinite(*pair.adhesion)))
    refuse("adhesion of " + name, shortest(*pair.adhesion), "0 Pa or above");
}

}  // namespace

void check_model(const Model& model) {
  if (model.domain.dimension != 2 && model.domain.dimension != 3)
    refuse("dimension", std::to_string(model.domain.dimension), "2 or 3");
  for (const NamedMaterial& material : model.materials) validate(material.law, material.name);
  check_arrays(model.particles);
  check_bodies(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    for (std::size_t p = model.bodies[b].begin; p < model.bodies[b].end; ++p)
      check_particle(model, static_cast<std::int32_t>(b), p);
}

void check_options(const SolverOptions& options, int dimension) {
  const Vec3 gravity = gravity_of(options, dimension);
  if (!is_finite(gravity) || (dimension == 2 && gravity[2] != 0))
    refuse("gravity", text(gravity), dimension == 2 ? "finite, and in the plane" : "finite");
  if (!(options.courant > 0 && options.courant <= 1))
    refuse("courant", shortest(options.courant), "above 0, at most 1");
  if (!(options.flip >= 0 && options.flip <= 1)) refuse("flip", shortest(options.flip), "0 to 1");
  if (!(options.pic_rate >= 0) || !std::isfinite(options.pic_rate))
    refuse("pic_rate", shortest(options.pic_rate), "0 1/s or above");
  check_transfer(options);
  if (!(options.end_time > 0) || !std::isfinite(options.end_time))
    refuse("end_time", shortest(options.end_time), "above 0 s");
  if (!(options.gravity_ramp >= 0) || !std::isfinite(options.gravity_ramp))
    refuse("gravity_ramp", shortest(options.gravity_ramp), "0 s or above");
  if (!(options.damping >= 0 && options.damping < 1)) refuse("damping", shortest(options.damping), "0 to below 1");
  if (options.reference_update && !(*options.reference_update > 1 && std::isfinite(*options.reference_update)))
    refuse("reference_update", shortest(*options.reference_update), "above 1");
  if (options.relax) check_relaxing(*options.relax);
  if (options.max_steps < 1) refuse("max_steps", std::to_string(options.max_steps), "at least 1");
}

void check_options(const OutputOptions& options) {
  const auto check = [](const char* name, const std::optional<double>& value) {
    if (value && (!(*value > 0) || !std::isfinite(*value))) refuse(name, shortest(*value), "above 0 s");
  };
  check("every", options.every);
  check("history_every", options.history_every);
}

void check_formulations(const Model& model, const SolverOptions& options) {
  check_shaking(model);
  check_water(model, options);
  if (options.reference_update) check_moving(model, options.courant);
  for (const Body& body : model.bodies) {
    if (body.formulation == Formulation::rigid) continue;
    if (body.formulation != Formulation::total_lagrangian) {
      if (!options.body_force.empty() || model.body_force)
        refuse("body_force with updated-Lagrangian body '" + body.name + "'", "given",
               "none: it acts on total-Lagrangian bodies only");
      continue;
    }
    if (options.update != UpdateOrder::musl)
      refuse("update of total-Lagrangian body '" + body.name + "'", std::string(name_of(options.update)),
             "musl; or formulation = \"updated-lagrangian\" for the body");
    if (options.shape != ShapeFunction::linear)
      refuse("shape of total-Lagrangian body '" + body.name + "'", std::string(name_of(options.shape)),
             "linear; or formulation = \"updated-lagrangian\" for the body");
  }
}

void check_rigid(const Model& model) {
  if (!has_formulation(model, Formulation::rigid)) return;
  const bool penalty = model.contact.method == ContactMethod::penalty;
  const bool any_free = std::any_of(model.bodies.begin(), model.bodies.end(), [](const Body& body) {
    return body.formulation == Formulation::rigid && body.rigid.motion == RigidMotion::free;
  });
  if (deforming_particles(model) == 0 && !any_free)
    refuse("bodies", "all rigid", "at least one that deforms or moves freely");
  for (const Body& body : model.bodies) {
    if (body.formulation != Formulation::rigid) continue;
    for (const std::string& name : body.rigid.grips) {
      const bool known = std::any_of(model.bodies.begin(), model.bodies.end(), [&](const Body& other) {
        return other.name == name && other.formulation == Formulation::total_lagrangian;
      });
      if (!known)
        refuse("grips of rigid body '" + body.name + "'", "'" + name + "'", "the name of a total-Lagrangian body");
    }
    if (body.rigid.motion == RigidMotion::free && !penalty)
      refuse("contact.method with rigid body '" + body.name + "', which moves freely",
             std::string(name_of(model.contact.method)), "\"penalty\"");
    if (body.rigid.grips.empty() && !penalty && !rigid_bodies_carry(model))
      refuse("rigid body '" + body.name + "', which nothing can meet", "",
             "contact.method = \"penalty\", updated-Lagrangian bodies, or total-Lagrangian ones that it grips");
  }
}

bool rigid_bodies_carry(const Model& model) {
  return has_formulation(model, Formulation::rigid) && has_formulation(model, Formulation::updated_lagrangian) &&
         model.contact.method != ContactMethod::penalty;
}

void check_contact(const Model& model, const SolverOptions& options) {
  const ContactOptions& contact = model.contact;
  if (!(contact.friction >= 0) || !std::isfinite(contact.friction))
    refuse("contact.friction", shortest(contact.friction), "0 or above");
  if (!(contact.stiffness > 0) || !std::isfinite(contact.stiffness))
    refuse("contact.stiffness", shortest(contact.stiffness), "above 0");
  const auto adheres = [](const ContactPairOptions& pair) { return pair.adhesion.value_or(0) > 0; };
  const bool any = contact.adhesion > 0 || std::any_of(contact.pairs.begin(), contact.pairs.end(), adheres);
  if (!(contact.adhesion >= 0) || !std::isfinite(contact.adhesion))
    refuse("contact.adhesion", shortest(contact.adhesion), "0 Pa or above");
  if (any && (contact.method != ContactMethod::grid || has_formulation(model, Formulation::total_lagrangian)))
    refuse("adhesion in contact", "given", "none, or method \"grid\" between updated-Lagrangian bodies alone");
  for (std::size_t i = 0; i < contact.pairs.size(); ++i)
    check_pair(model, contact.pairs[i], "contact.pairs." + std::to_string(i));
  if (contact.self_contact &&
      (contact.method == ContactMethod::none || !has_formulation(model, Formulation::total_lagrangian)))
    refuse("contact.self_contact", "true",
           "false with method \"none\", and without a total-Lagrangian body: others touch themselves on their grid");
  if (contact.method == ContactMethod::none) {
    if (!contact.pairs.empty()) refuse("contact.pairs with method \"none\"", "given", "none, or another method");
    return;
  }
  if (contact.method == ContactMethod::penalty && !has_formulation(model, Formulation::total_lagrangian) &&
      !has_formulation(model, Formulation::rigid))
    refuse("contact.method without a total-Lagrangian or rigid body", "penalty",
           "\"grid\", or \"none\": updated-Lagrangian bodies meet and stick on the grid that they share");
  if (contact.method == ContactMethod::grid && !has_formulation(model, Formulation::updated_lagrangian))
    refuse("contact.method without an updated-Lagrangian body", "grid", "\"penalty\" or \"none\"");
  if (options.relax)
    refuse("solver.relax with contact", "given", "none: displacements begin anew after it, and contact would open");
  if (options.reference_update)
    refuse("solver.reference_update with contact", "given",
           "none: surfaces belong to the first reference configuration");
}

std::size_t deforming_particles(const Model& model) {
  std::size_t count = 0;
  for (const Body& body : model.bodies)
    if (body.formulation != Formulation::rigid) count += body.end - body.begin;
  return count;
}

bool has_formulation(const Model& model, Formulation formulation) {
  return std::any_of(model.bodies.begin(), model.bodies.end(),
                     [&](const Body& body) { return body.formulation == formulation; });
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/law_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scarp {
namespace {

using kernels::LawKind;
using kernels::LawParameters;
using Found = std::optional<LawParameters>;

constexpr double kPerDegree = std::numbers::pi / 180;
constexpr double kNone = std::numeric_limits<double>::max();

struct Parameters {
  Found operator()(const NeoHookean& m) const {
    return LawParameters{LawKind::neo_hookean, {m.shear_modulus(), m.lambda(), 1 / m.density}};
  }
  Found operator()(const Hencky& m) const {
    return LawParameters{LawKind::hencky, {m.shear_modulus(), m.lambda(), 1 / m.density}};
  }
  Found operator()(const VonMises& m) const {
    if (m.saturation_stress || m.relaxation_time > 0) return std::nullopt;
    return LawParameters{LawKind::von_mises,
                         {m.shear_modulus(), m.bulk_modulus(), 1 / m.density, m.yield_stress, m.hardening_modulus}};
  }
  Found operator()(const DruckerPrager& m) const {
    if (m.relaxation_time > 0) return std::nullopt;
    const Cone cone = fit_cone(m);
    const double apex = cone.q > 0 ? cone.k / cone.q : kNone;
    return LawParameters{LawKind::drucker_prager,
                         {m.shear_modulus(), m.bulk_modulus(), 1 / m.density, cone.q, cone.k, cone.q_flow,
                          std::min(apex, m.tension_strength.value_or(apex))}};
  }
  Found operator()(const MohrCoulomb& m) const {
    if (m.softens() || m.relaxation_time > 0) return std::nullopt;
    const double phi = m.friction_angle * kPerDegree, psi = m.dilatancy_angle * kPerDegree;
    const double apex = m.friction_angle > 0 ? m.cohesion / std::tan(phi) : kNone;
    const double tension = m.tension_strength ? std::min(*m.tension_strength, apex) : kNone;
    return LawParameters{LawKind::mohr_coulomb,
                         {m.shear_modulus(), m.bulk_modulus(), 1 / m.density, m.cohesion * std::cos(phi), std::sin(phi),
                          std::sin(psi), tension}};
  }
  template <class Other>
  Found operator()(const Other&) const {
    return std::nullopt;
  }
};

}  // namespace

Found kernel_of(const Material& material) { return std::visit(Parameters{}, material); }

std::vector<Found> kernels_of(const Model& model) {
  std::vector<Found> found;
  for (const NamedMaterial& material : model.materials) found.push_back(kernel_of(material.law));
  return found;
}

kernels::ParticleArrays arrays_of(Particles& particles) {
  return {particles.position.data()->data(),
          particles.velocity.data()->data(),
          particles.deformation_gradient.data()->data(),
          particles.stress.data()->data(),
          particles.elastic_left_cauchy_green.data()->data(),
          particles.equivalent_plastic_strain.data(),
          particles.plastic_work.data(),
          particles.mass.data(),
          particles.reference_volume.data()};
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <optional>
#include <type_traits>

#include "solver/materials/law.hpp"

namespace scarp {
namespace {

/// Visits the schema: every number within the range that its key states.
struct RangeCheck {
  const std::string& material;
  const SourceLocation& where;

  void operator()(std::string_view key, const double& value, const Spec& spec) const {
    const auto refuse = [&](const std::string& allowed) {
      throw Error("materials", std::string(key) + " of material '" + material + "'", shortest(value),
                  allowed + (spec.unit.empty() ? "" : " " + std::string(spec.unit)), where);
    };
    if (!std::isfinite(value)) refuse("a finite number, in");
    if (value < spec.at_least) refuse("at least " + shortest(spec.at_least));
    if (value <= spec.above) refuse("above " + shortest(spec.above));
    if (value > spec.at_most) refuse("at most " + shortest(spec.at_most));
    if (value >= spec.below) refuse("below " + shortest(spec.below));
  }
  void operator()(std::string_view key, const std::optional<double>& value, const Spec& spec) const {
    if (value) (*this)(key, *value, spec);
  }
  void operator()(std::string_view, const bool&, const Spec&) const {}
  template <class E>
  requires std::is_enum_v<E>
  void operator()(std::string_view, const E&, const Spec&) const {}
};

void check_together(const Water&, const std::string&, const SourceLocation&) {}

void check_together(const ElasticParameters&, const std::string&, const SourceLocation&) {}

void check_together(const VonMises& m, const std::string& name, const SourceLocation& where) {
  if (m.saturation_stress.has_value() != m.saturation_strain.has_value())
    throw Error("materials", "saturation of material '" + name + "'",
                std::string(m.saturation_stress ? "saturation_stress" : "saturation_strain") + " alone",
                "saturation_stress and saturation_strain together, or neither", where);
  if (m.saturation_stress && *m.saturation_stress < m.yield_stress)
    throw Error("materials", "saturation_stress of material '" + name + "'", shortest(*m.saturation_stress),
                "at least yield_stress (" + shortest(m.yield_stress) + " Pa)", where);
}

void check_together(const Granular& m, const std::string& name, const SourceLocation& where) {
  if (m.mu_2 < m.mu_s)
    throw Error("materials", "mu_2 of material '" + name + "'", shortest(m.mu_2),
                "at least mu_s (" + shortest(m.mu_s) + ")", where);
  if (m.grain_density < m.density)
    throw Error("materials", "grain_density of material '" + name + "'", shortest(m.grain_density),
                "at least density (" + shortest(m.density) + " kg/m3)", where);
}

void check_together(const CamClay& m, const std::string& name, const SourceLocation& where) {
  const auto refuse = [&](const char* what, const std::string& found, const std::string& allowed) {
    throw Error("materials", std::string(what) + " of material '" + name + "'", found, allowed, where);
  };
  if (m.lambda <= m.kappa) refuse("lambda", shortest(m.lambda), "above kappa (" + shortest(m.kappa) + ")");
  if (m.critical_stress_ratio.has_value() == m.friction_angle.has_value())
    refuse("critical state", m.friction_angle ? "critical_stress_ratio and friction_angle" : "neither",
           "one of critical_stress_ratio and friction_angle");
  if (m.preconsolidation && m.overconsolidation_ratio)
    refuse("preconsolidation", "preconsolidation and overconsolidation_ratio", "at most one of them");
  if (m.preconsolidation && *m.preconsolidation < m.initial_pressure)
    refuse("preconsolidation", shortest(*m.preconsolidation),
           "at least initial_pressure (" + shortest(m.initial_pressure) + " Pa)");
}

/// For the laws with cohesion and friction.
template <class Soil>
void check_strength(const Soil& m, const std::string& name, const SourceLocation& where) {
  if (m.dilatancy_angle > m.friction_angle)
    throw Error("materials", "dilatancy_angle of material '" + name + "'", shortest(m.dilatancy_angle),
                "at most friction_angle (" + shortest(m.friction_angle) + " deg)", where);
  if (m.cohesion == 0 && m.friction_angle == 0)
    throw Error("materials", "material '" + name + "' has no strength", "cohesion 0 and friction_angle 0",
                "at least one of them above 0", where);
  const double apex = m.cohesion / std::tan(m.friction_angle * std::numbers::pi / 180);
  if (m.tension_strength && *m.tension_strength > apex)
    throw Error("materials", "tension_strength of material '" + name + "'", shortest(*m.tension_strength),
                "at most cohesion / tan(friction_angle) (" + shortest(apex) + " Pa)", where);
}

void check_together(const DruckerPrager& m, const std::string& name, const SourceLocation& where) {
  check_strength(m, name, where);
}

void check_softening(const MohrCoulomb& m, const std::string& name, const SourceLocation& where) {
  const auto refuse = [&](const char* key, const std::string& found, const std::string& allowed) {
    throw Error("materials", std::string(key) + " of material '" + name + "'", found, allowed, where);
  };
  const auto falls = [&](const char* key, double peak, const std::optional<double>& residual, const char* unit) {
    if (residual && *residual > peak)
      refuse((std::string("residual_") + key).c_str(), shortest(*residual),
             std::string("at most ") + key + " (" + shortest(peak) + unit + ")");
  };
  falls("cohesion", m.cohesion, m.residual_cohesion, " Pa");
  falls("friction_angle", m.friction_angle, m.residual_friction_angle, " deg");
  falls("dilatancy_angle", m.dilatancy_angle, m.residual_dilatancy_angle, " deg");
  const double cohesion = m.residual_cohesion.value_or(m.cohesion);
  const double friction = m.residual_friction_angle.value_or(m.friction_angle);
  const double dilatancy = m.residual_dilatancy_angle.value_or(m.dilatancy_angle);
  if (dilatancy > friction)
    refuse("residual_dilatancy_angle", shortest(dilatancy),
           "at most residual_friction_angle (" + shortest(friction) + " deg)");
  if (cohesion == 0 && friction == 0)
    refuse("residual strength", "residual_cohesion 0 and residual_friction_angle 0", "at least one of them above 0");
  if (m.softens() && !m.softening_strain)
    refuse("softening_strain", "no value", "a plastic strain above 0, which a residual value needs");
  if (!m.softens() && (m.softening_strain || m.softening_length))
    refuse(m.softening_strain ? "softening_strain" : "softening_length", "no residual value beside it",
           "residual_cohesion, residual_friction_angle or residual_dilatancy_angle with it");
}

void check_together(const MohrCoulomb& m, const std::string& name, const SourceLocation& where) {
  check_strength(m, name, where);
  check_softening(m, name, where);
}

}  // namespace

void validate(const Material& material, const std::string& name, const SourceLocation& where) {
  std::visit(
      [&](auto m) {
        m.describe(RangeCheck{name, where});
        check_together(m, name, where);
      },
      material);
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

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
};

void check_together(const ElasticParameters&, const std::string&, const SourceLocation&) {}

void check_together(const MohrCoulomb& m, const std::string& name, const SourceLocation& where) {
  if (m.dilatancy_angle > m.friction_angle)
    throw Error("materials", "dilatancy_angle of material '" + name + "'", shortest(m.dilatancy_angle),
                "at most friction_angle (" + shortest(m.friction_angle) + " deg)", where);
  if (m.cohesion == 0 && m.friction_angle == 0)
    throw Error("materials", "material '" + name + "' has no strength", "cohesion 0 and friction_angle 0",
                "at least one of them above 0", where);
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

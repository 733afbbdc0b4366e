// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/resolve.hpp"

#include <algorithm>
#include <cmath>

#include "tools/scenario/schema_kinds.hpp"

namespace scarp {
namespace {

class Localizer {
 public:
  explicit Localizer(const Vec3& origin) : origin_(origin) {}

  template <class T>
  void move(T& member, Role role) const {
    if constexpr (Tuple<T>) {
      if (role == Role::position)
        for (std::size_t a = 0; a < member.size(); ++a) member[a] -= origin_[a];
    } else if constexpr (std::is_same_v<T, double>) {
      if (role == Role::elevation) member -= origin_[2];
    } else if constexpr (is_optional<T>) {
      if (member) move(*member, role);
    } else if constexpr (is_list<T>) {
      for (auto& item : member) move(item, role);
    } else if constexpr (is_map<T>) {
      for (auto& [key, value] : member) move(value, role);
    } else if constexpr (Choice<T>) {
      std::visit([&](auto& alternative) { move(alternative, role); }, member);
    } else if constexpr (Described<T>) {
      member.describe([&](std::string_view, auto& inner, const Spec& spec) { move(inner, spec.role); });
    }
  }

 private:
  Vec3 origin_;
};

/// Between the material points of the coarsest body, m.
double widest_spacing(const Scenario& scenario) {
  double widest = 0;
  for (const BodyOptions& body : scenario.bodies)
    widest = std::max(widest, body.cell.value_or(scenario.domain.cell) /
                                  std::round(std::pow(body.points_per_cell, 1.0 / scenario.domain.dimension)));
  return widest;
}

}  // namespace

void resolve_defaults(Scenario& scenario) {
  const bool flat = scenario.domain.dimension == 2;
  constexpr double kGravity = 9.81;
  if (!scenario.solver.gravity) scenario.solver.gravity = flat ? Vec3{0, -kGravity, 0} : Vec3{0, 0, -kGravity};
  if (!scenario.output.every) scenario.output.every = scenario.solver.end_time / 20;
  if (!scenario.output.history_every) scenario.output.history_every = *scenario.output.every / 10;
  if (!scenario.output.run_out.threshold) scenario.output.run_out.threshold = scenario.domain.cell;
  for (BodyOptions& body : scenario.bodies)
    if (body.points_per_cell == 0) body.points_per_cell = flat ? 4 : 8;
  for (CompareOptions& compare : scenario.compare) {
    if (compare.name.empty()) compare.name = default_name(compare);
    if (compare.max_distance == 0) compare.max_distance = 10 * scenario.domain.cell;
    if (compare.of_frame() && compare.simulated_spacing == 0) compare.simulated_spacing = widest_spacing(scenario);
  }
}

std::string default_name(const CompareOptions& compare) {
  const std::string pair = compare.simulated + "_" + compare.observed;
  return compare.method == CompareMethod::c2c ? pair : pair + "_" + std::string(name_of(compare.method));
}

void localize_scenario(Scenario& scenario, const Vec3& origin) { Localizer(origin).move(scenario, Role::plain); }

}  // namespace scarp

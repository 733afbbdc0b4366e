// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/node_conditions.hpp"

#include <cmath>

namespace scarp {

double damp_nodes(const NodeStep& step, double factor, int threads) {
  return sum_over_nodes(step.count, threads, [&](std::size_t i) {
    if (!(step.mass[i] > 0)) return 0.0;
    const Vec3 v = step.before[i], trial = step.after[i];
    for (int a = 0; a < 3; ++a)
      if (v[a] != 0) step.after[i][a] -= std::copysign(factor * std::abs(trial[a] - v[a]), v[a]);
    return -work_on_node(step.mass[i], v, trial, step.after[i]);
  });
}

NodeWork act_on_nodes(NodeConditions& conditions, const NodeStep& step, std::vector<std::uint8_t>& held_now,
                      const Vec3& missing_gravity, int threads) {
  NodeWork work;
  NodeLoads& loads = conditions.loads;
  conditions.faces.push(step);
  if (!loads.empty()) {
    loads.begin(step);
    loads.push(step);
    work.external += loads.drive(step);  // first, so that damping does not see the reactions
  }
  if (!conditions.rigid.empty()) {
    conditions.rigid.begin(step);
    work = work + conditions.rigid.act(step);
  }
  if (conditions.damping > 0) work.damping += damp_nodes(step, conditions.damping, threads);
  if (!conditions.faces.empty()) work = work + conditions.faces.act(step, held_now);
  if (!loads.empty()) {
    work.external += loads.drive(step);
    work.external += loads.work_of_push(step);
  }
  if (!conditions.rigid.empty()) work = work + conditions.rigid.act(step);
  work.external += conditions.faces.work_of_push(step);
  if (norm(missing_gravity) > 0)
    work.external += sum_over_nodes(step.count, threads, [&](std::size_t i) {
      return 0.5 * step.dt * step.mass[i] * dot(missing_gravity, step.before[i] + step.after[i]);
    });
  return work;
}

}  // namespace scarp

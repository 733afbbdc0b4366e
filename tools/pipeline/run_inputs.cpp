// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/run_inputs.hpp"

#include "tools/scenario/formula.hpp"
#include "tools/scenario/resolve.hpp"

namespace scarp {

void add_run_inputs(const Project& project, Model& model) {
  Scenario local = project.scenario;
  localize_scenario(local, model.site.origin);
  model.loads = local.loads;
  if (!local.solver.body_force.empty())
    model.body_force = compile_field("solver.body_force", local.solver.body_force, model.site.origin);
}

std::vector<ProbeOptions> local_probes(const Project& project, const Vec3& origin) {
  Scenario local;
  local.probes = project.scenario.probes;
  localize_scenario(local, origin);
  return local.probes;
}

}  // namespace scarp

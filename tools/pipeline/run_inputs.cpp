// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/run_inputs.hpp"

#include "tools/scenario/resolve.hpp"

namespace scarp {

void add_run_inputs(const Project& project, Model& model) {
  Scenario local = project.scenario;
  localize_scenario(local, model.site.origin);
  model.loads = local.loads;
}

}  // namespace scarp

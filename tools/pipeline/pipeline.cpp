// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/pipeline.hpp"

#include "solver/model/write_whole.hpp"
#include "tools/pipeline/provenance.hpp"
#include "tools/pipeline/read_inputs.hpp"
#include "tools/pipeline/refuse_to_overwrite.hpp"
#include "tools/pipeline/write_run.hpp"
#include "tools/render/canvas.hpp"
#include "tools/scenario/read_scenario.hpp"
#include "tools/scenario/resolve.hpp"
#include "tools/scenario/write_scenario.hpp"

namespace scarp {

Project open_project(const std::filesystem::path& scenario_file, const std::vector<std::string>& overrides,
                     const std::filesystem::path& output, int threads, Reporter& reporter) {
  Project project{read_scenario(scenario_file, overrides), {output}, threads, &kernels::best_kernels(), &reporter};
  resolve_defaults(project.scenario);
  return project;
}

namespace {

/// A run that is cut off must not leave an earlier one's model or frames to be taken for its own.
void clear_earlier_results(const Artefacts& artefacts) {
  for (const std::filesystem::path& file : {artefacts.summary(), artefacts.ingest_report(), artefacts.model()})
    std::filesystem::remove(file);
  clear_earlier_run(artefacts);
}

}  // namespace

void record_scenario(const Project& project) {
  refuse_to_overwrite_inputs(project);
  std::string text = "# Resolved scenario: every default is written out.\n# scarp " SCARP_VERSION " (" SCARP_REVISION
                     ") on " +
                     machine() + "\n";
  for (const std::filesystem::path& file : input_files(project.scenario))
    text += "# sha256 " + sha256_of_file(file) + "  " + file.string() + "\n";
  write_whole(project.artefacts.scenario(), text + "\n" + to_toml(project.scenario));
}

Outcome run_project(Project& project) {
  Outcome outcome;
  if (!project.scenario.render.empty()) require_fonts();  // not after hours of solving
  record_scenario(project);
  clear_earlier_results(project.artefacts);
  ingest_stage(project);
  if (!project.scenario.only_surveys()) {
    discretize_stage(project);
    solve_stage(project, outcome);
    render_stage(project);
  }
  if (!outcome.simulation_failed) compare_stage(project, outcome);
  return outcome;
}

}  // namespace scarp

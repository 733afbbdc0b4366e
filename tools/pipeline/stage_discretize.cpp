// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <nlohmann/json.hpp>

#include "solver/model/error.hpp"
#include "solver/model/spare_memory.hpp"
#include "solver/store/model_store.hpp"
#include "tools/pipeline/made_from.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_artefacts.hpp"
#include "tools/pipeline/read_inputs.hpp"
#include "tools/pipeline/stopwatch.hpp"
#include "tools/pipeline/summary.hpp"

namespace scarp {

namespace {

using Json = nlohmann::ordered_json;

std::string volume_sentence(const VolumeReport& report) {
  char text[256];
  std::snprintf(text, sizeof text, "%s: %zu particles, %.6g m3 of %.6g m3 (%+.3f %%)", report.body.c_str(),
                report.particles, report.particle_volume, report.input_volume, 100 * report.relative_difference());
  return text;
}

}  // namespace

void discretize_stage(Project& project) {
  const Stopwatch watch;
  if (project.scenario.only_surveys())
    throw Error("pipeline", "the scenario compares scans and has no bodies to discretize", "", "scarp run");
  project.reporter->begin("discretize");
  require_made_from(project, Maker::ingest);
  const SiteFrame site = read_site(project);
  std::map<std::string, PointCloud> scans;
  for (const std::string& name : scans_of_bodies(project.scenario))
    scans.emplace(name, read_cleaned_scan(project, name, site));
  const Model model = build_model(project, scans, site);
  scans.clear();
  return_spare_memory();
  write_model(project.artefacts.model(), model);

  Json volumes = Json::array();
  for (const VolumeReport& report : model.volumes) {
    volumes.push_back(to_json(report));
    project.reporter->note(volume_sentence(report));
    for (const std::string& warning : warnings(report)) project.reporter->note(warning);
  }
  record_summary(project, "discretize",
                 {{"particles", model.particles.size()}, {"volumes", volumes}, {"wall_s", watch.wall()}});
  record_made_from(project, Maker::discretize);
  project.reporter->end();
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "solver/core/estimate.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_inputs.hpp"
#include "tools/pipeline/run_inputs.hpp"
#include "tools/pipeline/summary.hpp"

namespace scarp {
namespace {

template <class... Arguments>
std::string format(const char* pattern, Arguments... arguments) {
  char text[512];
  std::snprintf(text, sizeof text, pattern, arguments...);
  return text;
}

void describe_body(const VolumeReport& report, std::vector<std::string>& facts) {
  facts.push_back(format("body %s: %zu particles in %zu cells, %.6g m3 of %.6g m3 (%+.3f %%)", report.body.c_str(),
                         report.particles, report.cells, report.particle_volume, report.input_volume,
                         100 * report.relative_difference()));
  for (const std::string& warning : warnings(report)) facts.push_back("  " + warning);
}

void describe_run(const Project& project, Model model, std::vector<std::string>& facts) {
  add_run_inputs(project, model);
  for (const std::string& sentence : describe_shaking(project, model)) facts.push_back(sentence);
  for (const VolumeReport& report : model.volumes) describe_body(report, facts);
  const RunEstimate estimated = estimate(model, project.scenario.solver, project.scenario.output);
  facts.push_back(format("domain: %.6g x %.6g x %.6g m, cell %.6g m", model.domain.max[0] - model.domain.min[0],
                         model.domain.max[1] - model.domain.min[1], model.domain.max[2] - model.domain.min[2],
                         model.domain.cell));
  facts.push_back(format("time step: about %.4g s, %.12g steps to %.6g s, %.3g particle-steps", estimated.time_step,
                         estimated.steps, project.scenario.solver.end_time, estimated.particle_steps));
  facts.push_back(format("memory: about %.0f MiB while solving", estimated.memory_bytes / (1024.0 * 1024.0)));
}

}  // namespace

std::vector<std::string> check_project(Project& project) {
  std::vector<std::string> facts;
  project.reporter->begin("check");
  std::map<std::string, PointCloud> scans;
  const std::vector<std::string> needed = scans_of_bodies(project.scenario);
  const SiteFrame site = for_each_cleaned_scan(project, [&](const ScanOptions& scan, IngestResult result) {
    facts.push_back(format("scan %s: %zu points read, %zu kept", scan.name.c_str(), result.report.points_read,
                           result.report.points_kept));
    if (std::find(needed.begin(), needed.end(), scan.name) != needed.end())
      scans.emplace(scan.name, std::move(result.cloud));
  });
  facts.push_back(format("origin: %.0f %.0f %.0f", site.origin[0], site.origin[1], site.origin[2]));
  if (!project.scenario.only_surveys()) describe_run(project, build_model(project, scans, site), facts);
  project.reporter->end();
  return facts;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "solver/core/run.hpp"
#include "tools/pipeline/made_from.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_artefacts.hpp"
#include "tools/pipeline/run_inputs.hpp"
#include "tools/pipeline/summary.hpp"
#include "tools/pipeline/write_run.hpp"

namespace scarp {
namespace {

using Json = nlohmann::ordered_json;

Json failure_json(const RunReport& report, const Vec3& site_position) {
  if (!report.failed) return nullptr;
  return {{"what", report.failure.what},
          {"step", report.failure.step},
          {"time_s", report.failure.time},
          {"particle", report.failure.particle},
          {"position_m", to_json(site_position)}};
}

std::size_t outside_domain(const Model& model) {
  const Domain& domain = model.domain;
  const auto outside = [&](const Vec3& position) {
    for (int a = 0; a < domain.dimension; ++a)
      if (position[a] < domain.min[a] - 0.5 * domain.cell || position[a] > domain.max[a] + 0.5 * domain.cell)
        return true;
    return false;
  };
  return static_cast<std::size_t>(
      std::count_if(model.particles.position.begin(), model.particles.position.end(), outside));
}

Json forms_json(const RunReport& report) {
  Json forms = Json::array();
  for (const BodyForm& form : report.forms) {
    Json entry{{"body", form.body}, {"form", form.obstacle.empty() ? "nodal" : "particle-state"}};
    if (!form.obstacle.empty()) entry["because"] = form.obstacle;
    forms.push_back(std::move(entry));
  }
  return forms;
}

Json solver_json(const RunReport& report, const Stopwatch& watch, const RunWriter& writer, const Vec3& failed_at) {
  const double wall = watch.wall() - writer.wall(), processor = watch.processor() - writer.processor();
  const double particle_steps = static_cast<double>(std::max<std::int64_t>(report.particle_steps, 1));
  return {{"status", report.failed ? "failed" : "completed"},
          {"failure", failure_json(report, failed_at)},
          {"steps", report.steps},
          {"particle_steps", report.particle_steps},
          {"wall_ns_per_particle_step", 1e9 * wall / particle_steps},
          {"cpu_ns_per_particle_step", 1e9 * processor / particle_steps},
          {"instruction_set", report.instruction_set},
          {"total_lagrangian_bodies", forms_json(report)},
          {"end_time_s", report.end_time},
          {"smallest_dt_s", report.smallest_dt},
          {"largest_dt_s", report.largest_dt},
          {"largest_displacement_m", report.largest_displacement},
          {"largest_kinetic_J", report.largest_kinetic},
          {"largest_energy_error_J", report.largest_energy_error},
          {"first", to_json(report.first)},
          {"last", to_json(report.last)},
          {"frames", writer.frames()},
          {"solve_wall_s", wall},
          {"output_wall_s", writer.wall()}};
}

}  // namespace

void solve_stage(Project& project, Outcome& outcome) {
  project.reporter->begin("solve");
  require_made_from(project, Maker::discretize);
  Model model = read_discretized(project);
  add_run_inputs(project, model);
  // Before the first frame, so that frames of a run that was cut off are known for what they are.
  record_summary(project, "solver", {{"status", "running"}});
  record_made_from(project, Maker::solver);
  RunWriter writer(project);
  const Stopwatch watch;
  // Waiting for each other costs threads more than a small model's sweeps; the bits are the same.
  const int threads = model.particles.size() < 20'000 ? 1 : project.threads;
  const RunReport report =
      run(model, project.scenario.solver, project.scenario.output, writer, threads, *project.kernels);
  writer.finish();

  outcome.simulation_failed = report.failed;
  outcome.failure = report.failure;
  outcome.failure_site = report.failure.position + model.site.origin;
  record_summary(project, "solver", solver_json(report, watch, writer, outcome.failure_site));
  char text[200];
  std::snprintf(text, sizeof text, "%lld steps of %zu particles, largest displacement %.4g m",
                static_cast<long long>(report.steps), model.particles.size(), report.largest_displacement);
  project.reporter->note(text);
  if (const std::size_t outside = outside_domain(model); outside > 0)
    project.reporter->note(std::to_string(outside) +
                           " particles ended outside the domain: its faces hold only what "
                           "stood on them at the start");
  project.reporter->end();
}

}  // namespace scarp

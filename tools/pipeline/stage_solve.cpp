// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <nlohmann/json.hpp>

#include "solver/core/run.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_artefacts.hpp"
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

Json solver_json(const RunReport& report, const Stopwatch& watch, const RunWriter& writer, const Vec3& failed_at) {
  const double wall = watch.wall() - writer.wall(), processor = watch.processor() - writer.processor();
  const double particle_steps = static_cast<double>(std::max<std::int64_t>(report.particle_steps, 1));
  return {{"status", report.failed ? "failed" : "completed"},
          {"failure", failure_json(report, failed_at)},
          {"steps", report.steps},
          {"particle_steps", report.particle_steps},
          {"wall_ns_per_particle_step", 1e9 * wall / particle_steps},
          {"cpu_ns_per_particle_step", 1e9 * processor / particle_steps},
          {"instruction_set", "x86-64 baseline"},
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
  Model model = read_discretized(project);
  RunWriter writer(project);
  const Stopwatch watch;
  const RunReport report = run(model, project.scenario.solver, project.scenario.output, writer, project.threads);
  writer.finish();

  outcome.simulation_failed = report.failed;
  outcome.failure = report.failure;
  outcome.failure_site = report.failure.position + model.site.origin;
  record_summary(project, "solver", solver_json(report, watch, writer, outcome.failure_site));
  char text[200];
  std::snprintf(text, sizeof text, "%lld steps of %zu particles, largest displacement %.4g m",
                static_cast<long long>(report.steps), model.particles.size(), report.largest_displacement);
  project.reporter->note(text);
  project.reporter->end();
}

}  // namespace scarp

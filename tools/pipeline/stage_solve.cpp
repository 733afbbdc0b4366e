// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "solver/core/run.hpp"
#include "solver/model/spare_memory.hpp"
#include "tools/pipeline/made_from.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/read_artefacts.hpp"
#include "tools/pipeline/run_inputs.hpp"
#include "tools/pipeline/run_out_json.hpp"
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

/// Null where the run ended before its state was looked at.
Json step_limit_json(const StepLimit& limit, const Model& model) {
  if (limit.body < 0) return nullptr;
  return {{"time_step_s", limit.time_step},
          {"time_s", limit.time},
          {"body", model.bodies[limit.body].name},
          {"material", model.materials[limit.material].name},
          {"particle", limit.particle},
          {"position_m", to_json(limit.position + model.site.origin)},
          {"wave_speed_m_s", limit.wave_speed},
          {"particle_speed_m_s", limit.particle_speed}};
}

/// The largest departure of the total energy from that at the start, over the largest energy that moved: kinetic,
/// strain, plastic and what was dissipated. Null where nothing moved.
Json relative_energy_error(const RunReport& report) {
  if (!(report.largest_energy > 0)) return nullptr;
  return report.largest_energy_error / report.largest_energy;
}

Json forms_json(const RunReport& report) {
  Json forms = Json::array();
  for (const BodyForm& form : report.forms) {
    Json entry{{"body", form.body}, {"form", form.obstacle.empty() ? "nodal" : "particle-state"}};
    if (!form.obstacle.empty()) entry["because"] = form.obstacle;
    entry["reference_updates"] = form.reference_updates;
    forms.push_back(std::move(entry));
  }
  return forms;
}

Json solver_json(const RunReport& report, const Model& model, const Stopwatch& watch, RunWriter& writer) {
  const double wall = watch.wall() - writer.wall(), processor = watch.processor() - writer.processor();
  const double particle_steps = static_cast<double>(std::max<std::int64_t>(report.particle_steps, 1));
  return {{"status", report.failed ? "failed" : "completed"},
          {"failure", failure_json(report, report.failure.position + model.site.origin)},
          {"steps", report.steps},
          {"particle_steps", report.particle_steps},
          {"wall_ns_per_particle_step", 1e9 * wall / particle_steps},
          {"cpu_ns_per_particle_step", 1e9 * processor / particle_steps},
          {"instruction_set", report.instruction_set},
          {"total_lagrangian_bodies", forms_json(report)},
          {"end_time_s", report.end_time},
          {"smallest_dt_s", report.smallest_dt},
          {"largest_dt_s", report.largest_dt},
          {"time_step_limit", step_limit_json(report.step_limit, model)},
          {"largest_displacement_m", report.largest_displacement},
          {"largest_kinetic_J", report.largest_kinetic},
          {"largest_energy_error_J", report.largest_energy_error},
          {"largest_energy_J", report.largest_energy},
          {"relative_energy_error", relative_energy_error(report)},
          {"angular_momentum_about_m", to_json(report.reference_centre + model.site.origin)},
          {"first", to_json(report.first)},
          {"last", to_json(report.last)},
          {"probes", writer.probes().summary(model)},
          {"frames", writer.frames()},
          {"solve_wall_s", wall},
          {"output_wall_s", writer.wall()}};
}

void note_step_limit(const StepLimit& limit, const Model& model, Reporter& reporter) {
  if (limit.body < 0) return;
  const Vec3 at = limit.position + model.site.origin;
  char text[300];
  std::snprintf(text, sizeof text,
                "time step down to %.4g s, by particle %lld at (%.6g, %.6g, %.6g), wave speed %.4g m/s, of body ",
                limit.time_step, static_cast<long long>(limit.particle), at[0], at[1], at[2], limit.wave_speed);
  reporter.note(text + model.bodies[limit.body].name + ", material " + model.materials[limit.material].name);
}

void record_run_out(const Project& project, const Model& model, const RunReport& report, const RunOut& run_out) {
  if (report.failed) return record_summary(project, "run_out", {{"why_null", "the simulation failed"}});
  record_summary(project, "run_out", run_out_json(run_out, model.site.origin));
}

}  // namespace

void solve_stage(Project& project, Outcome& outcome) {
  project.reporter->begin("solve");
  require_made_from(project, Maker::discretize);
  return_spare_memory();
  Model model = read_discretized(project);
  add_run_inputs(project, model);
  for (const std::string& sentence : describe_shaking(project, model)) project.reporter->note(sentence);
  // Before the first frame, so that frames of a run that was cut off are known for what they are.
  record_summary(project, "solver", {{"status", "running"}});
  record_made_from(project, Maker::solver);
  record_shaking(project, model);
  RunWriter writer(project, model);
  const Stopwatch watch;
  // Waiting for each other costs threads more than a small model's sweeps; the bits are the same.
  const int threads = model.particles.size() < 20'000 ? 1 : project.threads;
  const RunReport report =
      run(model, project.scenario.solver, project.scenario.output, writer, threads, *project.kernels);
  writer.finish();

  outcome.simulation_failed = report.failed;
  outcome.failure = report.failure;
  outcome.failure_site = report.failure.position + model.site.origin;
  record_summary(project, "solver", solver_json(report, model, watch, writer));
  record_run_out(project, model, report, writer.run_out());
  char text[200];
  std::snprintf(text, sizeof text, "%lld steps of %zu particles, largest displacement %.4g m",
                static_cast<long long>(report.steps), model.particles.size(), report.largest_displacement);
  project.reporter->note(text);
  note_step_limit(report.step_limit, model, *project.reporter);
  if (writer.outside() > 0)
    project.reporter->note(std::to_string(writer.outside()) +
                           " particles ended outside the domain: its faces hold only what "
                           "stood on them at the start");
  project.reporter->end();
}

}  // namespace scarp

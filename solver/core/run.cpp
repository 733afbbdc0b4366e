// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "solver/core/check_model.hpp"
#include "solver/core/diagnostics.hpp"
#include "solver/core/formulations.hpp"
#include "solver/core/initial_state.hpp"
#include "solver/core/output_clock.hpp"
#include "solver/model/spare_memory.hpp"

namespace scarp {
namespace {

/// Below this share of the first step the run would not end in any useful time.
constexpr double kCollapse = 1e-6;

struct Run {
  Run(Model& m, const SolverOptions& options, const OutputOptions& output, FrameSink& s,
      const kernels::Kernels& kernels, int t)
      : model(m),
        sink(s),
        threads(std::max(1, t)),
        method(m, options, t, kernels),
        diagnostics(m, method.rigid()),
        clock(output, options.end_time) {}

  HistorySample sample(double dt) {
    HistorySample sample = method.measure(diagnostics);
    sample.time = method.time();
    sample.step = report.steps;
    sample.dt = dt;
    add_work(sample, method.work());
    return sample;
  }

  void record(double dt) {
    const HistorySample now = sample(dt);
    if (report.steps == 0) report.first = now;
    report.last = now;
    report.largest_energy_error = std::max(report.largest_energy_error, std::abs(now.total - report.first.total));
    report.largest_kinetic = std::max(report.largest_kinetic, now.kinetic);
    report.largest_energy =
        std::max(report.largest_energy, now.kinetic + now.strain + now.plastic + now.friction + now.damping);
    sink.sample(now);
    if (!sink.watches()) return;
    method.write_particles();
    sink.look(model, now);
  }

  void record_step_limit() {
    const StepLimit now = method.step_limit();
    if (!(now.time_step > 0)) return;  // a state that is not finite: its failure says so
    if (report.step_limit.body < 0 || now.time_step < report.step_limit.time_step) report.step_limit = now;
  }

  void record_frame() {
    record_step_limit();
    if (!sink.takes_blocks()) method.write_particles();
    sink.frame(model, method.states(), method.time(), report.steps);
  }

  void record_what_is_due(double dt) {
    const double time = method.time();
    const bool frame = clock.frame_due(time);
    if (frame || clock.sample_due(time)) record(dt);
    if (clock.sample_due(time)) clock.sample_done();
    if (!frame) return;
    clock.frame_done();
    record_frame();
  }

  void fail(Failure failure) {
    failure.step = report.steps;
    failure.time = method.time();
    report.failed = true;
    report.failure = std::move(failure);
  }

  Model& model;
  FrameSink& sink;
  int threads;
  Formulations method;
  Diagnostics diagnostics;
  OutputClock clock;
  RunReport report;
};

/// No machine takes this many steps; the parameters are a slip.
void refuse_endless(double end_time, double first_step) {
  constexpr double most_steps = 1e12;
  if (first_step > 0 && end_time / first_step > most_steps)
    throw Error("solve", "the first time step would be " + shortest(first_step) + " s, too short for the end time",
                shortest(end_time / first_step) + " steps",
                "at most 1e12 steps: softer materials, larger cells or a shorter end time");
}

/// Why no further step can be taken, if so.
std::optional<Failure> obstacle(Run& run, std::int64_t max_steps, double stable, double first_stable) {
  if (auto failure = run.method.failure()) return failure;
  if (run.report.steps >= max_steps) return Failure{.what = "max_steps reached before the end time"};
  if (!(stable > kCollapse * first_stable)) return run.method.collapse("the time step has collapsed");
  return std::nullopt;
}

void report_forms(Run& run, const kernels::Kernels& kernels) {
  run.report.instruction_set = kernels.name;
  const std::vector<std::string> obstacles = run.method.obstacles();
  std::size_t next = 0;
  for (const Body& body : run.model.bodies)
    if (body.formulation == Formulation::total_lagrangian) run.report.forms.push_back({body.name, obstacles[next++]});
}

void finish(Run& run) {
  const ParticleStates states = run.method.states();
  if (!run.sink.takes_blocks()) run.method.write_particles();
  run.report.particle_steps = run.report.steps * static_cast<std::int64_t>(deforming_particles(run.model));
  run.report.end_time = run.method.time();
  run.report.reference_centre = run.diagnostics.reference_centre();
  run.report.largest_displacement = largest_displacement(states);
  const std::vector<std::int64_t> moves = run.method.reference_updates();
  for (std::size_t b = 0; b < run.report.forms.size(); ++b) run.report.forms[b].reference_updates = moves[b];
  run.sink.end(run.model, states);
}

}  // namespace

RunReport run(Model& model, const SolverOptions& options, const OutputOptions& output, FrameSink& sink, int threads,
              const kernels::Kernels& kernels) {
  check_options(output);
  Run run(model, options, output, sink, kernels, threads);
  Formulations& method = run.method;
  report_forms(run, kernels);
  refuse_endless(options.end_time, method.stable_time_step());
  if (auto failure = relax(method, model, options)) run.fail(*failure);
  if (sink.takes_blocks() && !sink.watches() && method.all_nodal()) drop_state(model.particles);
  return_spare_memory();
  const double first_stable = method.stable_time_step();
  if (!run.report.failed && !method.failure()) {
    run.record(0);
    run.record_frame();
  }
  while (!run.report.failed && method.time() < options.end_time) {
    const double stable = method.stable_time_step();
    if (auto failure = obstacle(run, options.max_steps, stable, first_stable)) {
      run.fail(*failure);
      run.record_step_limit();
      break;
    }
    const double dt = run.clock.clip(method.time(), stable);
    const double time = run.clock.after(method.time(), dt);
    method.step(dt);
    method.set_time(time);
    RunReport& report = run.report;
    ++report.steps;
    report.smallest_dt = report.steps == 1 ? dt : std::min(report.smallest_dt, dt);
    report.largest_dt = std::max(report.largest_dt, dt);
    if (auto failure = method.failure()) {
      run.fail(*failure);
      break;
    }
    sink.progress(time, options.end_time, report.steps, dt);
    run.record_what_is_due(dt);
  }
  finish(run);
  return run.report;
}

}  // namespace scarp

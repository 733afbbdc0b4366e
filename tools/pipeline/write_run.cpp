// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/write_run.hpp"

#include <algorithm>

#include "solver/core/make_frame.hpp"
#include "solver/core/step_options.hpp"
#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "solver/store/frame_store.hpp"
#include "tools/pipeline/run_inputs.hpp"

namespace scarp {

namespace fs = std::filesystem;

namespace {

std::size_t outside_domain(const ParticleStates& states, const Domain& domain) {
  const auto outside = [&](const Vec3& position) {
    for (int a = 0; a < domain.dimension; ++a)
      if (position[a] < domain.min[a] - 0.5 * domain.cell || position[a] > domain.max[a] + 0.5 * domain.cell)
        return true;
    return false;
  };
  std::ptrdiff_t count = 0;
  states.each_block(
      [&](const Particles& block) { count += std::count_if(block.position.begin(), block.position.end(), outside); });
  return static_cast<std::size_t>(count);
}

}  // namespace

void clear_earlier_run(const Artefacts& artefacts) {
  fs::remove(artefacts.series());
  fs::remove(artefacts.history());
  clear_earlier_probes(artefacts);
  if (!fs::exists(artefacts.frames())) return;
  std::vector<fs::path> stale;
  for (const fs::directory_entry& entry : fs::directory_iterator(artefacts.frames()))
    if (entry.path().filename().string().rfind("frame_", 0) == 0) stale.push_back(entry.path());
  for (const fs::path& path : stale) fs::remove(path);
}

RunWriter::RunWriter(const Project& project, const Model& model)
    : project_(project), origin_(model.site.origin), probes_(local_probes(project, origin_), model) {
  clear_earlier_run(project.artefacts);
  history_ =
      "time,step,dt,kinetic,strain,plastic,potential,total,momentum_x,momentum_y,momentum_z,friction,damping,"
      "external,angular_momentum_x,angular_momentum_y,angular_momentum_z,centre_x,centre_y,centre_z";
  has_contact_ = model.contact.method != ContactMethod::none;
  if (has_contact_) history_ += ",contact";
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!reports_contact_force(model, model.bodies[b])) continue;
    force_columns_.push_back(b);
    for (const char axis : {'x', 'y', 'z'})
      history_ += std::string(",contact_force_") + axis + "_" + model.bodies[b].name;
  }
  history_ += '\n';
}

void RunWriter::frame(const Model& model, const ParticleStates& states, double time, std::int64_t step) {
  const Stopwatch watch;
  const fs::path path = project_.artefacts.frame(static_cast<std::int64_t>(series_.size()));
  const OutputOptions& output = project_.scenario.output;
  write_frame(path, states.count, [&](const auto& append) {
    states.each_block(
        [&](const Particles& block) { append(make_frame(model, block, output.fields, time, step, output.absolute)); });
  });
  series_.emplace_back((fs::path("frames") / path.filename()).string(), time);
  write_series(project_.artefacts.series(), series_);
  write_whole(project_.artefacts.history(), history_);
  probes_.write(project_.artefacts);
  wall_ += watch.wall();
  processor_ += watch.processor();
}

void RunWriter::sample(const HistorySample& sample) {
  const auto append = [&](double value, char end) {
    history_ += shortest(value);
    history_ += end;
  };
  append(sample.time, ',');
  history_ += std::to_string(sample.step) + ',';
  const Vec3 &L = sample.angular_momentum, centre = sample.centre + origin_;
  for (double value : {sample.dt, sample.kinetic, sample.strain, sample.plastic, sample.potential, sample.total,
                       sample.momentum[0], sample.momentum[1], sample.momentum[2], sample.friction, sample.damping,
                       sample.external, L[0], L[1], L[2], centre[0], centre[1]})
    append(value, ',');
  append(centre[2], ',');
  if (has_contact_) append(sample.contact, ',');
  for (const std::size_t body : force_columns_)
    for (double value : sample.contact_force[body]) append(value, ',');
  history_.back() = '\n';
}

void RunWriter::look(const Model& model, const HistorySample& sample) {
  const Stopwatch watch;
  probes_.look(model, sample.time);
  wall_ += watch.wall();
  processor_ += watch.processor();
}

void RunWriter::progress(double time, double end_time, std::int64_t, double) {
  project_.reporter->progress(time / end_time);
}

void RunWriter::end(const Model& model, const ParticleStates& states) {
  const Stopwatch watch;
  outside_ = outside_domain(states, model.domain);
  run_out_ = measure_run_out(states, model.domain, gravity_of(project_.scenario.solver, model.domain.dimension),
                             project_.scenario.output.run_out);
  wall_ += watch.wall();
  processor_ += watch.processor();
}

void RunWriter::finish() {
  write_whole(project_.artefacts.history(), history_);
  probes_.write(project_.artefacts);
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/step_total.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/apic.hpp"
#include "solver/core/averaged_stress.hpp"
#include "solver/core/body_force.hpp"
#include "solver/core/check_model.hpp"
#include "solver/core/diagnostics.hpp"
#include "solver/core/moving_reference.hpp"
#include "solver/core/shaking.hpp"
#include "solver/core/step_limit.hpp"
#include "solver/core/stress.hpp"
#include "solver/core/total_loads.hpp"
#include "solver/core/transfer.hpp"
#include "solver/core/xpic.hpp"
#include "solver/model/error.hpp"
#include "solver/model/spare_memory.hpp"

namespace scarp {
namespace {

/// See stable_time_step.
constexpr int kStepsPerLook = 4;

void collect(const StressOutcome& outcome, double cell, double& fastest, std::int64_t& bad_particle) {
  fastest = std::max(fastest, std::sqrt(outcome.largest_wave_speed_squared) / cell);
  if (bad_particle < 0) bad_particle = outcome.bad_particle;
}

NodeStep nodes_of(TotalBody& body, double dt, double time) {
  return {
      body.grid.nodes.size(), body.grid.node_mass.data(), body.velocity.data(), body.velocity_updated.data(), dt, time};
}

template <class T>
void give_back(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

/// What only contact and sweeps over particles ask for: before a body becomes nodal, and after.
void forget_corners(TotalBody& body) {
  give_back(body.grid.cell_nodes);
  give_back(body.grid.around);
  give_back(body.grid.around_begin);
  give_back(body.tasks);
  give_back(body.node_positions);
}
void forget_grid(TotalBody& body) {
  ReferenceGrid bare;
  bare.dimension = body.grid.dimension;
  bare.cell = body.grid.cell;
  body.grid = std::move(bare);
}

}  // namespace

TotalLagrangian::TotalLagrangian(Model& model, const SolverOptions& options, int threads,
                                 const kernels::Kernels& kernels, RigidBodies* rigid)
    : body_force(model.body_force),
      model_(model),
      options_(options, model.domain.dimension, model.shaking),
      threads_(std::max(1, threads)),
      reference_update_(options.reference_update) {
  check_model(model);
  check_options(options, model.domain.dimension);
  sort_by_cell(model);
  for (const NamedMaterial& material : model.materials) laws_.push_back(prepare(material.law));
  for (const Body& body : model.bodies)
    if (body.formulation == Formulation::total_lagrangian) bodies_.push_back(make_bare_body(model, body));
  set_loads(bodies_, model);
  if (rigid) set_grips(*rigid);
  for (TotalBody& body : bodies_) body.conditions.damping = options_.damping;
  choose_back_ends(options, kernels);
  return_spare_memory();  // the grids that nodal bodies have forgotten
  reference_updates_.assign(bodies_.size(), 0);
  map_state();
}

void TotalLagrangian::set_grips(RigidBodies& rigid) {
  for (std::size_t r = 0; r < rigid.size(); ++r)
    for (TotalBody& body : bodies_) {
      const Body& gripped = model_.bodies[model_.particles.body[body.begin]];
      const Body& holder = model_.bodies[rigid[r].body];
      const std::vector<std::string>& names = holder.rigid.grips;
      if (std::find(names.begin(), names.end(), gripped.name) == names.end()) continue;
      if (body.conditions.rigid.grip(rigid, r, body.node_positions, body.grid.cell) == 0)
        throw Error("solve", "nodes of body '" + gripped.name + "' that rigid body '" + holder.name + "' grips", "none",
                    "at least one that lies in it or on its surface");
    }
}

std::optional<std::string> TotalLagrangian::obstacle(const SolverOptions& options, const TotalBody& body,
                                                     const kernels::Kernels& kernels) const {
  if (options.back_end == BackEnd::particle_state) return "asked for";
  if (kernels.lanes == 1) return "there are no kernels";
  if (reference_update_) return "its reference configuration moves";
  if (options.transfer != Transfer::flip)
    return "transfer = \"" + std::string(name_of(options.transfer)) + "\" goes through the particles";
  return NodalBody::obstacle(model_, body, options.anti_locking == AntiLocking::f_bar);
}

void TotalLagrangian::choose_back_ends(const SolverOptions& options, const kernels::Kernels& kernels) {
  const bool average = options.anti_locking == AntiLocking::f_bar;
  for (TotalBody& body : bodies_) {
    const std::optional<std::string> why_not = obstacle(options, body, kernels);
    obstacles_.push_back(why_not.value_or(""));
    if (why_not) {
      complete_state(model_.particles);
      make_room_for_sweeps(body, model_, model_.bodies[model_.particles.body[body.begin]]);
      if (average) average_volumes(body, model_.particles);
      use_kernels(body, model_, kernels);
      nodal_.push_back(nullptr);
      continue;
    }
    const bool contact = model_.contact.method != ContactMethod::none;
    if (!contact) forget_corners(body);
    nodal_.push_back(std::make_unique<NodalBody>(model_, body, average, kernels));
    if (!contact) forget_grid(body);
  }
}

void TotalLagrangian::map_state() {
  fastest_ = 0;
  since_look_ = 0;
  particles_current_ = false;
  bad_particle_ = -1;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    TotalBody& body = bodies_[b];
    if (nodal_[b]) {
      nodal_[b]->restart(model_.particles, threads_);
      collect(nodal_[b]->outcome(), body.grid.cell, fastest_, bad_particle_);
      continue;
    }
    collect(map_body(body), body.grid.cell, fastest_, bad_particle_);
  }
}

StressOutcome TotalLagrangian::map_body(TotalBody& body) {
  if (options_.transfer == Transfer::apic)
    begin_affine(model_.particles, body, threads_);  // (1), (2)
  else
    map_momentum(model_.particles, body, threads_);                // (1)
  find_node_velocities(body, threads_);                            // (2)
  return map_stress(model_.particles, body, body.laws, threads_);  // (1)
}

/// What a step has stretched too far. fastest_ becomes the larger of the values before and after.
void TotalLagrangian::move_references() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    TotalBody& body = bodies_[b];
    if (!is_past_limit(model_.particles, body, *reference_update_, threads_)) continue;
    if (const auto lost = move_reference(model_, body)) {
      lost_particle_ = static_cast<std::int64_t>(*lost);
      return;
    }
    ++reference_updates_[b];
    collect(map_body(body), body.grid.cell, fastest_, bad_particle_);
  }
}

double TotalLagrangian::kinetic_energy_of_nodes() const {
  double sum = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    sum += nodal_[b] ? nodal_[b]->kinetic_energy_of_nodes(threads_)
                     : scarp::kinetic_energy_of_nodes(bodies_[b].grid.node_mass, bodies_[b].velocity, threads_);
  return sum;
}

void TotalLagrangian::write_particles() {
  if (particles_current_) return;
  particles_current_ = true;
  complete_state(model_.particles);
  for (const auto& body : nodal_)
    if (body) body->write(model_.particles, threads_);
}

void TotalLagrangian::write_particles(Particles& block, std::size_t begin, std::size_t end) const {
  for (const auto& body : nodal_)
    if (body) body->write(block, begin, end, threads_);
}

bool TotalLagrangian::all_nodal() const {
  return std::all_of(nodal_.begin(), nodal_.end(), [](const auto& body) { return body != nullptr; });
}

HistorySample TotalLagrangian::measure(const Vec3& about) const {
  HistorySample sum;
  for (const auto& body : nodal_) {
    const HistorySample part = body->measure(options_.gravity, about, threads_);
    add(sum, part);
    sum.angular_momentum = sum.angular_momentum + part.angular_momentum;
    sum.centre = sum.centre + part.centre;
  }
  return sum;
}

AffineMotion TotalLagrangian::affine_motion() const {
  AffineMotion sum;
  for (const TotalBody& body : bodies_)
    if (!body.affine.empty()) sum = sum + measure_affine(model_.particles, body, threads_);
  return sum;
}

double TotalLagrangian::stable_time_step() const {
  return bad_particle_ < 0 && fastest_ > 0 && std::isfinite(fastest_) ? options_.courant / fastest_ : 0;
}

StepLimit TotalLagrangian::step_limit() const {
  StepLimit limit;
  double most = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const TotalBody& body = bodies_[b];
    const StepLimit of_body = nodal_[b] ? nodal_[b]->step_limit() : find_step_limit(model_.particles, body);
    if (limit.body >= 0 && !(of_body.wave_speed / body.grid.cell > most)) continue;
    limit = of_body;
    most = of_body.wave_speed / body.grid.cell;
  }
  limit.time_step = stable_time_step();
  return limit;
}

void TotalLagrangian::find_accelerations() {
  const Particles& particles = model_.particles;
  accelerations_.resize(particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p)
    accelerations_[p] = body_force(particles.reference_position[p], relaxing_ ? 0 : time_);
}

StressOutcome TotalLagrangian::step_nodal(NodalBody& body, const Vec3& gravity, double dt, bool find_speed) {
  if (body_force) {
    body.add_body_force(model_.particles, accelerations_);
    work_.external -= body.body_force_times_displacement();
  }
  work_ = work_ +
          body.step({time_, dt, gravity, gravity - options_.gravity, options_.flip_share(dt), find_speed}, threads_);
  if (body_force) work_.external += body.body_force_times_displacement();
  return body.outcome();
}

StressOutcome TotalLagrangian::step_particles(TotalBody& body, const Vec3& gravity, double dt, bool find_speed) {
  Particles& particles = model_.particles;
  if (body_force) add_body_force(particles, body, accelerations_);  // (1)
  if (model_.water) map_water_force(particles, body, *model_.water, options_.ramp(time_, dt), threads_);
  advance_nodes(body, gravity, dt, threads_);  // (2)
  work_ = work_ +
          act_on_nodes(body.conditions, nodes_of(body, dt, time_), body.held_now, gravity - options_.gravity, threads_);
  if (body_force) work_.external += work_of_body_force(particles, body, accelerations_, dt);
  if (options_.transfer == Transfer::xpic) {
    body.kept = body.held_now;
    body.conditions.loads.add_imposed_axes(body.kept);
    body.conditions.rigid.add_axes(body.kept);
    filter_velocities(particles, body, options_.xpic_order, threads_);  // (3)
  }
  advance_particles(particles, body, options_.velocity_update(dt), dt, threads_);      // (3), (1)
  if (options_.transfer == Transfer::apic) advance_affine(particles, body, threads_);  // (3), (1)
  find_node_velocities(body, threads_);                                                // (5), (2)
  body.conditions.loads.hold(body.velocity);
  body.conditions.rigid.hold(body.velocity);
  for (std::size_t i = 0; i < body.displacement.size(); ++i)
    body.displacement[i] = body.displacement[i] + dt * body.velocity[i];
  return update_stress(particles, body, body.laws, dt, threads_, find_speed);  // (5), (6), (1)
}

std::int64_t TotalLagrangian::step(double dt) {
  const Vec3 gravity = options_.gravity_at(time_, dt);
  if (body_force) find_accelerations();
  const bool look = ++since_look_ == kStepsPerLook;
  const double last_fastest = fastest_;
  if (look) since_look_ = 0;
  for (TotalBody& body : bodies_) send_waves(body.conditions.faces, model_.shaking, time_, dt);
  fastest_ = 0;
  bad_particle_ = -1;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    collect(nodal_[b] ? step_nodal(*nodal_[b], gravity, dt, look) : step_particles(bodies_[b], gravity, dt, look),
            bodies_[b].grid.cell, fastest_, bad_particle_);
  if (!look) fastest_ = last_fastest;
  if (look && reference_update_ && !relaxing_ && bad_particle_ < 0) move_references();
  particles_current_ = false;
  time_ += dt;
  return bad_particle_;
}

void TotalLagrangian::begin_relaxing(double damping) {
  relaxing_ = true;
  options_.begin_relaxing();
  complete_state(model_.particles);
  start_velocity_ = model_.particles.velocity;
  std::fill(model_.particles.velocity.begin(), model_.particles.velocity.end(), Vec3{0, 0, 0});
  for (TotalBody& body : bodies_) {
    body.conditions.damping = damping;
    body.conditions.faces.hold_still(true);
    body.conditions.loads.hold_still(true);
  }
  map_state();
}

void TotalLagrangian::rest() {
  relaxing_ = false;
  model_.particles.velocity = std::move(start_velocity_);
  model_.particles.position = model_.particles.reference_position;
  for (TotalBody& body : bodies_) {
    body.conditions.damping = options_.damping;
    body.conditions.faces.hold_still(false);
    body.conditions.loads.hold_still(false);
    body.held_now = body.held;
  }
  map_state();
  options_.rest();
  work_ = {};
  time_ = 0;
}

}  // namespace scarp

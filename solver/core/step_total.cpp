// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/step_total.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/averaged_stress.hpp"
#include "solver/core/check_model.hpp"
#include "solver/core/stress.hpp"
#include "solver/core/total_loads.hpp"
#include "solver/core/transfer.hpp"

namespace scarp {
namespace {

void collect(const StressOutcome& outcome, double cell, double& fastest, std::int64_t& bad_particle) {
  fastest = std::max(fastest, std::sqrt(outcome.largest_wave_speed_squared) / cell);
  if (bad_particle < 0) bad_particle = outcome.bad_particle;
}

NodeStep nodes_of(TotalBody& body, double dt, double time) {
  return {
      body.grid.nodes.size(), body.grid.node_mass.data(), body.velocity.data(), body.velocity_updated.data(), dt, time};
}

}  // namespace

TotalLagrangian::TotalLagrangian(Model& model, const SolverOptions& options, int threads)
    : model_(model), options_(options, model.domain.dimension), threads_(std::max(1, threads)) {
  check_model(model);
  check_options(options, model.domain.dimension);
  sort_by_cell(model);
  for (const NamedMaterial& material : model.materials) laws_.push_back(prepare(material.law));
  for (const Body& body : model.bodies)
    if (body.formulation == Formulation::total_lagrangian) bodies_.push_back(make_total_body(model, body));
  set_loads(bodies_, model);
  for (TotalBody& body : bodies_) {
    body.conditions.damping = options_.damping;
    if (options.anti_locking == AntiLocking::f_bar) average_volumes(body, model.particles);
  }
  map_state();
}

void TotalLagrangian::map_state() {
  fastest_ = 0;
  bad_particle_ = -1;
  for (TotalBody& body : bodies_) {
    map_momentum(model_.particles, body, threads_);                                                             // (1)
    find_node_velocities(body, threads_);                                                                       // (2)
    collect(map_stress(model_.particles, body, body.laws, threads_), body.grid.cell, fastest_, bad_particle_);  // (1)
  }
}

double TotalLagrangian::stable_time_step() const {
  return bad_particle_ < 0 && fastest_ > 0 && std::isfinite(fastest_) ? options_.courant / fastest_ : 0;
}

std::int64_t TotalLagrangian::step(double dt) {
  Particles& particles = model_.particles;
  const Vec3 gravity = options_.gravity_at(time_, dt);
  fastest_ = 0;
  bad_particle_ = -1;
  for (TotalBody& body : bodies_) {
    if (body_force) add_body_force(particles, body, [&](const Vec3& X) { return body_force(X, time_); });  // (1)
    advance_nodes(body, gravity, dt, threads_);                                                            // (2)
    work_ = work_ + act_on_nodes(body.conditions, nodes_of(body, dt, time_), body.held_now, gravity - options_.gravity,
                                 threads_);
    advance_particles(particles, body, options_.flip_share(dt), dt, threads_);  // (3), (1)
    find_node_velocities(body, threads_);                                       // (5), (2)
    body.conditions.loads.hold(body.velocity);
    collect(update_stress(particles, body, body.laws, dt, threads_), body.grid.cell, fastest_,
            bad_particle_);  // (5), (6), (1)
  }
  time_ += dt;
  return bad_particle_;
}

void TotalLagrangian::begin_relaxing(double damping) {
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
  model_.particles.velocity = std::move(start_velocity_);
  model_.particles.position = model_.particles.reference_position;
  for (TotalBody& body : bodies_) {
    body.conditions.damping = options_.damping;
    body.conditions.faces.hold_still(false);
    body.conditions.loads.hold_still(false);
    body.held_now = body.held;
  }
  map_state();
  options_.end_ramp();
  work_ = {};
  time_ = 0;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/step_total.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/check_model.hpp"
#include "solver/core/stress.hpp"
#include "solver/core/transfer.hpp"

namespace scarp {
namespace {

void collect(const StressOutcome& outcome, double cell, double& fastest, std::int64_t& bad_particle) {
  fastest = std::max(fastest, std::sqrt(outcome.largest_wave_speed_squared) / cell);
  if (bad_particle < 0) bad_particle = outcome.bad_particle;
}

}  // namespace

Vec3 gravity_of(const SolverOptions& options, int dimension) {
  if (options.gravity) return *options.gravity;
  return dimension == 2 ? Vec3{0, -9.81, 0} : Vec3{0, 0, -9.81};
}

TotalLagrangian::TotalLagrangian(Model& model, const SolverOptions& options, int threads)
    : model_(model),
      gravity_(gravity_of(options, model.domain.dimension)),
      flip_(options.flip),
      courant_(options.courant),
      threads_(std::max(1, threads)) {
  check_model(model);
  check_options(options, model.domain.dimension);
  sort_by_cell(model);
  for (const NamedMaterial& material : model.materials) laws_.push_back(prepare(material.law));
  for (const Body& body : model.bodies) bodies_.push_back(make_total_body(model, body));
  for (TotalBody& body : bodies_) {
    map_momentum(model_.particles, body, threads_);                                                         // (1)
    find_node_velocities(body, threads_);                                                                   // (2)
    collect(map_stress(model_.particles, body, laws_, threads_), body.grid.cell, fastest_, bad_particle_);  // (1)
  }
}

double TotalLagrangian::stable_time_step() const {
  return bad_particle_ < 0 && fastest_ > 0 && std::isfinite(fastest_) ? courant_ / fastest_ : 0;
}

std::int64_t TotalLagrangian::step(double dt) {
  Particles& particles = model_.particles;
  fastest_ = 0;
  bad_particle_ = -1;
  for (TotalBody& body : bodies_) {
    if (body_force) add_body_force(particles, body, [&](const Vec3& X) { return body_force(X, time_); });  // (1)
    advance_nodes(body, gravity_, dt, threads_);                                                           // (2)
    advance_particles(particles, body, flip_, dt, threads_);                                               // (3), (1)
    find_node_velocities(body, threads_);                                                                  // (5), (2)
    collect(update_stress(particles, body, laws_, dt, threads_), body.grid.cell, fastest_,
            bad_particle_);  // (5), (6), (1)
  }
  time_ += dt;
  return bad_particle_;
}

}  // namespace scarp

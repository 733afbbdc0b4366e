// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/step_updated.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/apic.hpp"
#include "solver/core/law_kernels.hpp"
#include "solver/core/step_limit.hpp"
#include "solver/core/updated_kernels.hpp"
#include "solver/core/updated_stress.hpp"
#include "solver/core/updated_transfer.hpp"
#include "solver/core/xpic.hpp"

namespace scarp {

UpdatedLagrangian::UpdatedLagrangian(Model& model, const SolverOptions& options, int threads,
                                     const kernels::Kernels& kernels, RigidBodies* rigid)
    : model_(model),
      grid_(make_updated_grid(model, options.shape, threads)),
      order_(options.update),
      options_(options, model.domain.dimension, model.shaking),
      conditions_(model, grid_, options.damping, rigid),
      threads_(threads) {
  if (options.anti_locking == AntiLocking::f_bar) average_volumes(grid_);
  if (options_.transfer == Transfer::apic) begin_affine(model.particles, grid_, threads);
  for (const NamedMaterial& material : model.materials) laws_.push_back(prepare(material.law, grid_.cell));
  if (options.back_end == BackEnd::nodal) {
    grid_.law_parameters = kernels_of(model);
    use_kernels(grid_, model.particles, kernels);
  }
  if (grid_.fields.size() > 1) contact_.emplace(model, grid_);
  find_speeds();
}

void UpdatedLagrangian::find_speeds() {
  particle_speed_ = 0;
  for (std::uint32_t p : grid_.particles)
    particle_speed_ = std::max(particle_speed_, norm(model_.particles.velocity[p]));
  take(survey(model_.particles, grid_, laws_, threads_));
}

void UpdatedLagrangian::take(const UpdatedOutcome& outcome) {
  wave_speed_ = std::sqrt(outcome.largest_wave_speed_squared);
  bad_particle_ = outcome.bad_particle;
}

double UpdatedLagrangian::stable_time_step() const {
  const double speed = wave_speed_ + particle_speed_;
  return bad_particle_ < 0 && speed > 0 && std::isfinite(speed) ? options_.courant * grid_.cell / speed : 0;
}

void UpdatedLagrangian::place() {
  lost_particle_ = place_particles(grid_, model_.particles, threads_);
  if (lost_particle_ < 0) conditions_.follow(grid_);
}

AffineMotion UpdatedLagrangian::affine_motion() const {
  return grid_.affine.empty() ? AffineMotion{} : measure_affine(model_.particles, grid_, threads_);
}

StepLimit UpdatedLagrangian::step_limit() const {
  StepLimit limit = find_step_limit(model_.particles, grid_, laws_);
  limit.time_step = stable_time_step();
  return limit;
}

void UpdatedLagrangian::step(double dt) {
  Particles& particles = model_.particles;
  const Vec3 gravity = options_.gravity_at(time_, dt);
  const bool affine = options_.transfer == Transfer::apic;
  map_to_nodes(particles, grid_, threads_);                    // (1)
  if (affine) add_affine_momenta(particles, grid_, threads_);  // (1)
  find_node_velocities(grid_, threads_);                       // (2)
  conditions_.hold(grid_);
  bind_mapped(dt);
  if (order_ == UpdateOrder::usf) {
    take(update_stress(particles, grid_, laws_, dt, threads_));  // (5), (6)
    map_forces(particles, grid_, threads_);                      // (1)
  }
  if (!in_contact_.empty()) add_particle_forces(grid_, contact_force_, threads_);
  advance_nodes(grid_, gravity, dt, threads_);  // (2)
  work_ = work_ + conditions_.act(grid_, time_, dt, gravity - options_.gravity, options_.ramp(time_, dt), threads_);
  touch(dt);
  if (options_.transfer == Transfer::xpic) {
    conditions_.find_kept_axes(grid_);
    filter_velocities(particles, grid_, options_.xpic_order, threads_);  // (3)
  }
  if (relaxing_)
    kinetic_energy_of_nodes_ = scarp::kinetic_energy_of_nodes(grid_.mass, grid_.velocity_updated, threads_);
  particle_speed_ = advance_particles(particles, grid_, options_.velocity_update(dt), dt, threads_);  // (3), (5)
  if (affine) advance_affine(particles, grid_, threads_);                                             // (3), (5)
  if (order_ != UpdateOrder::usf) {
    if (order_ == UpdateOrder::musl)
      find_node_velocities(grid_, threads_);  // (5)
    else
      take_updated_velocities(grid_, threads_);  // (5)
    conditions_.hold_again(grid_);
    bind_remapped(dt);
    take(update_stress(particles, grid_, laws_, dt, threads_));  // (5), (6)
  }
  place();
  time_ += dt;
}

/// Contact of v_I before forces act.
void UpdatedLagrangian::bind_mapped(double dt) {
  if (!contact_) return;
  contact_->look(model_.particles, grid_, threads_);
  conditions_.find_kept_axes(grid_);
  contact_->hold(grid_, dt, threads_);
}

/// Contact of v~_I after all other conditions.
void UpdatedLagrangian::touch(double dt) {
  if (!contact_) return;
  conditions_.find_kept_axes(grid_);
  const double handed = options_.transfer == Transfer::flip ? 1 - options_.velocity_update(dt).less : 1;
  work_.friction += contact_->act(grid_, dt, handed, threads_);
}

/// Contact of the v_I that velocity gradients are taken of.
void UpdatedLagrangian::bind_remapped(double dt) {
  if (contact_ && order_ == UpdateOrder::musl) contact_->hold_after(grid_, dt, threads_);
}

std::vector<Vec3> UpdatedLagrangian::take_contact_impulse() {
  if (!contact_) return {};
  std::vector<Vec3> impulse = contact_->impulse();
  contact_->forget_impulse();
  return impulse;
}

void UpdatedLagrangian::push_contact(const std::vector<std::uint32_t>& particles, const std::vector<Vec3>& forces) {
  contact_force_.resize(model_.particles.size(), Vec3{0, 0, 0});
  for (std::uint32_t p : in_contact_) contact_force_[p] = {0, 0, 0};
  in_contact_ = particles;
  for (std::size_t k = 0; k < particles.size(); ++k) contact_force_[particles[k]] = forces[k];
}

void UpdatedLagrangian::begin_relaxing(double damping) {
  relaxing_ = true;
  for (std::uint32_t p : grid_.particles) model_.particles.velocity[p] = {0, 0, 0};
  conditions_.begin_relaxing(damping);
  options_.begin_relaxing();
  if (!grid_.affine.empty()) begin_affine(model_.particles, grid_, threads_);
  find_speeds();
}

void UpdatedLagrangian::rest() {
  relaxing_ = false;
  for (std::uint32_t p : grid_.particles) model_.particles.position[p] = model_.particles.reference_position[p];
  conditions_.rest(grid_);
  place();
  if (!grid_.affine.empty()) begin_affine(model_.particles, grid_, threads_);
  find_speeds();
  options_.rest();
  work_ = {};
  time_ = 0;
}

}  // namespace scarp

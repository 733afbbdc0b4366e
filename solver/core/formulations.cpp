// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/formulations.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/check_model.hpp"
#include "solver/core/diagnostics.hpp"
#include "solver/core/k0_state.hpp"
#include "solver/core/pore_water.hpp"
#include "solver/core/reference_grid.hpp"
#include "solver/model/error.hpp"

namespace scarp {

Formulations::Formulations(Model& model, const SolverOptions& options, int threads, const kernels::Kernels& kernels)
    : model_(model),
      gravity_(gravity_of(options, model.domain.dimension)),
      threads_(threads),
      courant_(options.courant) {
  check_model(model);
  check_options(options, model.domain.dimension);
  check_formulations(model, options);
  check_contact(model, options);
  check_rigid(model);
  set_saturated_masses(model);
  sort_by_cell(model);
  set_k0_stress(model, options, threads);
  if (has_formulation(model, Formulation::rigid)) {
    complete_state(model.particles);
    rigid_.emplace(model, StepOptions(options, model.domain.dimension, model.shaking));
  }
  RigidBodies* const rigid = rigid_ ? &*rigid_ : nullptr;
  if (has_formulation(model, Formulation::total_lagrangian)) total_.emplace(model, options, threads, kernels, rigid);
  if (has_formulation(model, Formulation::updated_lagrangian)) complete_state(model.particles);
  if (has_formulation(model, Formulation::updated_lagrangian))
    updated_.emplace(model, options, threads, kernels, rigid_bodies_carry(model) ? rigid : nullptr);
  if (rigid_bodies_carry(model)) refuse_overlap();
  const bool penalty = model.contact.method == ContactMethod::penalty;
  if (penalty || (model.contact.method == ContactMethod::grid && total_))
    contact_.emplace(model, total_ ? &*total_ : nullptr, updated_ ? &*updated_ : nullptr, penalty ? rigid : nullptr);
}

/// What lies deep in a rigid body at the start would be carried through it.
void Formulations::refuse_overlap() const {
  const int dimension = model_.domain.dimension;
  for (const Body& body : model_.bodies)
    for (std::size_t p = body.begin; p < body.end && body.formulation == Formulation::updated_lagrangian; ++p)
      for (std::size_t r = 0; r < rigid_->size(); ++r) {
        const double half = 0.5 * std::pow(model_.particles.reference_volume[p], 1.0 / dimension);
        const auto foot = (*rigid_)[r].foot(model_.particles.position[p], INFINITY);
        if (foot->distance < -half)
          throw Error("solve",
                      "depth of particle " + std::to_string(model_.particles.id[p]) + " of body '" + body.name +
                          "' in rigid body '" + model_.bodies[(*rigid_)[r].body].name + "' at the start",
                      shortest(-foot->distance) + " m", "at most half its edge, " + shortest(half) + " m");
      }
}

double Formulations::stable_time_step() const {
  double least = contact_ ? contact_->stable_time_step(courant_) : INFINITY;
  if (rigid_) least = std::min(least, rigid_->time_to_go(courant_ * model_.domain.cell));
  if (total_) least = std::min(least, total_->stable_time_step());
  if (updated_) least = std::min(least, updated_->stable_time_step());
  return least;
}

StepLimit Formulations::step_limit() {
  StepLimit limit;
  if (total_) limit = total_->step_limit();
  if (updated_ && (!total_ || updated_->stable_time_step() < limit.time_step)) limit = updated_->step_limit();
  limit.time = time_;
  return limit;
}

Failure Formulations::collapse(const std::string& what) {
  const StepLimit limit = step_limit();
  Failure failure{.what = what + " to " + shortest(limit.time_step) + " s"};
  if (limit.body < 0) return failure;
  failure.what += ": body '" + model_.bodies[limit.body].name + "', material '" +
                  model_.materials[limit.material].name + "', wave speed " + shortest(limit.wave_speed) + " m/s";
  if (limit.particle_speed > 0) failure.what += ", particle speed " + shortest(limit.particle_speed) + " m/s";
  failure.particle = limit.particle;
  failure.position = limit.position;
  return failure;
}

std::int64_t Formulations::step(double dt) {
  if (contact_) contact_->push(dt);
  if (rigid_) rigid_->step(time_, dt);
  if (total_) total_->step(dt);
  if (updated_) updated_->step(dt);
  time_ += dt;
  if (contact_ && bad_particle() < 0) contact_->update();
  return bad_particle();
}

std::int64_t Formulations::bad_particle() const {
  if (total_ && total_->bad_particle() >= 0) return total_->bad_particle();
  if (total_ && total_->lost_particle() >= 0) return total_->lost_particle();
  if (!updated_) return -1;
  return updated_->bad_particle() >= 0 ? updated_->bad_particle() : updated_->lost_particle();
}

NodeWork Formulations::work() const {
  NodeWork work;
  if (total_) work = work + total_->work();
  if (updated_) work = work + updated_->work();
  if (contact_) work.friction += contact_->friction();
  if (rigid_) work.external += rigid_->external();
  return work;
}

void Formulations::begin_relaxing(double damping) {
  complete_state(model_.particles);
  start_velocity_ = model_.particles.velocity;
  if (rigid_) rigid_->hold_still(true);
  if (total_) total_->begin_relaxing(damping);
  if (updated_) updated_->begin_relaxing(damping);
}

void Formulations::rest() {
  if (rigid_) rigid_->hold_still(false);
  if (total_) total_->rest();
  model_.particles.velocity = std::move(start_velocity_);
  if (updated_) updated_->rest();
  time_ = measured_ = 0;
}

void Formulations::set_time(double time) {
  time_ = time;
  if (total_) total_->set_time(time);
  if (updated_) updated_->set_time(time);
}

void Formulations::write_particles() {
  if (total_) total_->write_particles();
  if (rigid_) rigid_->write(model_.particles);
}

ParticleStates Formulations::states() const {
  if (rigid_) rigid_->write(model_.particles);
  return {model_.particles.size(), [this](std::size_t begin, std::size_t end, Particles& block) {
            copy_particles(model_.particles, begin, end, block);
            complete_state(block);
            if (total_) total_->write_particles(block, begin, end);
          }};
}

AffineMotion Formulations::affine_motion() const {
  AffineMotion sum;
  if (total_) sum = sum + total_->affine_motion();
  if (updated_) sum = sum + updated_->affine_motion();
  return sum;
}

double Formulations::kinetic_energy_of_nodes() const {
  return (total_ ? total_->kinetic_energy_of_nodes() : 0) + (updated_ ? updated_->kinetic_energy_of_nodes() : 0);
}

HistorySample Formulations::measure(Diagnostics& diagnostics) {
  HistorySample sample;
  if (all_nodal()) {
    sample = total_->measure(diagnostics.reference_centre());
    diagnostics.place_centre(sample);
  } else {
    write_particles();
    sample = diagnostics.measure(model_, laws(), gravity(), threads_);
    diagnostics.add_motion(sample, model_, threads_);
  }
  const AffineMotion affine = affine_motion();
  sample.kinetic += affine.kinetic;
  sample.total += affine.kinetic;
  sample.angular_momentum = sample.angular_momentum + affine.angular_momentum;
  measure_contact(sample);
  return sample;
}

void Formulations::measure_contact(HistorySample& sample) {
  const double elapsed = time_ - measured_;
  measured_ = time_;
  if (model_.contact.method == ContactMethod::none && !rigid_) return;
  if (contact_) {
    sample.contact = contact_->stored();
    sample.total += sample.contact;
    sample.contact_force = contact_->take_mean_force();
  }
  sample.contact_force.resize(model_.bodies.size(), Vec3{0, 0, 0});
  const auto add_impulse = [&](const std::vector<Vec3>& impulse) {
    for (std::size_t b = 0; b < impulse.size() && elapsed > 0; ++b)
      sample.contact_force[b] = sample.contact_force[b] + (1 / elapsed) * impulse[b];
  };
  if (updated_) add_impulse(updated_->take_contact_impulse());
  if (rigid_) add_impulse(rigid_->take_impulse());
}

std::vector<std::string> Formulations::obstacles() const {
  return total_ ? total_->obstacles() : std::vector<std::string>();
}

std::vector<std::int64_t> Formulations::reference_updates() const {
  return total_ ? total_->reference_updates() : std::vector<std::int64_t>();
}

std::optional<Failure> Formulations::failure() {
  const std::int64_t p = bad_particle();
  if (p < 0) return std::nullopt;
  Particles particle;
  states().read(static_cast<std::size_t>(p), static_cast<std::size_t>(p) + 1, particle);
  if ((total_ && total_->bad_particle() == p) || (updated_ && updated_->bad_particle() == p))
    return describe_bad_particle(particle, 0);
  return Failure{.what = "a particle has left the grid", .particle = particle.id[0], .position = particle.position[0]};
}

}  // namespace scarp

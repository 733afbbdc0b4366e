// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/core/contact.hpp"
#include "solver/core/diagnostics.hpp"
#include "solver/core/rigid_bodies.hpp"
#include "solver/core/step_total.hpp"
#include "solver/core/step_updated.hpp"
#include "solver/model/particle_states.hpp"

namespace scarp {

/// All bodies of a model, each in its formulation, with one time step, and what is between them.
class Formulations {
 public:
  /// Checks the model and sorts its particles by cell. `model` must outlive this object.
  /// @throws Error ("solve", "materials") where model or options cannot be run.
  Formulations(Model& model, const SolverOptions& options, int threads,
               const kernels::Kernels& kernels = kernels::best_kernels());

  /// The smallest of both and of contact, s; 0 where the state is not finite.
  double stable_time_step() const;
  /// bad_particle() after it.
  std::int64_t step(double dt);

  /// The first particle that stops the run: invalid, or off the grid; or -1.
  std::int64_t bad_particle() const;

  /// Why the state as it stands cannot go on, if so; step and time are the caller's.
  std::optional<Failure> failure();

  /// Brings the model's particles to the state as it stands: steps leave them behind.
  void write_particles();
  /// The state as it stands, as long as this object stands and takes no step; the model's particles stay as they are.
  ParticleStates states() const;
  /// Whether the model's particles are asked for no state: all bodies are in nodal form.
  bool all_nodal() const { return total_ && !updated_ && !rigid_ && total_->all_nodal(); }
  /// While relaxing: kinetic energy of the nodes in the last step, J. Particles of updated-Lagrangian bodies may keep
  /// velocities beside it that sum to nothing on every node: they move nothing, no damping sees them, and rest() sets
  /// them to zero.
  double kinetic_energy_of_nodes() const;
  /// Energies and momenta of the state as it stands; time, step and dt are the caller's.
  HistorySample measure(Diagnostics& diagnostics);
  /// Per total-Lagrangian body: empty for the nodal form, else why the body is not in it.
  std::vector<std::string> obstacles() const;

  /// Per total-Lagrangian body: how often its reference configuration has moved.
  std::vector<std::int64_t> reference_updates() const;

  /// What sets the stable time step; a pass over all particles.
  StepLimit step_limit();

  /// A failure by a time step that has become too short: names what shortens it. Step and time are the caller's.
  Failure collapse(const std::string& what);

  double time() const { return time_; }
  void set_time(double time);
  const std::vector<PreparedLaw>& laws() const {
    return total_ ? total_->laws() : updated_ ? updated_->laws() : no_laws_;
  }
  /// The model's rigid bodies, or none.
  const RigidBodies* rigid() const { return rigid_ ? &*rigid_ : nullptr; }
  const Vec3& gravity() const { return gravity_; }
  /// Of the nodes' conditions since the start or the last rest().
  NodeWork work() const;

  /// A start at rest, see relax and the classes of the formulations: begins it.
  void begin_relaxing(double damping);
  /// Ends it; velocities are those from before.
  void rest();

 private:
  AffineMotion affine_motion() const;
  void measure_contact(HistorySample& sample);
  void refuse_overlap() const;

  Model& model_;
  Vec3 gravity_;
  int threads_;
  double time_ = 0, measured_ = 0;
  std::vector<Vec3> start_velocity_;
  std::vector<PreparedLaw> no_laws_;  ///< where nothing deforms
  std::optional<RigidBodies> rigid_;
  std::optional<TotalLagrangian> total_;
  std::optional<UpdatedLagrangian> updated_;
  double courant_;
  std::optional<Contact> contact_;
};

}  // namespace scarp

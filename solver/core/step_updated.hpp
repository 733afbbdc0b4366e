// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "solver/core/apic.hpp"
#include "solver/core/grid_contact.hpp"
#include "solver/core/step_options.hpp"
#include "solver/core/updated_conditions.hpp"
#include "solver/core/updated_grid.hpp"
#include "solver/core/updated_stress.hpp"
#include "solver/kernels/choose_kernels.hpp"
#include "solver/materials/law.hpp"

namespace scarp {

/// Explicit updated-Lagrangian MPM (method.md 1.1; Sulsky, Zhou, Schreyer 1995; Bardenhagen 2002 for the orders of the
/// stress update) of all bodies of this formulation, on one grid: they meet, stick and part through it, or with a field
/// of velocities for each, between which there is GridContact. 3D and plane strain.
class UpdatedLagrangian {
 public:
  /// @param model  checked and sorted by cell; must outlive this object
  /// @param rigid  bodies that carry nodes, or none; likewise
  /// @throws Error ("solve", "materials"), see make_updated_grid and UpdatedConditions
  UpdatedLagrangian(Model& model, const SolverOptions& options, int threads,
                    const kernels::Kernels& kernels = kernels::best_kernels(), RigidBodies* rigid = nullptr);

  /// Largest stable step, s: courant * cell / (c + |v|), with c of the stiffest particle in the current configuration
  /// and v of the fastest (method.md 1.2). 0 where the state is not finite.
  double stable_time_step() const;

  /// What sets it.
  StepLimit step_limit() const;

  /// One step of `dt` seconds, in the order of the options.
  void step(double dt);
  void set_time(double time) { time_ = time; }
  /// Of the nodes' conditions since the start or the last rest().
  NodeWork work() const { return work_; }

  /// What the particles' affine velocities add; nothing but with APIC.
  AffineMotion affine_motion() const;

  /// For contact: forces on particles in the next step, N, beside all others; they count as no load's work.
  /// @param particles  index into Model::particles
  void push_contact(const std::vector<std::uint32_t>& particles, const std::vector<Vec3>& forces);

  /// Of GridContact, on each body of the model since the last call, N s; empty without.
  std::vector<Vec3> take_contact_impulse();

  /// For a start at rest (see relax): velocities are zero, damping is `damping`, absorbing faces and loads hold still.
  void begin_relaxing(double damping);
  /// While relaxing: sum of m_I v~_I^2 / 2 of the last step, J.
  double kinetic_energy_of_nodes() const { return kinetic_energy_of_nodes_; }
  /// Ends it: each particle's position is its reference position, so that displacements count from here; stress, F and
  /// history stay. Time and work are zero, gravity is the steady one. The particles' velocities are the caller's to
  /// give, before.
  void rest();

  /// The first particle with J <= 0 or something not finite, or -1.
  std::int64_t bad_particle() const { return bad_particle_; }
  /// The first particle that has left the domain, or -1.
  std::int64_t lost_particle() const { return lost_particle_; }
  const std::vector<PreparedLaw>& laws() const { return laws_; }

 private:
  void find_speeds();
  void place();
  void take(const UpdatedOutcome& outcome);
  void bind_mapped(double dt);
  void touch(double dt);
  void bind_remapped(double dt);

  Model& model_;
  std::vector<PreparedLaw> laws_;
  UpdatedGrid grid_;
  UpdateOrder order_;
  StepOptions options_;
  UpdatedConditions conditions_;
  std::optional<GridContact> contact_;
  NodeWork work_;
  std::vector<Vec3> contact_force_;        ///< per particle of the model, N; empty without contact
  std::vector<std::uint32_t> in_contact_;  ///< particles with such a force
  double time_ = 0;
  bool relaxing_ = false;
  double kinetic_energy_of_nodes_ = 0;
  int threads_;
  double wave_speed_ = 0;      ///< m/s, of the stiffest particle
  double particle_speed_ = 0;  ///< m/s, of the fastest
  std::int64_t bad_particle_ = -1, lost_particle_ = -1;
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/core/apic.hpp"
#include "solver/core/contact_surface.hpp"
#include "solver/core/nodal_body.hpp"
#include "solver/core/step_options.hpp"
#include "solver/core/total_body.hpp"
#include "solver/kernels/choose_kernels.hpp"
#include "solver/materials/law.hpp"

namespace scarp {

/// Explicit total-Lagrangian MPM in the MUSL order (method.md 1.1; de Vaucorbeil, Nguyen, Hutchinson 2020; Sulsky,
/// Zhou, Schreyer 1995), linear shape functions. 3D and plane strain.
///
/// Bodies are in nodal form where they can be (NodalBody); the others' particles carry their state from step to step.
/// With SolverOptions::reference_update all do, and steps may sort them anew (moving_reference.hpp).
class TotalLagrangian {
 public:
  /// Sorts the model's particles by cell, maps their momenta and stresses. `model` must outlive this object, and so
  /// must the rigid bodies that grip some of its bodies.
  /// @param kernels  those without lanes, Kernels{}, have particles go one by one: the oracle of all others
  /// @throws Error ("solve", "materials") where the model cannot be run.
  TotalLagrangian(Model& model, const SolverOptions& options, int threads,
                  const kernels::Kernels& kernels = kernels::best_kernels(), RigidBodies* rigid = nullptr);

  /// Largest stable step, s: courant * min over bodies of cell / c, with c of the stiffest cell as it is now
  /// (method.md 1.2). The lumped second map of MUSL slows the shortest waves: elastic blocks with 1, 2, 3 points per
  /// axis, 2D and 3D, are stable to courant 1.4 and none beyond 1.8; see kCourantOfMovedGrids. The cells are looked at
  /// every fourth step: in between a wave crosses two cells at most, and strains change by little. 0 where the state is
  /// not finite.
  double stable_time_step() const;

  /// What sets it.
  StepLimit step_limit() const;

  /// One step of `dt` seconds. Index of the first particle whose state is no longer valid (J <= 0 or not finite),
  /// or -1.
  std::int64_t step(double dt);

  /// Brings the particles of bodies in nodal form to the state as it stands.
  void write_particles();
  /// The same of those among [begin, end) of the model, in a block that holds them; the model's stay as they are.
  void write_particles(Particles& block, std::size_t begin, std::size_t end) const;
  /// sum of m_I v_I^2 / 2, J: of the motion that moves particles, and that damping acts on.
  double kinetic_energy_of_nodes() const;
  /// Where all bodies are in nodal form: see NodalBody::measure.
  bool all_nodal() const;
  HistorySample measure(const Vec3& about) const;
  /// What the particles' affine velocities add; nothing but with APIC.
  AffineMotion affine_motion() const;
  /// Per body, in the order of the model: empty for the nodal form, else why the body is not in it.
  const std::vector<std::string>& obstacles() const { return obstacles_; }

  /// The first invalid particle of the state as it stands, or -1.
  std::int64_t bad_particle() const { return bad_particle_; }
  /// A particle out of reach of any grid when its body's reference configuration was to move, or -1.
  std::int64_t lost_particle() const { return lost_particle_; }
  /// Per body, in the order of the model: how often that configuration has moved.
  const std::vector<std::int64_t>& reference_updates() const { return reference_updates_; }
  double time() const { return time_; }
  void set_time(double time) { time_ = time; }
  const std::vector<PreparedLaw>& laws() const { return laws_; }
  const Vec3& gravity() const { return options_.gravity; }  ///< the steady one
  /// Of the nodes' conditions since the start or the last rest().
  NodeWork work() const { return work_; }

  /// The bodies of this formulation, in the order of the model.
  const TotalBody& body(std::size_t index) const { return bodies_[index]; }
  /// For contact: turns the nodes of a surface into places that the calls below understand.
  void prepare_contact(std::size_t index, ContactSurface& surface);
  /// y = x(Y) of some points of the surface, and their current outward normals unless `n` is null; other entries stay.
  void locate_contact(std::size_t index, const ContactSurface& surface, const std::uint32_t* points, std::size_t count,
                      std::vector<Vec3>& y, std::vector<Vec3>* n) const;
  /// Keeps where the surface is; then, how far any part of it has moved since, m.
  void anchor_contact(std::size_t index, const ContactSurface& surface, std::vector<Vec3>& anchor) const;
  double contact_shift(std::size_t index, const ContactSurface& surface, const std::vector<Vec3>& anchor) const;
  /// Adds forces at points of the surface to those of the next step; per point of the surface, N.
  void push_contact(std::size_t index, const ContactSurface& surface, const std::uint32_t* points, std::size_t count,
                    const std::vector<Vec3>& force);

  /// For a start at rest (see relax): velocities are put aside, damping is `damping`, absorbing faces hold still.
  void begin_relaxing(double damping);
  /// Ends it: the velocities put aside are back, and each particle's position is its reference position, so that
  /// displacements count from here; stress, F and history stay. Time and work are zero, gravity is the steady one.
  void rest();

  /// Acceleration b(X, t) beside gravity, m/s2, e.g. of a manufactured solution: Model::body_force. Serial; counts from
  /// the next step on; while relaxing it is that at t = 0.
  std::function<Vec3(const Vec3& X, double time)> body_force;

 private:
  Model& model_;
  std::vector<TotalBody> bodies_;
  std::vector<std::unique_ptr<NodalBody>> nodal_;  ///< per body; none where its particles carry the state
  std::vector<std::string> obstacles_;
  std::vector<PreparedLaw> laws_;
  StepOptions options_;
  void set_grips(RigidBodies& rigid);
  void choose_back_ends(const SolverOptions& options, const kernels::Kernels& kernels);
  std::optional<std::string> obstacle(const SolverOptions& options, const TotalBody& body,
                                      const kernels::Kernels& kernels) const;
  void map_state();
  StressOutcome map_body(TotalBody& body);
  void move_references();
  StressOutcome step_nodal(NodalBody& body, const Vec3& gravity, double dt, bool find_speed);
  StressOutcome step_particles(TotalBody& body, const Vec3& gravity, double dt, bool find_speed);
  void find_accelerations();

  NodeWork work_;
  std::vector<Vec3> start_velocity_;
  std::vector<Vec3> accelerations_;  ///< of body_force, per particle; empty without
  bool relaxing_ = false;
  int threads_;
  double time_ = 0;
  double fastest_ = 0;              ///< max over bodies of c / cell, 1/s
  int since_look_ = 0;              ///< steps since it was found
  bool particles_current_ = false;  ///< whether write_particles has nothing to do
  std::int64_t bad_particle_ = -1, lost_particle_ = -1;
  std::optional<double> reference_update_;
  std::vector<std::int64_t> reference_updates_;
};

}  // namespace scarp

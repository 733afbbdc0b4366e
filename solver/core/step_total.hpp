// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "solver/core/total_body.hpp"
#include "solver/materials/law.hpp"
#include "solver/model/solver_options.hpp"

namespace scarp {

/// The gravity that holds: as stated, or 9.81 m/s2 along -z (2D: -y).
Vec3 gravity_of(const SolverOptions& options, int dimension);

/// Explicit total-Lagrangian MPM in the MUSL order (method.md 1.1; de Vaucorbeil, Nguyen, Hutchinson 2020; Sulsky,
/// Zhou, Schreyer 1995), linear shape functions, particle-state form. 3D and plane strain.
class TotalLagrangian {
 public:
  /// Sorts the model's particles by cell, maps their momenta and stresses. `model` must outlive this object.
  /// @throws Error ("solve", "materials") where the model cannot be run.
  TotalLagrangian(Model& model, const SolverOptions& options, int threads);

  /// Largest stable step, s: courant * min over bodies of cell / c, with c of the stiffest cell as it is now
  /// (method.md 1.2). The lumped second map of MUSL halves the frequency of the shortest waves, so that the linear
  /// limit is courant = 1.7 with 2 points per axis, and any courant <= 1 is safe. 0 where the state is not finite.
  double stable_time_step() const;

  /// One step of `dt` seconds. Index of the first particle whose state is no longer valid (J <= 0 or not finite),
  /// or -1.
  std::int64_t step(double dt);

  /// The first invalid particle of the state as it stands, or -1.
  std::int64_t bad_particle() const { return bad_particle_; }
  double time() const { return time_; }
  void set_time(double time) { time_ = time; }
  const std::vector<PreparedLaw>& laws() const { return laws_; }
  const Vec3& gravity() const { return gravity_; }

  /// Acceleration b(X, t) beside gravity, m/s2, e.g. of a manufactured solution. Serial; none by default. Counts
  /// from the next step on.
  std::function<Vec3(const Vec3& X, double time)> body_force;

 private:
  Model& model_;
  std::vector<TotalBody> bodies_;
  std::vector<PreparedLaw> laws_;
  Vec3 gravity_;
  double flip_, courant_;
  int threads_;
  double time_ = 0;
  double fastest_ = 0;  ///< max over bodies of c / cell, 1/s
  std::int64_t bad_particle_ = -1;
};

}  // namespace scarp

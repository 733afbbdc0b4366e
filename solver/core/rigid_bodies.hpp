// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "solver/core/mass_properties.hpp"
#include "solver/core/node_step.hpp"
#include "solver/core/signed_distance.hpp"
#include "solver/core/step_options.hpp"
#include "solver/model/model.hpp"

namespace scarp {

/// Where a rigid body is and how it moves: x = centre + turn (X - reference centre).
struct RigidState {
  Vec3 centre{0, 0, 0};  ///< m
  Mat3 turn = kIdentity;
  Vec3 velocity{0, 0, 0};          ///< of the centre, m/s
  Vec3 angular_velocity{0, 0, 0};  ///< 1/s

  Vec3 velocity_at(const Vec3& x) const { return velocity + cross(angular_velocity, x - centre); }
};

/// Force and moment about the centre, N and N m.
struct Wrench {
  Vec3 force{0, 0, 0}, moment{0, 0, 0};
};

struct RigidBody {
  explicit RigidBody(SignedDistance of) : surface(std::move(of)) {}

  std::int32_t body = 0;           ///< index into Model::bodies
  Vec3 reference_centre{0, 0, 0};  ///< m; of a free body that of its mass
  SignedDistance surface;          ///< in the reference configuration
  RigidSurface kind;
  Vec3 given_velocity{0, 0, 0};  ///< at factor 1, m/s
  bool moves = false;            ///< ever
  bool free = false;
  MassProperties inertia;          ///< of a free body
  Vec3 angular_momentum{0, 0, 0};  ///< about its centre, of a free body, kg m2/s
  RigidState before, now;          ///< at the start and at the end of the step taken last
  Wrench wrench, wrench_before;    ///< of contact, as it stands, and at the start of the step
  double stiffness_per_mass = 0;   ///< of the springs that press on a free body, 1/s2
  Vec3 impulse{0, 0, 0};           ///< by nodes that it carries, since take_impulse, N s

  /// Where a material point is, and which one is at a place.
  Vec3 place(const RigidState& state, const Vec3& X) const;
  Vec3 material_point(const RigidState& state, const Vec3& x) const;
  /// Of a place as it is now.
  std::optional<SignedDistance::Foot> foot(const Vec3& x, double max_distance) const;
  /// Corners of its bounds, where they are.
  std::array<Vec3, 8> corners(const RigidState& state) const;
  /// A force of contact at x, and the stiffness of its spring, N/m, which counts whether or not it presses yet.
  void push(const Vec3& x, const Vec3& force);
  void stiffen(const Vec3& x, double stiffness);
  /// Of a point of a free body at this distance from its centre, at most: acceleration for a unit force there, 1/kg.
  double mobility(double arm) const;
  /// From the centre to what is farthest, at most, m.
  double longest_arm() const;
};

/// The rigid bodies of a model.
///
/// The motion of those that do not move freely is a closed form of time, whatever the steps: with f(t) the factor of
/// the table and I(t) its integral, the centre is at its start + I v, turned by the angle I omega about the axis.
///
/// Free ones obey gravity and contact: v' = v + dt (g + F / m), x' = x + dt v', L' = L + dt M, and a turn of dt with L'
/// about the principal axes in turn, there and back (McLachlan 1993; Reich 1994): symplectic, so that without moments L
/// is kept to rounding and the energy is off by O(dt^2) without drift.
class RigidBodies {
 public:
  /// `model` must outlive this object.
  /// @throws Error ("solve") where a body's motion is none.
  RigidBodies(const Model& model, const StepOptions& options);

  std::size_t size() const { return bodies_.size(); }
  RigidBody& operator[](std::size_t i) { return bodies_[i]; }
  const RigidBody& operator[](std::size_t i) const { return bodies_[i]; }

  /// Whether any of them ever moves.
  bool move() const;
  /// s: no point of them goes farther than `distance` in it at the velocities and accelerations that they have, and
  /// free ones do not turn by more than a tenth.
  double time_to_go(double distance) const;
  /// From `time` to time + dt.
  void step(double time, double dt);
  /// While true, they stand where they are at t = 0.
  void hold_still(bool still);
  /// Positions, velocities and turns of their particles as they stand.
  void write(Particles& particles) const;
  /// On each body of the model by what it carries since the last call, N s; none on others.
  std::vector<Vec3> take_impulse();

  /// Forgets the forces of contact, to be found anew; then counts what those who move bodies have given, J.
  void begin_contact();
  void count_work();
  /// By them since the start or hold_still, and on free bodies by gravity as far as it is not the steady one.
  double external() const { return external_; }

  /// Adds energies and momenta of free bodies, angular momentum about `about`. Their total is part of the sample's.
  void add_to(HistorySample& sample, const Vec3& about) const;

 private:
  RigidState given_state(const RigidBody& body, double time) const;
  void add(std::int32_t index);
  void step_free(RigidBody& body, const Vec3& gravity, double dt);

  const Model& model_;
  StepOptions options_;
  std::vector<RigidBody> bodies_;
  bool still_ = false;
  double last_step_ = 0;  ///< s
  double external_ = 0;
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/core/node_step.hpp"
#include "solver/core/rigid_bodies.hpp"
#include "solver/materials/law.hpp"
#include "solver/model/model.hpp"
#include "solver/model/particle_states.hpp"

namespace scarp {

/// Energies (method.md 1.4) and momentum of the particles as they stand, those of rigid bodies left out; time, step and
/// dt are the caller's. Free rigid bodies count as such.
/// Blocks of particles are summed in a fixed order: the same bits for any number of threads.
class Diagnostics {
 public:
  /// @param rigid  the model's rigid bodies, of which the free ones count, or none; outlive this object
  explicit Diagnostics(const Model& model, const RigidBodies* rigid = nullptr);
  HistorySample measure(const Model& model, const std::vector<PreparedLaw>& laws, const Vec3& gravity, int threads);
  /// Angular momentum and centre of mass, of the particles' positions and velocities as they stand; then all that free
  /// rigid bodies add to a sample.
  void add_motion(HistorySample& sample, const Model& model, int threads);
  /// Turns a centre that is sum m (x - X) into the centre of mass.
  void place_centre(HistorySample& sample) const { sample.centre = reference_centre_ + (1 / mass_) * sample.centre; }
  /// Centre of mass of the reference configuration, m: the point that angular momentum is taken about.
  const Vec3& reference_centre() const { return reference_centre_; }

 private:
  template <class F>
  void each_free(F&& f) const {
    for (std::size_t r = 0; rigid_ && r < rigid_->size(); ++r)
      if ((*rigid_)[r].free) f((*rigid_)[r]);
  }

  std::vector<HistorySample> blocks_;
  Vec3 reference_centre_{0, 0, 0};
  double mass_ = 0;
  const RigidBodies* rigid_;
};

/// Adds what is a sum over particles.
void add(HistorySample& sum, const HistorySample& part);

/// What the nodes' conditions took and gave, into the sample and its total.
void add_work(HistorySample& sample, const NodeWork& work);

/// Largest |x - X|, m.
double largest_displacement(const ParticleStates& states);

/// What is wrong with a particle that a sweep has found invalid. Step and time are the caller's.
Failure describe_bad_particle(const Particles& particles, std::int64_t index);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solver/model/model.hpp"
#include "solver/model/particle_states.hpp"
#include "solver/model/reports.hpp"

namespace scarp {

/// The solver's one door: what a run hands out while it goes. Called from the thread that called `run`, in the
/// order of time; what it throws ends the run.
struct FrameSink {
  virtual ~FrameSink() = default;
  /// Whether this sink asks `states` alone for the particles' state. Then the model's need not have any, which saves
  /// most of a particle's bytes where all bodies are in nodal form.
  virtual bool takes_blocks() const { return false; }
  /// At t = 0, at each output interval, and at the end time. Both are valid during the call only.
  virtual void frame(const Model& model, const ParticleStates& states, double time, std::int64_t step) = 0;
  /// At t = 0, at each history interval, and with each frame.
  virtual void sample(const HistorySample& sample) = 0;
  /// Whether `look` wants to be called. Particles are brought up to date for it, which takes a while.
  virtual bool watches() const { return false; }
  /// With each sample, after it, for whoever watches points of the model. The model is valid during the call only.
  virtual void look(const Model&, const HistorySample&) {}
  /// After each step.
  virtual void progress(double time, double end_time, std::int64_t step, double dt) = 0;
  /// After the last step, also of a run that failed.
  virtual void end(const Model&, const ParticleStates&) {}
};

}  // namespace scarp

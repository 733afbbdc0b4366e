// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solver/model/model.hpp"
#include "solver/model/reports.hpp"

namespace scarp {

/// The solver's one door: what a run hands out while it goes. Called from the thread that called `run`, in the
/// order of time; what it throws ends the run.
struct FrameSink {
  virtual ~FrameSink() = default;
  /// At t = 0, at each output interval, and at the end time. The model is valid during the call only.
  virtual void frame(const Model& model, double time, std::int64_t step) = 0;
  /// At t = 0, at each history interval, and with each frame.
  virtual void sample(const HistorySample& sample) = 0;
  /// Whether `look` wants to be called. Particles are brought up to date for it, which takes a while.
  virtual bool watches() const { return false; }
  /// With each sample, after it, for whoever watches points of the model. The model is valid during the call only.
  virtual void look(const Model&, const HistorySample&) {}
  /// After each step.
  virtual void progress(double time, double end_time, std::int64_t step, double dt) = 0;
};

}  // namespace scarp

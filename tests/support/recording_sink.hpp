// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "solver/core/frame_sink.hpp"

namespace scarp::test {

/// Keeps what a run hands out; `on_frame` may look at the model.
struct RecordingSink : FrameSink {
  std::vector<double> frame_times;
  std::vector<HistorySample> samples;
  std::vector<double> steps;  ///< dt of each
  std::function<void(const Model&, double time)> on_frame;

  void frame(const Model& model, const ParticleStates&, double time, std::int64_t) override {
    frame_times.push_back(time);
    if (on_frame) on_frame(model, time);
  }
  void sample(const HistorySample& sample) override { samples.push_back(sample); }
  void progress(double, double, std::int64_t, double dt) override { steps.push_back(dt); }
};

}  // namespace scarp::test

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/core/frame_sink.hpp"
#include "solver/core/run_out.hpp"
#include "tools/pipeline/pipeline.hpp"
#include "tools/pipeline/stopwatch.hpp"
#include "tools/pipeline/write_probes.hpp"

namespace scarp {

/// Removes the frames, their list, the history and the probes that an earlier run left.
void clear_earlier_run(const Artefacts& artefacts);

/// Receives a run and keeps it: a file per frame, their list, and the history and the probes up to the last frame. What
/// has its final name is whole at any moment.
class RunWriter : public FrameSink {
 public:
  /// Clears what an earlier run left, so that frames of two runs never mix.
  RunWriter(const Project& project, const Model& model);

  bool takes_blocks() const override { return true; }
  void frame(const Model& model, const ParticleStates& states, double time, std::int64_t step) override;
  void sample(const HistorySample& sample) override;
  bool watches() const override { return !project_.scenario.probes.empty(); }
  void look(const Model& model, const HistorySample& sample) override;
  void progress(double time, double end_time, std::int64_t step, double dt) override;
  /// Measures the run-out.
  void end(const Model& model, const ParticleStates& states) override;
  /// Writes the samples since the last frame.
  void finish();

  ProbeWriter& probes() { return probes_; }
  std::size_t frames() const { return series_.size(); }
  const RunOut& run_out() const { return run_out_; }
  /// Particles that ended outside the domain.
  std::size_t outside() const { return outside_; }
  /// Time spent in here, to be taken off the solver's.
  double wall() const { return wall_; }
  double processor() const { return processor_; }

 private:
  const Project& project_;
  Vec3 origin_;
  ProbeWriter probes_;
  std::vector<std::pair<std::string, double>> series_;
  std::string history_;
  RunOut run_out_;
  std::size_t outside_ = 0;
  bool has_contact_ = false;
  std::vector<std::size_t> force_columns_;  ///< bodies whose contact force history.csv has
  double wall_ = 0, processor_ = 0;
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solver/model/solver_options.hpp"

namespace scarp {

/// When the next frame and the next history sample are due, and how a step is cut so that the run meets these
/// times exactly. Due times are whole multiples of the intervals: they do not drift.
class OutputClock {
 public:
  OutputClock(const OutputOptions& output, double end_time);

  /// The largest step <= `stable` that does not leave a sliver: the last two steps before a due time share
  /// what remains.
  double clip(double time, double stable) const;

  /// The time after a step of clip's length: exactly the due time where it is met.
  double after(double time, double dt) const;

  bool frame_due(double time) const { return time >= due(frame_, every_); }
  bool sample_due(double time) const { return time >= due(sample_, history_every_); }
  void frame_done() { ++frame_; }
  void sample_done() { ++sample_; }
  double end_time() const { return end_time_; }

 private:
  double due(std::int64_t count, double interval) const;
  double next_due() const;

  double every_, history_every_, end_time_;
  std::int64_t frame_ = 1, sample_ = 1;
};

/// The intervals that hold: as stated, or a twentieth of the end time and a tenth of that.
double frame_interval(const OutputOptions& output, double end_time);
double history_interval(const OutputOptions& output, double end_time);

}  // namespace scarp

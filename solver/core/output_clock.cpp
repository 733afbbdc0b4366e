// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/output_clock.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {

double frame_interval(const OutputOptions& output, double end_time) { return output.every.value_or(end_time / 20); }

double history_interval(const OutputOptions& output, double end_time) {
  return output.history_every.value_or(frame_interval(output, end_time) / 10);
}

OutputClock::OutputClock(const OutputOptions& output, double end_time)
    : every_(frame_interval(output, end_time)),
      history_every_(history_interval(output, end_time)),
      end_time_(end_time) {}

/// Multiples that differ from a frame's time or the end time by rounding are that time, so that no step is
/// spent between them.
double OutputClock::due(std::int64_t count, double interval) const {
  const double time = static_cast<double>(count) * interval;
  const double slack = 1e-9 * std::min(every_, history_every_);
  if (time >= end_time_ - slack) return end_time_;
  const double of_frame = std::round(time / every_) * every_;
  return std::abs(time - of_frame) <= slack ? of_frame : time;
}

double OutputClock::next_due() const { return std::min(due(frame_, every_), due(sample_, history_every_)); }

double OutputClock::clip(double time, double stable) const {
  const double left = next_due() - time;
  if (left <= stable) return left;
  return left < 2 * stable ? 0.5 * left : stable;
}

double OutputClock::after(double time, double dt) const {
  const double next = next_due();
  return dt >= next - time ? next : time + dt;
}

}  // namespace scarp

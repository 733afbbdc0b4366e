// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/ground_motion.hpp"
#include "solver/model/shaking_options.hpp"

namespace scarp {

/// Takes drift out of a record (Boore and Bommer 2005): its integrals would otherwise carry the ground away.
///
/// high_pass: a Butterworth filter of second order by the bilinear transform, run forwards and backwards over the
/// record with zeros before and after it, so that phases stay; for records of one interval. baseline: the polynomial
/// without constant term that fits the velocity, the record's exact integral, best by least squares over its samples;
/// its derivative is subtracted from the accelerations.
///
/// @throws Error ("ingest") where a record with varying intervals is to be filtered, or the frequency is not below half
///         of the sampling rate.
void correct(AccelerationRecord& record, Baseline baseline, std::optional<double> high_pass);

/// Of a record: its peaks and where it ends, in magnitude and m, s.
struct RecordReport {
  double duration = 0, peak_acceleration = 0, peak_velocity = 0, peak_displacement = 0;
  double end_velocity = 0, end_displacement = 0;
};
RecordReport report_of(const GroundMotion& motion);

}  // namespace scarp

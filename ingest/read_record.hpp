// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "solver/model/ground_motion.hpp"
#include "solver/model/shaking_options.hpp"

namespace scarp {

/// Reads a record of acceleration, in m/s2.
///
/// .at2 is the format of PEER's NGA database: free text up to the line with NPTS and DT ("NPTS= 4000, DT= .0100 SEC" or
/// "4000 0.0100 NPTS, DT"), then NPTS accelerations, at times 0, DT, ...; "UNITS OF G" in the text tells the unit.
/// Anything else is text with two columns, time in s and acceleration, separated by commas, semicolons or blanks; a
/// header may name them, with the unit of the second in brackets: time (s), acceleration (g). Comments start with #.
///
/// @param unit  of the accelerations, over what the file says
/// @throws Error with the line: no unit anywhere, a value that is no number or not finite, times that do not rise,
///         fewer or more values than NPTS, fewer than two samples.
AccelerationRecord read_record(const std::filesystem::path& path, std::optional<AccelerationUnit> unit);

}  // namespace scarp

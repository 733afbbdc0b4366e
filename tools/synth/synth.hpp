// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/heightfield.hpp"
#include "solver/model/point_cloud.hpp"
#include "solver/model/synth_options.hpp"

namespace scarp {

struct SyntheticResult {
  /// In the order of the sweep; site coordinates (site_offset added), origin 0, no CRS. Has colour, intensity,
  /// classification, return_number and number_of_returns.
  PointCloud cloud;
  /// The bare ground, exact at the cell centres, which run from site_offset to site_offset + size or just beyond.
  Heightfield truth;
};

/// The virtual scanner (see SyntheticScan): a procedural slope seen from one position, with the faults of a real
/// scan. The same bits for any number of threads.
/// @throws Error ("synth") for options out of their range or that contradict each other, a scanner below the
///         ground or one that sees nothing, and demands beyond 3e8 rays or 1e8 cells of truth.
SyntheticResult synthesize(const SyntheticScan& scan, int threads);

/// Elevation of the bare ground, m, where x and y are before site_offset. The formula is in terrain.hpp.
double ground_height(const SyntheticScan& scan, double x, double y);

/// What of ground_height is due to the slide, m: negative in the scar, positive in the lobe, 0 elsewhere.
double slide_change(const SyntheticScan& scan, double x, double y);

}  // namespace scarp

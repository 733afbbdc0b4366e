// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/point_cloud.hpp"
#include "tools/synth/sweep.hpp"

namespace scarp {

/// Makes of the bare hits what a scanner would deliver, one point per hit and in their order: some come from
/// vegetation or are strays, all have noise, colour, intensity and an ASPRS class (2 ground, 5 vegetation,
/// 7 stray below the ground, 18 stray above).
///
/// Vegetation grows in patches and hardly where the slide went, but its share of all points is as asked for in
/// the mean. Strays are at least 2 m off the ground and, above, clear of the tallest vegetation.
PointCloud make_returns(const SyntheticScan& scan, const Ground& ground, const std::vector<Hit>& hits, int threads);

}  // namespace scarp

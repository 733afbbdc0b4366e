// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/compare_options.hpp"
#include "tools/compare/comparison.hpp"

namespace scarp {

/// Cloud-to-cloud distance: of each simulated point to the nearest observed one, Euclidean, never negative, and its
/// split (dx, dy, dz) = observed - simulated. All four are NaN where the nearest observed point is farther than
/// `max_distance` (m). Of equally near observed points the first counts.
///
/// The cloud of the result is the simulated one in its own frame, with the scalars "distance", "dx", "dy", "dz" (m)
/// before any others. The clouds may have different origins (see common_origin). That both are in the same CRS is
/// for the caller to see to. The same bits for any number of threads.
/// @throws Error for an empty cloud, a position that is not finite, or a max_distance that is not above zero.
Comparison compare_c2c(PointCloud simulated, const PointCloud& observed, const CompareOptions& options, int threads);

}  // namespace scarp

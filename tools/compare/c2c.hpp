// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/compare_options.hpp"
#include "tools/compare/comparison.hpp"

namespace scarp {

/// Cloud-to-cloud distance: of each simulated point to the nearest observed one, Euclidean, never negative, and its
/// split (dx, dy, dz) = observed - simulated. All four are NaN where the nearest observed point is farther than
/// `max_distance` (m). Of equally near observed points the first counts. With a local model (see C2cOptions) the
/// distance to the model takes the place of a larger one to the nearest point, and "signed_distance" is that to the
/// model, positive where it lies above the simulated point (observed - simulated along its upward normal).
///
/// The report also holds the Hausdorff and chamfer distances of the two sets. The cloud of the result is the simulated
/// one in its own frame, with these scalars (m) before any others. The clouds may have different origins (see
/// common_origin). That both are in the same CRS is for the caller to see to. The same bits for any number of threads.
/// @throws Error for an empty cloud, a position that is not finite, or a max_distance that is not above zero.
Comparison compare_c2c(PointCloud simulated, const PointCloud& observed, const CompareOptions& options, int threads);

}  // namespace scarp

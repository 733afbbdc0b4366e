// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/scan_options.hpp"

namespace scarp {

/// Of the points in each cubic voxel the one nearest to their centroid; of equally near ones (to 1e-6 of a voxel)
/// the first. Returns the indices of what is kept, ascending.
///
/// Voxels are half-open, [i size, (i + 1) size) in local coordinates, found through a hash of three 64-bit numbers, so
/// neither extent nor size is limited by memory for a grid. About 64 bytes per voxel and 20 per point are used.
/// @throws Error for a coordinate that is not finite, more than 2^53 voxels away from the origin, or 2^32 points.
std::vector<std::size_t> voxel_thin(const std::vector<Vec3>& positions, const VoxelThin& options);

}  // namespace scarp

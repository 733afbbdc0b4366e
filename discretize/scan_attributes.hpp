// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "discretize/columns.hpp"
#include "solver/model/particles.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

/// For each point [begin, end) of a terrain body the index of a scan point that speaks for it: the nearest to the
/// surface right above it, so that a whole column takes after its top; a surface point that is not the highest of its
/// column (a steep face) has its own nearest.
std::vector<std::uint32_t> find_scan_points(const SubLattice& grid, const Columns& columns, const PointCloud& scan,
                                            std::size_t begin, std::size_t end, int threads,
                                            const Particles& particles);

/// Gives the points the scan's colours, 16 bits rounded to 8.
void paint(const PointCloud& scan, const std::vector<std::uint32_t>& scan_points, std::size_t begin, int threads,
           Particles& particles);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "solver/model/point_cloud.hpp"

namespace scarp {

/// Where two geometries of different origins are best compared: at the farther origin. Near it coordinates are
/// small, so that moving there loses no digit; moving away from it would.
Vec3 common_origin(const SiteFrame& a, const SiteFrame& b);

/// Positions relative to `origin` instead of `from`.
std::vector<Vec3> moved(std::vector<Vec3> positions, const Vec3& from, const Vec3& origin);

/// @throws Error ("compare") for an empty cloud or a position that is not finite. `which`: "simulated", "observed".
void require_points(const PointCloud& cloud, const std::string& which);

/// Puts scalars first; older ones of the same names give way.
void put_first(PointCloud& cloud, std::vector<PointScalar> scalars);

}  // namespace scarp

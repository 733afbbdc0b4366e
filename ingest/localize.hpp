// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the coordinates of a file to local metres: what is refused, what is converted, what is subtracted.
#pragma once

#include <string>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/point_cloud.hpp"
#include "solver/model/scan_options.hpp"

namespace scarp {

/// Coordinates beyond it are refused: no place on Earth has them, and their doubles are coarser than 0.1 um.
inline constexpr double kFarthestCoordinate = 1e9;  // m

/// The box of a cloud's finite points in site coordinates, heights converted to metres.
Box3 site_bounds(const PointCloud& cloud, HeightUnit height_unit = HeightUnit::metre);

/// The origin that a project subtracts, in whole metres. Zero where all coordinates are below 10,000 m. Otherwise
/// the lower corner of `site_bounds` in x and y, rounded down to a multiple of 100 m; z likewise, but only where
/// the heights themselves reach 10,000 m. An empty box has origin zero.
/// @throws Error for bounds that are not finite or beyond 1e9 m.
Vec3 project_origin(const Box3& site_bounds);

/// Makes `cloud` relative to `origin` (whole metres); its former origin is accounted for. The subtraction is exact
/// wherever the local coordinate is the smaller of the two, i.e. for every cloud near the origin.
/// @throws Error, leaving the cloud as it was, for a coordinate that is not finite or beyond 1e9 m, or an origin
/// that is not whole.
void localize(PointCloud& cloud, const Vec3& origin);

/// Multiplies site heights by the metres in one `unit`. A vertical part of the CRS text would then be wrong and
/// is dropped from it.
/// @throws Error naming the option height_unit, if the CRS text states heights in another unit than metres while
/// `unit` says metres.
void heights_to_metres(PointCloud& cloud, HeightUnit unit, const std::string& source);

/// Refuses what is not projected metres: a geographic or geocentric CRS, a projection in feet, and, where no WKT
/// says otherwise, coordinates that look like degrees: |x| <= 180 and |y| <= 90, less than 1 wide in x and y, more than
/// ten times as high as wide, and not within 10 of zero (as a single column or tree in local metres would be).
/// An EPSG code in feet is not recognised: only WKT states its unit.
/// @throws Error naming `file`.
void require_projected_metres(const PointCloud& cloud, const std::string& file);

/// Refuses two different coordinate reference systems (same_crs); empty ones go with any. `names` and `crs` in the same
/// order.
/// @throws Error naming the two inputs that disagree.
void require_same_crs(const std::vector<std::string>& names, const std::vector<std::string>& crs);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one border to PCL, whose points are single precision. For .cpp files of this folder only.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/model/math.hpp"

namespace pcl {
struct PointXYZ;
template <class Point>
class PointCloud;
}  // namespace pcl

namespace scarp {

/// Widest cloud that PCL is given. Its floats are then 4 mm apart at the rim, and finer towards the middle.
inline constexpr double kWidestForPcl = 100000;  // m

/// The positions minus the centre of their box, as floats; is_dense, since all are finite.
/// @param purpose names the caller in the message
/// @throws Error for a position that is not finite, a box wider than 100 km, or more points than an int counts.
std::shared_ptr<pcl::PointCloud<pcl::PointXYZ>> to_pcl(const std::vector<Vec3>& positions, const std::string& purpose);

}  // namespace scarp

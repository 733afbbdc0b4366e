// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solver/model/point_cloud.hpp"

namespace scarp {

/// Reads a PCD file of the Point Cloud Library: DATA ascii, binary or binary_compressed, any SIZE, TYPE and COUNT.
///
/// What field names mean is told in point_table.hpp, upper case or lower; besides, "rgb" and "rgba" of four bytes are
/// blue, green, red, alpha packed in one number, whether the header calls it real or integer (alpha is not kept).
/// Text coordinates are read as double even where the header says float. Passed over: padding ("_"), and fields with
/// COUNT above 1, which are descriptors and no scalars. An organised cloud (HEIGHT above 1) becomes a list.
/// VIEWPOINT is checked to be seven numbers but NOT applied: it tells where the sensor stood, and the library that
/// defines the format does not move the points by it either.
/// Coordinates that are NaN or infinite (PCL's mark of a missing point) come out as NaN. 0 points are an empty cloud.
///
/// @throws Error with line (text) or byte (binary): no header, a broken one, POINTS other than WIDTH times HEIGHT,
/// more points than the file can hold (before anything is allocated), a corrupt or short block, bad numbers.
PointCloud read_pcd(const std::filesystem::path& path);

}  // namespace scarp

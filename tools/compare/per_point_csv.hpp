// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solver/model/point_cloud.hpp"

namespace scarp {

/// A cloud as text: a header "x,y,z," and the names of the scalars in the cloud's order, and "nx,ny,nz" if it has
/// normals; then one line per point. Positions in site coordinates; every number with the fewest digits that read back
/// the same, NaN as "nan". Names with commas or quotes are quoted (RFC 4180); lines end with a line feed.
std::string per_point_csv(const PointCloud& cloud);

/// Appends a number with the fewest digits that read back the same, plain where a reader would write it so; NaN as
/// "nan".
void append_number(std::string& text, double value);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solver/model/math.hpp"

namespace scarp {

/// How local coordinates relate to the site's: site = local + origin.
///
/// The origin holds whole metres, so that adding and subtracting it is exact for any coordinate below 2^52 mm.
/// There is one origin per project; it and the CRS travel with every artefact.
struct SiteFrame {
  Vec3 origin{0, 0, 0};
  /// Coordinate reference system as the input stated it (WKT, byte for byte, or "EPSG:n"); empty if unknown.
  std::string crs;
};

}  // namespace scarp

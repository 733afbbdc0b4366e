// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace scarp {

enum class CrsKind { unknown, projected, geographic, geocentric };

/// What the text of a coordinate reference system says about units. Nothing is looked up in a database.
struct CrsFacts {
  CrsKind kind = CrsKind::unknown;
  int epsg = 0;                 ///< of the whole system; 0 when not stated
  double horizontal_unit = 0;   ///< m, of a projected system; 0 when not stated
  double vertical_unit = 0;     ///< m; 0 when not stated
  std::string horizontal_part;  ///< the text without its vertical part; the whole text if it has none
};

/// Reads WKT (1 and 2, ESRI's dialect too), "EPSG:n", "OGC:CRS84", and "+proj=longlat". Of any other or broken text it
/// knows nothing: kind unknown, all zero.
CrsFacts read_crs(const std::string& text);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace scarp {

/// Whether two texts name one coordinate reference system for data in x east, y north, whatever dialect they are in
/// (WKT 1 and 2, ESRI's, "EPSG:n", a URN): the same but for blanks, the same EPSG code, or equivalent by PROJ's
/// database (OSRIsSame), which knows names and aliases of datums. A text without a vertical part goes with any; two
/// vertical parts must be equivalent too. A build without GDAL, or a text that PROJ cannot read, knows only the first
/// two reasons.
bool same_crs(const std::string& a, const std::string& b);

}  // namespace scarp

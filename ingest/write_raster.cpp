// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/write_raster.hpp"

#include <cmath>
#include <string>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"

namespace scarp {

void write_raster(const std::filesystem::path& path, const Heightfield& field) {
  constexpr double no_data = -9999;
  std::string text = "ncols " + std::to_string(field.columns) + "\nnrows " + std::to_string(field.rows) +
                     "\nxllcenter " + shortest(field.x0 + field.site.origin[0]) + "\nyllcenter " +
                     shortest(field.y0 + field.site.origin[1]) + "\ncellsize " + shortest(field.cell) +
                     "\nNODATA_value -9999\n";
  for (int row = field.rows - 1; row >= 0; --row)
    for (int column = 0; column < field.columns; ++column) {
      const double z = field.at(column, row) + field.site.origin[2];
      if (z == no_data) throw Error("write", path.string() + ": a height equals the no-data value", "-9999");
      text += std::isnan(z) ? "-9999" : shortest(z);
      text += column + 1 < field.columns ? ' ' : '\n';
    }
  write_whole(path, text);
  if (!field.site.crs.empty()) write_whole(std::filesystem::path(path).replace_extension(".prj"), field.site.crs);
}

}  // namespace scarp

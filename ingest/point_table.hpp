// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver/model/error.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

/// How a colour channel is scaled in a file.
enum class ColourScale {
  byte,   ///< 0..255
  word,   ///< 0..65535
  real,   ///< 0..1; but 0..255 or 0..65535 if any value is above 1
  guess,  ///< integers 0..255 or 0..65535 by the greatest; 0..1 if any has a fraction
};

struct TableColumn {
  std::string name;
  ColourScale colour = ColourScale::guess;
};

/// Rows of numbers with named columns on their way to a cloud: the one place that knows what names mean, for all
/// formats without a fixed record.
///
/// Names are compared without case, "_", "-", blanks, a leading "scalar_" (CloudCompare) and a unit in brackets:
///   x | easting east e     y | northing north n     z | elevation elev height altitude alt
///   nx ny nz | normal_x …  red green blue | r g b diffuse_red …     intensity     classification | class label
///   return_number     number_of_returns     gps_time
/// A column after the bar counts only where none before it is there. The other columns become scalars, with "[m]"
/// at the end of a name as their unit; and so do columns whose values do not fit what the name says: an intensity
/// or class that is no integer or out of its range (PTS intensities from -2048), colours out of every scale,
/// normals or colours of which a part is missing. Nothing is lost, nothing is bent to fit.
class PointTable {
 public:
  /// @throws Error if x, y or z is missing or there twice, or two columns have the same name.
  PointTable(std::vector<TableColumn> columns, const SourceLocation& header);

  std::size_t columns() const { return columns_.size(); }
  std::size_t rows() const { return positions_.size(); }
  void reserve(std::size_t rows);

  /// `row` has columns() numbers. Infinite coordinates become NaN.
  void add_row(const double* row);

  /// Values of a column other than x, y, z.
  const std::vector<double>& values(std::size_t column) const { return values_[column]; }
  void rename(std::size_t column, std::string name) { columns_[column].name = std::move(name); }

  /// Normals are made unit vectors (zero where the file has none); 8-bit colours are multiplied by 257.
  PointCloud into_cloud() &&;

 private:
  bool take_colour(const std::array<int, 3>& columns, PointCloud& cloud);
  void take_normals(const std::array<int, 3>& columns, PointCloud& cloud);

  std::vector<TableColumn> columns_;
  std::array<std::size_t, 3> coordinate_;    ///< columns of x, y, z
  std::vector<std::size_t> other_;           ///< the rest
  std::vector<std::vector<double>> values_;  ///< by column; empty for x, y, z
  std::vector<Vec3> positions_;
};

}  // namespace scarp

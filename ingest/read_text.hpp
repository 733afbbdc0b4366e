// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solver/model/point_cloud.hpp"

namespace scarp {

/// Reads points from text: XYZ, TXT, CSV, PTS, and what CloudCompare calls ASCII cloud. One point per line.
///
/// Separators are blanks and tabs, or commas, or semicolons, found from the first line. Lines that are blank or start
/// with # or // are passed over, except that one such line just before the data is the header if it names x, y and z
/// and as many columns as there are. A first line that is not all numbers is a header; what the names mean is told
/// in point_table.hpp. Without a header the columns are x y z and then
///   - 3 more, or 4 more, that end in three integers 0..255 on every line: [intensity] red green blue;
///   - in a file with a count line (PTS), one more: intensity;
///   - else scalars "column_4", "column_5", …
/// A line with a single integer before the data is a count line: that many points follow, then nothing or another
/// such block. An empty cell between commas is NaN; coordinates that are NaN or infinite come out as NaN.
///
/// @throws Error with line and column: a cell that is no number (decimal commas get their own message), a line with
/// another number of cells than the first, fewer than three columns, no points, a broken promise of the count line.
PointCloud read_text(const std::filesystem::path& path);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ingest/read_buffered.hpp"

namespace scarp {

/// The whole of `token` as a number, whatever the locale: 1, -2.5, +3e-4, nan, inf; empty if it is not one, or is
/// beyond the range of a double.
std::optional<double> number_of(std::string_view token);

/// The whole of `token` as a count: decimal digits below 2^64, no sign.
std::optional<std::uint64_t> count_of(std::string_view token);

/// What stands between two cells of a line: ' ' for any run of blanks and tabs, or ',' or ';'.
char separator_of(std::string_view line);

/// The cells of a line, without the blanks and the quotation marks around them. With ' ' no cell is empty.
std::vector<std::string_view> split(std::string_view line, char separator);

/// Reads a line of numbers into `values`. An empty cell between ',' or ';' is NaN.
/// @throws Error at the line and column of a cell that is not a number.
void read_numbers(std::string_view line, char separator, const BufferedFile& file, std::vector<double>& values);

/// A token as it can be shown in a message: shortened, unprintable bytes as '?', in quotation marks.
std::string shown(std::string_view token);

std::string lower_case(std::string_view text);
std::string_view trimmed(std::string_view text);

/// A blank line, or one that starts with # or //.
bool is_blank(std::string_view line);
bool is_comment(std::string_view line);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/text_scanner.hpp"

#include <charconv>
#include <cmath>

namespace scarp {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t'; }

/// Reads the number at `first`; returns where it ends, or null.
const char* scan_number(const char* first, const char* last, double& value) {
  if (first != last && *first == '+' && first + 1 != last && first[1] != '-') ++first;
  const auto [end, code] = std::from_chars(first, last, value);
  return code == std::errc() ? end : nullptr;
}

/// Why `cell` of `line` is no number, in words that help.
[[noreturn]] void refuse_cell(std::string_view line, std::string_view cell, char separator, const BufferedFile& file) {
  const SourceLocation where = file.at_line(static_cast<std::size_t>(cell.data() - line.data()) + 1);
  double ignored;
  const char* last = cell.data() + cell.size();
  const char* end = scan_number(cell.data(), last, ignored);
  const bool comma_after_digits = end && end != last && *end == ',';
  const bool blank_after_digits = separator == ',' && end && end != last && is_space(*end);
  if (comma_after_digits || blank_after_digits)
    throw Error("ingest", "decimal comma, or two kinds of separator in one line", shown(cell),
                "a point as decimal mark, and one separator: blanks, tabs, ',' or ';'", where);
  throw Error("ingest", "not a number", shown(cell), "a decimal number such as 5412345.678 or -1.5e-3, or nan", where);
}

void read_spaced(std::string_view line, const BufferedFile& file, std::vector<double>& values) {
  const char* cursor = line.data();
  const char* last = cursor + line.size();
  for (;;) {
    while (cursor != last && is_space(*cursor)) ++cursor;
    if (cursor == last) return;
    double value;
    const char* end = scan_number(cursor, last, value);
    if (!end || (end != last && !is_space(*end))) {
      const char* stop = cursor;
      while (stop != last && !is_space(*stop)) ++stop;
      refuse_cell(line, {cursor, static_cast<std::size_t>(stop - cursor)}, ' ', file);
    }
    values.push_back(value);
    cursor = end;
  }
}

/// Without the blanks and one pair of quotation marks around it.
std::string_view bare_cell(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = trimmed(cell.substr(1, cell.size() - 2));
  return cell;
}

/// Calls f(cell) for each cell between `separator`s.
template <class F>
void for_each_cell(std::string_view line, char separator, F&& f) {
  for (std::size_t start = 0;;) {
    const std::size_t stop = line.find(separator, start);
    f(bare_cell(line.substr(start, stop == std::string_view::npos ? stop : stop - start)));
    if (stop == std::string_view::npos) return;
    start = stop + 1;
  }
}

}  // namespace

std::optional<double> number_of(std::string_view token) {
  double value;
  const char* last = token.data() + token.size();
  if (scan_number(token.data(), last, value) != last || token.empty()) return {};
  return value;
}

std::optional<std::uint64_t> count_of(std::string_view token) {
  std::uint64_t value;
  const char* last = token.data() + token.size();
  const auto [end, code] = std::from_chars(token.data(), last, value);
  if (code != std::errc() || end != last) return {};
  return value;
}

char separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  return line.find(',') != std::string_view::npos ? ',' : ' ';
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  if (separator != ' ') {
    for_each_cell(line, separator, [&](std::string_view cell) { cells.push_back(cell); });
    return cells;
  }
  for (std::size_t i = 0; i < line.size();) {
    while (i < line.size() && is_space(line[i])) ++i;
    std::size_t stop = i;
    while (stop < line.size() && !is_space(line[stop])) ++stop;
    if (stop > i) cells.push_back(bare_cell(line.substr(i, stop - i)));
    i = stop;
  }
  return cells;
}

void read_numbers(std::string_view line, char separator, const BufferedFile& file, std::vector<double>& values) {
  values.clear();
  if (separator == ' ') return read_spaced(line, file, values);
  for_each_cell(line, separator, [&](std::string_view cell) {
    const std::optional<double> value = cell.empty() ? NAN : number_of(cell);
    if (!value) refuse_cell(line, cell, separator, file);
    values.push_back(*value);
  });
}

std::string shown(std::string_view token) {
  constexpr std::size_t kShown = 40;
  std::string text = "'";
  for (char c : token.substr(0, kShown)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (token.size() > kShown ? "…'" : "'");
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

bool is_blank(std::string_view line) { return trimmed(line).empty(); }

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.starts_with('#') || text.starts_with("//");
}

}  // namespace scarp

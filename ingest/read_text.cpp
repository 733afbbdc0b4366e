// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "ingest/point_table.hpp"
#include "ingest/read_buffered.hpp"
#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

/// What is known before the first point.
struct Layout {
  char separator = ' ';
  std::vector<TableColumn> columns;
  bool named = false;                    ///< by a header or a comment
  bool first_line_is_header = false;     ///< so the points start after it
  std::optional<std::uint64_t> counted;  ///< points in this block, by a count line
};

std::vector<TableColumn> named_columns(const std::vector<std::string_view>& cells) {
  std::vector<TableColumn> columns;
  for (std::string_view cell : cells)
    columns.push_back({cell.empty() ? "column_" + std::to_string(columns.size() + 1) : std::string(cell)});
  return columns;
}

std::vector<TableColumn> numbered_columns(std::size_t count) {
  std::vector<TableColumn> columns{{"x"}, {"y"}, {"z"}};
  while (columns.size() < count) columns.push_back({"column_" + std::to_string(columns.size() + 1)});
  return columns;
}

bool names_coordinates(const std::vector<TableColumn>& columns) {
  return std::all_of(kAxes.begin(), kAxes.end(), [&](std::string_view axis) {
    return std::any_of(columns.begin(), columns.end(), [&](auto& column) { return lower_case(column.name) == axis; });
  });
}

/// The names in a comment such as "//X Y Z Intensity" or "# x,y,z"; empty unless x, y and z are among them.
std::vector<TableColumn> names_in_comment(std::string_view comment) {
  comment.remove_prefix(std::min(comment.find_first_not_of("#/ \t"), comment.size()));
  auto columns = named_columns(split(comment, separator_of(comment)));
  if (!names_coordinates(columns)) columns.clear();
  return columns;
}

/// A header has no numbers, or has x, y and z; and does not begin as a number does, were it one with a decimal comma.
bool is_header(const std::vector<std::string_view>& cells) {
  if (cells.empty() || number_of(cells[0]) || cells[0].find_first_of("0123456789+-.") == 0) return false;
  return std::none_of(cells.begin(), cells.end(), [](auto cell) { return number_of(cell).has_value(); }) ||
         names_coordinates(named_columns(cells));
}

/// Decides the columns from the first line that is neither blank, comment nor count.
void find_columns(std::string_view line, const std::vector<TableColumn>& comment_names, const BufferedFile& file,
                  Layout& layout) {
  layout.separator = separator_of(line);
  std::vector<std::string_view> cells = split(line, layout.separator);
  while (!cells.empty() && cells.back().empty()) cells.pop_back();  // a separator at the end starts no column
  layout.first_line_is_header = !layout.counted && is_header(cells);
  if (!layout.first_line_is_header && cells.size() < 3)
    throw Error("ingest", "too few columns for points", shown(line), "at least three: x y z", file.at_line());
  const bool named_before = cells.size() == comment_names.size();
  layout.named = layout.first_line_is_header || named_before;
  layout.columns = layout.first_line_is_header ? named_columns(cells)
                   : named_before              ? comment_names
                                               : numbered_columns(cells.size());
}

/// The points: from the line at hand, if any, to the end of the file.
class Rows {
 public:
  Rows(BufferedFile& file, Layout& layout, PointTable& table) : file_(file), layout_(layout), table_(table) {}

  void read(std::string_view first_line) {
    if (!layout_.first_line_is_header) add(first_line);
    std::string_view line;
    while (file_.next_line(line))
      if (!is_blank(line) && !is_comment(line)) add(line);
    if (layout_.counted && *layout_.counted != block_rows_) refuse_count("fewer");
    if (table_.rows() == 0) throw Error("ingest", "holds no points", {}, {}, file_.at_line());
  }

 private:
  void add(std::string_view line) {
    read_numbers(line, layout_.separator, file_, values_);
    if (layout_.counted && block_rows_ == *layout_.counted) return start_block(line);
    // One separator at the end of a line is no further cell.
    if (values_.size() == table_.columns() + 1 && layout_.separator != ' ' && trimmed(line).back() == layout_.separator)
      values_.pop_back();
    if (values_.size() != table_.columns())
      throw Error("ingest", "line with another number of columns than the lines before it",
                  std::to_string(values_.size()), std::to_string(table_.columns()), file_.at_line());
    table_.add_row(values_.data());
    ++block_rows_;
  }

  void start_block(std::string_view line) {
    const auto count = count_of(trimmed(line));
    if (!count) refuse_count("more");
    layout_.counted = count;
    block_rows_ = 0;
  }

  [[noreturn]] void refuse_count(const char* relation) const {
    throw Error("ingest", std::string("file holds ") + relation + " points than its count line promises",
                (*relation == 'm' ? "more than " : "") + std::to_string(block_rows_), std::to_string(*layout_.counted),
                file_.at_line());
  }

  BufferedFile& file_;
  Layout& layout_;
  PointTable& table_;
  std::vector<double> values_;
  std::uint64_t block_rows_ = 0;
};

bool all_bytes(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v >= 0 && v <= 255 && v == std::floor(v); });
}

/// Names the columns after x y z of a file without header, now that all values are known.
void name_columns(PointTable& table, bool counted) {
  const std::size_t n = table.columns();
  const bool coloured = (n == 6 || n == 7) && all_bytes(table.values(n - 3)) && all_bytes(table.values(n - 2)) &&
                        all_bytes(table.values(n - 1));
  if (coloured) {
    table.rename(n - 3, "red");
    table.rename(n - 2, "green");
    table.rename(n - 1, "blue");
  }
  if ((counted && n == 4) || (coloured && n == 7)) table.rename(3, "intensity");
}

}  // namespace

PointCloud read_text(const std::filesystem::path& path) {
  BufferedFile file(path);
  if (file.peek().starts_with("\xEF\xBB\xBF")) file.skip(3);  // byte order mark of UTF-8
  Layout layout;
  std::vector<TableColumn> comment_names;
  std::string_view line;
  for (;;) {
    if (!file.next_line(line)) throw Error("ingest", "holds no points", {}, "lines of numbers", file.at_line());
    if (is_blank(line)) continue;
    if (is_comment(line))
      comment_names = names_in_comment(line);
    else if (!layout.counted && count_of(trimmed(line)))
      layout.counted = count_of(trimmed(line));
    else
      break;
  }
  find_columns(line, comment_names, file, layout);
  PointTable table(layout.columns, file.at_line());
  const bool counted = layout.counted.has_value();
  Rows(file, layout, table).read(line);
  if (!layout.named) name_columns(table, counted);
  return std::move(table).into_cloud();
}

}  // namespace scarp

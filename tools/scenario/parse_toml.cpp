// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/parse_toml.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <toml.hpp>

namespace scarp {
namespace {

/// Line and column of a byte, by bisection over the starts of the lines.
class LineIndex {
 public:
  explicit LineIndex(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') starts_.push_back(i + 1);
  }
  void locate(std::size_t offset, Place& place) const {
    const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
    place.line = static_cast<int>(next - starts_.begin());
    place.column = static_cast<int>(offset - *std::prev(next)) + 1;
  }

 private:
  std::vector<std::size_t> starts_{0};
};

bool is_bare(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; }

/// Where the key stands whose value begins at `value`: the token before the '=' that precedes it; `value` itself if
/// there is no such token (headers of tables).
std::size_t key_offset(const std::string& text, std::size_t value) {
  std::size_t i = value;
  const auto skip_blanks = [&] {
    while (i > 0 && (text[i - 1] == ' ' || text[i - 1] == '\t')) --i;
  };
  skip_blanks();
  if (i == 0 || text[i - 1] != '=') return value;
  --i;
  skip_blanks();
  if (i == 0) return value;
  const char last = text[i - 1];
  if (last == '"' || last == '\'') {
    const std::size_t open = i >= 2 ? text.rfind(last, i - 2) : std::string::npos;
    return open == std::string::npos ? value : open;
  }
  while (i > 0 && is_bare(text[i - 1])) --i;
  return i;
}

/// Numbers are read again from their text: the library saturates in silence and rounds by way of a stream.
void read_number(Node& node, const std::string& raw, bool whole) {
  std::string digits;
  for (const char c : raw)
    if (c != '_' && c != '+') digits += c;
  const char* first = digits.data();
  const char* last = first + digits.size();
  if (whole) {
    int base = 10;
    if (digits.starts_with("0x")) base = 16;
    if (digits.starts_with("0o")) base = 8;
    if (digits.starts_with("0b")) base = 2;
    const auto result = std::from_chars(base == 10 ? first : first + 2, last, node.integer, base);
    node.floating = static_cast<double>(node.integer);
    if (result.ec == std::errc()) return;
    node.kind = Node::Kind::floating;
    if (base != 10) {
      node.floating = std::numeric_limits<double>::quiet_NaN();
      return;
    }
  }
  if (std::from_chars(first, last, node.floating).ec != std::errc())
    node.floating = std::numeric_limits<double>::quiet_NaN();
}

class Converter {
 public:
  Converter(const std::string& text, const std::string& name)
      : text_(text), lines_(text), file_(std::make_shared<const std::string>(name)) {}

  Node convert(const toml::value& value) const {
    Node node;
    convert_into(node, value, 0);
    node.place = node.key_place = Place{file_, 1, 1};
    return node;
  }

 private:
  struct Span {
    std::size_t first = 0, last = 0;
  };
  Span span_of(const toml::value& value, std::size_t fallback) const {
    const auto* region = dynamic_cast<const toml::detail::region*>(toml::detail::get_region(value));
    if (!region) return {fallback, fallback};
    return {static_cast<std::size_t>(region->first() - region->begin()),
            static_cast<std::size_t>(region->last() - region->begin())};
  }

  void convert_into(Node& node, const toml::value& value, std::size_t fallback) const {
    const Span span = span_of(value, fallback);
    const std::string_view raw = std::string_view(text_).substr(span.first, span.last - span.first);
    node.place.file = node.key_place.file = file_;
    lines_.locate(span.first, node.place);
    lines_.locate(key_offset(text_, span.first), node.key_place);
    node.written = shortened(raw.substr(0, 200));
    node.kind = kind_of(value.type());
    if (value.is_table()) {
      for (const auto& [key, child] : value.as_table()) {
        Node& entry = node.children.emplace_back();
        convert_into(entry, child, span.first);
        entry.key = key;
      }
      // The library's tables forget the order of the file.
      std::sort(node.children.begin(), node.children.end(), [](const Node& a, const Node& b) {
        return std::tie(a.key_place.line, a.key_place.column, a.key) <
               std::tie(b.key_place.line, b.key_place.column, b.key);
      });
    } else if (value.is_array()) {
      node.children.reserve(value.as_array().size());
      for (const toml::value& item : value.as_array()) convert_into(node.children.emplace_back(), item, span.first);
    } else if (value.is_string()) {
      node.text = value.as_string().str;
    } else if (value.is_boolean()) {
      node.boolean = value.as_boolean();
    } else if (node.is_number()) {
      read_number(node, std::string(raw), value.is_integer());
    }
  }

  static Node::Kind kind_of(toml::value_t type) {
    switch (type) {
      case toml::value_t::table:
        return Node::Kind::table;
      case toml::value_t::array:
        return Node::Kind::array;
      case toml::value_t::string:
        return Node::Kind::string;
      case toml::value_t::integer:
        return Node::Kind::integer;
      case toml::value_t::floating:
        return Node::Kind::floating;
      case toml::value_t::boolean:
        return Node::Kind::boolean;
      default:
        return Node::Kind::date;
    }
  }

  const std::string& text_;
  LineIndex lines_;
  std::shared_ptr<const std::string> file_;
};

/// What the library draws below a line of the source: "  | ^--- comment".
struct Mark {
  int line = 0, column = 0;
  std::string comment;
};

/// Reads the marks out of the library's drawing; see the sample in the tests.
std::vector<Mark> marks_of(const std::string& drawing) {
  std::vector<Mark> marks;
  std::istringstream lines(drawing);
  std::string line;
  int current = 0;
  while (std::getline(lines, line)) {
    const std::size_t bar = line.find(" | ");
    if (bar == std::string::npos) continue;
    const std::size_t digit = line.find_first_not_of(' ');
    if (digit < bar) {
      int number = 0;
      const auto [end, code] = std::from_chars(line.data() + digit, line.data() + bar, number);
      if (code == std::errc() && end == line.data() + bar) current = number;
      continue;
    }
    const std::size_t mark = line.find_first_not_of(' ', bar + 2);
    if (current == 0 || mark == std::string::npos || (line[mark] != '^' && line[mark] != '~')) continue;
    const std::size_t comment = line.find_first_not_of("^~- ", mark);
    marks.push_back(
        {current, static_cast<int>(mark - bar) - 2, comment == std::string::npos ? "" : line.substr(comment)});
  }
  return marks;
}

/// One helpful line of the library's drawing: its title without the name of a function, and its comments. The
/// last mark is the place that is wrong; the others say what it clashes with.
[[noreturn]] void throw_syntax_error(const toml::exception& error, const std::string& name) {
  const std::string drawing = error.what();
  std::string title = drawing.substr(0, drawing.find('\n'));
  if (title.starts_with("[error] ")) title.erase(0, 8);
  const std::size_t colon = title.find(": ");
  const bool names_a_function = colon != std::string::npos && title.substr(0, colon).find(' ') == std::string::npos;
  if (names_a_function) title.erase(0, colon + 2);
  if (title.ends_with(".")) title.pop_back();
  const std::vector<Mark> marks = marks_of(drawing);
  SourceLocation where{name, static_cast<int>(error.location().line()), static_cast<int>(error.location().column())};
  if (title.ends_with(" already exists") && marks.size() == 2) {
    const std::size_t open = title.find('"'), close = title.rfind('"');
    throw Error("scenario",
                shortened(title.substr(open, close + 1 - open)) + " is set twice; first on line " +
                    std::to_string(marks[0].line),
                {}, {}, {name, marks[1].line, marks[1].column});
  }
  std::string what = "not valid TOML";
  if (!title.empty()) what += ": " + shortened(title);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const bool is_last = i + 1 == marks.size();
    if (is_last) where = {name, marks[i].line, marks[i].column};
    if (marks[i].comment.empty() || marks[i].comment == "here") continue;
    what += "; " + shortened(marks[i].comment);
    if (!is_last) what += " (line " + std::to_string(marks[i].line) + ")";
  }
  throw Error("scenario", what, {}, {}, where);
}

}  // namespace

Node parse_toml(const std::string& text, const std::string& name) {
  check_toml_bounds(text, name);
  try {
    std::istringstream stream(text);
    return Converter(text, name).convert(toml::parse(stream, name));
  } catch (const toml::exception& error) {
    throw_syntax_error(error, name);
  }
}

}  // namespace scarp

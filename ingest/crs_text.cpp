// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/crs_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

namespace scarp {
namespace {

constexpr int kDeepest = 32;  // nesting of brackets; real texts have about 8

/// One KEYWORD["text", number, NODE[...], ...].
struct Node {
  std::string keyword;  ///< upper case
  std::vector<std::string> values;
  std::vector<Node> children;
  std::size_t begin = 0, end = 0;  ///< in the text
};

bool blank(char c) { return std::isspace(static_cast<unsigned char>(c)) || c == '\0'; }

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

class WktReader {
 public:
  explicit WktReader(std::string_view text) : text_(text) {}

  /// The one node that the text is, or nothing if it is not well formed.
  std::optional<Node> read() {
    Node root;
    skip_blanks();
    root.begin = at_;
    const std::string word = read_word();
    if (word.empty() || !opens() || !read_node(root, word, kDeepest)) return std::nullopt;
    skip_blanks();
    return at_ == text_.size() ? std::optional<Node>(std::move(root)) : std::nullopt;
  }

 private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool opens() const { return here() == '[' || here() == '('; }
  void skip_blanks() {
    while (at_ < text_.size() && blank(text_[at_])) ++at_;
  }

  std::string read_word() {
    const std::size_t from = at_;
    while (at_ < text_.size() && !blank(text_[at_]) &&
           std::string_view("[](),\"").find(text_[at_]) == std::string::npos)
      ++at_;
    const std::string word(text_.substr(from, at_ - from));
    skip_blanks();
    return word;
  }

  bool read_quoted(std::string& value) {
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        ++at_;
        if (here() != '"') return true;  // a doubled quote stands for one
      }
      value += text_[at_];
    }
    return false;
  }

  /// From the opening bracket to past the closing one.
  bool read_node(Node& node, const std::string& keyword, int levels) {
    if (levels == 0) return false;
    node.keyword = upper(keyword);
    do {
      ++at_;
      skip_blanks();
      if (!read_item(node, levels)) return false;
      skip_blanks();
    } while (here() == ',');
    if (here() != ']' && here() != ')') return false;
    node.end = ++at_;
    return true;
  }

  bool read_item(Node& node, int levels) {
    if (here() == '"') return read_quoted(node.values.emplace_back());
    const std::size_t from = at_;
    const std::string word = read_word();
    if (word.empty()) return false;
    if (!opens()) {
      node.values.push_back(word);
      return true;
    }
    node.children.emplace_back().begin = from;
    return read_node(node.children.back(), word, levels - 1);
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

bool is_one_of(const Node& node, std::initializer_list<std::string_view> keywords) {
  return std::find(keywords.begin(), keywords.end(), node.keyword) != keywords.end();
}

/// The first such node, outermost first.
const Node* find(const Node& node, std::initializer_list<std::string_view> keywords) {
  if (is_one_of(node, keywords)) return &node;
  for (const Node& child : node.children)
    if (const Node* found = find(child, keywords)) return found;
  return nullptr;
}

double number(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end ? value : 0;
}

/// Metres per unit: UNIT["foot", 0.3048] of the node itself.
double own_unit(const Node& node) {
  for (const Node& child : node.children)
    if (is_one_of(child, {"UNIT", "LENGTHUNIT"}) && child.values.size() > 1) return number(child.values[1]);
  return 0;
}

/// Metres per unit along an axis: its own unit, or the system's.
double axis_unit(const Node& system, std::size_t axis) {
  for (const Node& child : system.children)
    if (child.keyword == "AXIS" && axis-- == 0 && own_unit(child) > 0) return own_unit(child);
  return own_unit(system);
}

int epsg_of(const Node& root) {
  for (const Node& child : root.children)
    if (is_one_of(child, {"AUTHORITY", "ID"}) && child.values.size() > 1 && upper(child.values[0]) == "EPSG")
      return static_cast<int>(std::clamp(number(child.values[1]), 0.0, 1e9));
  return 0;
}

CrsKind kind_of(const Node& system) {
  if (is_one_of(system, {"PROJCS", "PROJCRS", "PROJECTEDCRS"})) return CrsKind::projected;
  if (system.keyword == "GEOCCS") return CrsKind::geocentric;
  const Node* axes = find(system, {"CS"});
  const bool cartesian = axes && !axes->values.empty() && upper(axes->values[0]) == "CARTESIAN";
  return cartesian ? CrsKind::geocentric : CrsKind::geographic;
}

std::size_t count_axes(const Node& system) {
  return static_cast<std::size_t>(
      std::count_if(system.children.begin(), system.children.end(), [](const Node& n) { return n.keyword == "AXIS"; }));
}

CrsFacts facts_of(const Node& root, const std::string& text) {
  CrsFacts facts;
  facts.epsg = epsg_of(root);
  facts.horizontal_part = text;
  const Node* horizontal = find(root, {"PROJCS", "PROJCRS", "PROJECTEDCRS", "GEOGCS", "GEOGCRS", "GEOGRAPHICCRS",
                                       "GEODCRS", "GEODETICCRS", "GEOCCS"});
  const Node* vertical = find(root, {"VERT_CS", "VERTCS", "VERTCRS", "VERTICALCRS"});
  if (horizontal) facts.kind = kind_of(*horizontal);
  if (facts.kind == CrsKind::projected) {
    facts.horizontal_unit = axis_unit(*horizontal, 0);
    if (!vertical && count_axes(*horizontal) > 2) facts.vertical_unit = axis_unit(*horizontal, 2);
  }
  if (vertical) facts.vertical_unit = axis_unit(*vertical, 0);
  if (vertical && horizontal)
    facts.horizontal_part = text.substr(horizontal->begin, horizontal->end - horizontal->begin);
  return facts;
}

/// Geographic systems that scans come in. 4120 to 4326 are all geographic in the EPSG register.
CrsKind kind_of_epsg(int code) {
  if (code == 4978 || code == 4936) return CrsKind::geocentric;
  for (int known : {4612, 4617, 4668, 4674, 4681, 4759, 4936, 4937, 4939, 4955, 4957, 4959, 4979,
                    4490, 4480, 6318, 6319, 6668, 6697, 7664, 7843, 7844, 8252, 9057, 9755})
    if (code == known) return CrsKind::geographic;
  return code >= 4120 && code <= 4326 ? CrsKind::geographic : CrsKind::unknown;
}

std::string without_blanks(const std::string& text) {
  std::string result;
  std::copy_if(text.begin(), text.end(), std::back_inserter(result), [](char c) { return !blank(c); });
  return result;
}

/// n of "EPSG:n" or "urn:ogc:def:crs:EPSG:...:n"; 0 for anything else.
int bare_epsg(const std::string& compact) {
  const std::string text = upper(compact);
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || text.find("EPSG:") == std::string::npos) return 0;
  const double code = number(text.substr(colon + 1));
  return code >= 1 && code <= 1e9 ? static_cast<int>(code) : 0;
}

}  // namespace

CrsFacts read_crs(const std::string& text) {
  if (const std::optional<Node> root = WktReader(text).read()) return facts_of(*root, text);
  CrsFacts facts;
  facts.horizontal_part = text;
  const std::string compact = without_blanks(text);
  facts.epsg = bare_epsg(compact);
  facts.kind = kind_of_epsg(facts.epsg);
  const std::string capitals = upper(compact);
  if (capitals.ends_with("CRS84") || capitals.find("+PROJ=LONGLAT") != std::string::npos)
    facts.kind = CrsKind::geographic;
  return facts;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A TOML text as a tree of values that know where they stand, independent of the library that parsed it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/error.hpp"

namespace scarp {

/// Line and column count from 1; line 0 stands for a text without lines, such as an argument of --set.
struct Place {
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;
};

struct Node {
  enum class Kind { table, array, string, integer, floating, boolean, date };
  Kind kind = Kind::table;
  std::string key;      ///< its name in the table that holds it; empty in an array
  std::string text;     ///< of a string: its characters, escapes resolved
  std::string written;  ///< as the user wrote it, on one line, cut short if it is long
  std::int64_t integer = 0;
  double floating = 0;  ///< also set for an integer; NaN for a number beyond double precision
  bool boolean = false;
  Place place;      ///< of the value
  Place key_place;  ///< of the key; that of the value where the text does not show it
  std::vector<Node> children;

  bool is_table() const { return kind == Kind::table; }
  bool is_array() const { return kind == Kind::array; }
  bool is_string() const { return kind == Kind::string; }
  bool is_number() const { return kind == Kind::integer || kind == Kind::floating; }

  /// The entry of a table, or nullptr.
  const Node* find(std::string_view name) const;
  Node* find(std::string_view name);
};

SourceLocation location(const Place& place);

/// What `steps` lead to from `root` (keys of tables, decimal indices of arrays), or the last thing on the way
/// that exists, so that there is always a place to point at.
const Node& nearest_node(const Node& root, const std::vector<std::string>& steps);

/// Throws what the user can mend about a value, naming its place and the text found.
[[noreturn]] void refuse(const Node& node, const std::string& what, const std::string& allowed = {});

/// One line, at most 60 characters.
std::string shortened(std::string_view text);

}  // namespace scarp

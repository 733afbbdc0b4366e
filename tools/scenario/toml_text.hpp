// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values as TOML text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scarp {

/// Shortest text that reads back to the same double and that TOML takes for a float: 1900.0, 1.0e-7.
/// @throws Error ("scenario") for NaN and infinities.
std::string toml_double(double value);

/// In quotes, with escapes.
std::string toml_string(std::string_view text);

/// Bare where TOML allows it, else in quotes.
std::string toml_key(std::string_view key);

/// A value to be written. Tables keep the order of their entries.
struct TomlValue {
  enum class Kind { scalar, array, table };
  Kind kind = Kind::scalar;
  std::string key;   ///< its name in a table
  std::string text;  ///< of a scalar: the TOML text
  std::vector<TomlValue> children;
};

/// A whole document: plain keys first, [tables] and [[lists of tables]] after them; what fits on a line of 100
/// characters below the top level stays inline; long lists are broken over lines.
std::string print_toml(const TomlValue& root);

/// On one line.
std::string print_inline(const TomlValue& value);

}  // namespace scarp

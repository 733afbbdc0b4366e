// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The schema as rows of a table, for the reference of keys.
#pragma once

#include <string>
#include <vector>

namespace scarp {

struct KeyRow {
  std::string section;    ///< path of the table that holds the key: "bodies[].volume", "materials.NAME"; "" at the top
  std::string condition;  ///< where it exists only in one alternative: `model = "mohr-coulomb"`, `scan`
  std::string key;
  std::string type;      ///< "number", "true or false", "text", ...
  std::string unit;      ///< "" for none
  std::string range;     ///< "above 0", without the unit; "" for none
  std::string fallback;  ///< the default as TOML, or "" if there is none
  bool required = false;
  std::string text;  ///< one sentence

  std::string path() const { return section.empty() ? key : section + "." + key; }
  bool operator==(const KeyRow&) const = default;
};

/// Every key that a scenario can hold, in the order of the schema. Keys that all alternatives of a choice share
/// stand once, without a condition, before those of the single alternatives.
std::vector<KeyRow> schema_rows();

}  // namespace scarp

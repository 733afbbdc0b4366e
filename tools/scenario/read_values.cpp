// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/read_values.hpp"

#include <algorithm>
#include <cmath>

#include "tools/scenario/range_text.hpp"
#include "tools/scenario/suggest.hpp"
#include "tools/scenario/units.hpp"

namespace scarp {
namespace {

/// `a number above 0 m, or text with a unit such as "1 m"`.
std::string allowed_number(const Spec& spec) {
  const std::string range = range_text(spec, spec.unit);
  const std::string unit(spec.unit);
  std::string text = "a number";
  if (!range.empty())
    text += " " + range;
  else if (!unit.empty())
    text += " in " + unit;
  if (!unit.empty()) text += ", or text with a unit such as \"1 " + unit + "\"";
  return text;
}

double number_of(const Node& node, const Spec& spec, const std::string& path) {
  if (node.is_number()) {
    if (!std::isfinite(node.floating)) refuse(node, path + " must be a finite number", allowed_number(spec));
    return node.floating;
  }
  if (!node.is_string()) refuse(node, path + " must be a number", allowed_number(spec));
  const Conversion converted = convert_quantity(node.text, spec.unit);
  if (!converted.problem.empty()) refuse(node, path + " " + converted.problem, allowed_number(spec));
  if (!std::isfinite(converted.value)) refuse(node, path + " is beyond the range of numbers", allowed_number(spec));
  return converted.value;
}

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; });
}

std::string named(const std::string& path) { return path.empty() ? "the scenario" : path; }

}  // namespace

double read_number(const Node& node, const Spec& spec, const std::string& path) {
  const double value = number_of(node, spec, path);
  if (!is_within(value, spec)) refuse(node, path + " is out of range", range_text(spec, spec.unit));
  return value;
}

std::int64_t read_whole_number(const Node& node, const Spec& spec, const std::string& path, std::int64_t least,
                               std::int64_t most) {
  const std::string range = range_text(spec, spec.unit);
  if (node.kind != Node::Kind::integer)
    refuse(node, path + " must be a whole number", "a whole number" + (range.empty() ? "" : " " + range));
  if (!is_within(node.floating, spec)) refuse(node, path + " is out of range", range);
  if (node.integer < least || node.integer > most)
    refuse(node, path + " is out of range", "from " + std::to_string(least) + " to " + std::to_string(most));
  return node.integer;
}

bool read_bool(const Node& node, const std::string& path) {
  if (node.kind != Node::Kind::boolean) refuse(node, path + " must be true or false", "true, false");
  return node.boolean;
}

std::string read_text(const Node& node, const std::string& path) {
  if (!node.is_string()) refuse(node, path + " must be text", "text in quotes");
  return node.text;
}

std::size_t read_enumerator(const Node& node, const std::vector<std::string>& names, const std::string& path) {
  if (!node.is_string()) refuse(node, path + " must be text", quoted_list(names));
  const auto found = std::find(names.begin(), names.end(), node.text);
  if (found == names.end()) refuse(node, path + " is unknown" + did_you_mean(node.text, names), quoted_list(names));
  return static_cast<std::size_t>(found - names.begin());
}

std::string read_input_file(const Node& node, const std::filesystem::path& folder, const std::string& path) {
  const std::string written = read_text(node, path);
  if (written.empty() || has_control_character(written) || written.size() > 4096)
    refuse(node, path + " is not the name of a file", "a path, relative to the scenario's folder or absolute");
  const auto file = std::filesystem::absolute(folder / written).lexically_normal();
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) refuse(node, path + ": there is no file " + file.string());
  if (std::filesystem::is_directory(status)) refuse(node, path + " is a folder: " + file.string(), "a file");
  return file.string();
}

void read_tuple(const Node& node, const Spec& spec, const std::string& path, int count, double* values) {
  const std::string unit = spec.unit.empty() ? "" : " in " + std::string(spec.unit);
  const std::string allowed = "a list of " + std::to_string(count) + " numbers" + unit;
  if (!node.is_array()) refuse(node, path + " must be a list of numbers", allowed);
  if (node.children.size() != static_cast<std::size_t>(count))
    refuse(node, path + " has " + std::to_string(node.children.size()) + " entries", allowed);
  for (int i = 0; i < count; ++i) values[i] = read_number(node.children[i], spec, path + "." + std::to_string(i));
}

void expect_table(const Node& node, const std::string& path) {
  if (!node.is_table()) refuse(node, path + " must be a table", "[" + path + "], or { key = value, ... }");
}

void expect_list(const Node& node, const std::string& path) {
  if (node.is_table())
    throw Error("scenario", path + " must be a list, not a single table", {}, "[[" + path + "]], or [ { ... } ]",
                location(node.place));
  if (!node.is_array()) refuse(node, path + " must be a list", "[ ... ]");
}

void check_known_keys(const Node& table, const std::vector<std::string>& known, const std::string& path,
                      const std::string& context) {
  for (const Node& child : table.children) {
    if (std::find(known.begin(), known.end(), child.key) != known.end()) continue;
    throw Error(
        "scenario",
        "unknown key \"" + shortened(child.key) + "\" in " + named(path) + context + did_you_mean(child.key, known), {},
        quoted_list(known), location(child.key_place));
  }
}

void refuse_missing(const Node& table, std::string_view key, const Spec& spec, const std::string& path) {
  const std::string range = range_text(spec, spec.unit);
  std::string about(spec.text);
  if (!range.empty())
    about += ", " + range;
  else if (!spec.unit.empty())
    about += ", " + std::string(spec.unit);
  throw Error("scenario", named(path) + " lacks the required key \"" + std::string(key) + "\" (" + about + ")", {}, {},
              location(table.place));
}

std::size_t read_present_key(const Node& table, const std::vector<std::string>& names, const std::string& path) {
  std::vector<std::size_t> present;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (table.find(names[i])) present.push_back(i);
  if (present.size() == 1) return present[0];
  if (present.size() > 1)
    throw Error("scenario", path + " has both \"" + names[present[0]] + "\" and \"" + names[present[1]] + "\"", {},
                "one of " + quoted_list(names), location(table.find(names[present[1]])->key_place));
  for (const Node& child : table.children) {
    const std::string hint = did_you_mean(child.key, names);
    if (!hint.empty())
      throw Error("scenario", "unknown key \"" + shortened(child.key) + "\" in " + path + hint, {},
                  "one of " + quoted_list(names), location(child.key_place));
  }
  throw Error("scenario", path + " does not say which kind it is", {}, "one of " + quoted_list(names),
              location(table.place));
}

std::string child_path(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

std::string item_path(const std::string& path, const Node& item, std::size_t index) {
  const Node* name = item.find("name");
  const bool named_item = name && name->is_string() && !name->text.empty();
  return child_path(path, named_item ? shortened(name->text) : std::to_string(index));
}

}  // namespace scarp

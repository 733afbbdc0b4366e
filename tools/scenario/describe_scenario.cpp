// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/describe_scenario.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "solver/model/error.hpp"
#include "tools/scenario/schema_rows.hpp"
#include "tools/scenario/suggest.hpp"

namespace scarp {
namespace {

using Words = std::vector<std::string>;

Words split_path(const std::string& path) {
  Words parts;
  std::istringstream in(path);
  for (std::string part; std::getline(in, part, '.');) {
    while (part.ends_with("[]")) part.resize(part.size() - 2);
    const bool is_index = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    if (!part.empty() && !is_index) parts.push_back(part);
  }
  return parts;
}

/// Whether `wanted` begins `path` at its part `from`; NAME stands for any name.
bool begins_at(const Words& path, std::size_t from, const Words& wanted) {
  if (from + wanted.size() > path.size()) return false;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (path[from + i] != wanted[i] && path[from + i] != "NAME") return false;
  return true;
}

std::vector<KeyRow> matching_rows(const std::string& key) {
  const std::vector<KeyRow> all = schema_rows();
  const Words wanted = split_path(key);
  if (wanted.empty()) return all;
  std::vector<KeyRow> found;
  for (const KeyRow& row : all)
    if (begins_at(split_path(row.path()), 0, wanted)) found.push_back(row);
  if (!found.empty()) return found;
  for (const KeyRow& row : all) {
    const Words path = split_path(row.path());
    const bool ends = path.size() >= wanted.size() && path[path.size() - wanted.size()] != "NAME" &&
                      begins_at(path, path.size() - wanted.size(), wanted);
    if (ends) found.push_back(row);
  }
  if (!found.empty()) return found;
  std::set<std::string> names;
  for (const KeyRow& row : all) {
    names.insert(row.path());
    names.insert(row.key);
  }
  throw Error("describe", "no key is called \"" + key + "\"" + did_you_mean(key, {names.begin(), names.end()}));
}

/// Rows of one table under one condition, in the order in which they come first.
using Section = std::pair<std::pair<std::string, std::string>, std::vector<KeyRow>>;

std::vector<Section> grouped(const std::vector<KeyRow>& rows) {
  std::vector<Section> sections;
  for (const KeyRow& row : rows) {
    const std::pair key{row.section, row.condition};
    auto found = std::find_if(sections.begin(), sections.end(), [&](const Section& s) { return s.first == key; });
    if (found == sections.end()) found = sections.insert(sections.end(), {key, {}});
    found->second.push_back(row);
  }
  return sections;
}

std::string title_of(const Section& section) {
  const auto& [path, condition] = section.first;
  const std::string name = path.empty() ? "top level" : path;
  return condition.empty() ? name : name + "  (" + condition + ")";
}

std::string type_of(const KeyRow& row) {
  std::string text = row.type;
  if (!row.unit.empty()) text += ", " + row.unit;
  if (!row.range.empty()) text += ", " + row.range;
  return text;
}

std::string default_of(const KeyRow& row) {
  if (row.required) return "required";
  return row.fallback.empty() ? "-" : row.fallback;
}

/// Length in characters of UTF-8 text.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

Words wrapped(const std::string& text, std::size_t width) {
  Words lines;
  std::istringstream in(text);
  std::string line;
  for (std::string word; in >> word;) {
    if (!line.empty() && width_of(line) + 1 + width_of(word) > width) lines.push_back(std::exchange(line, {}));
    line += (line.empty() ? "" : " ") + word;
  }
  lines.push_back(line);
  return lines;
}

constexpr std::size_t kColumns[4] = {18, 28, 15, 42};  // with two blanks before each: 111, less the last blank

void print_row(std::string& out, const KeyRow& row) {
  const Words cells[4] = {wrapped(row.key, kColumns[0]), wrapped(type_of(row), kColumns[1]),
                          wrapped(default_of(row), kColumns[2]), wrapped(row.text, kColumns[3])};
  std::size_t height = 0;
  for (const Words& cell : cells) height = std::max(height, cell.size());
  for (std::size_t i = 0; i < height; ++i) {
    std::string line;
    for (std::size_t c = 0; c < 4; ++c) {
      const std::string text = i < cells[c].size() ? cells[c][i] : "";
      line += (c == 0 ? "  " : " ") + text;
      if (width_of(text) < kColumns[c]) line.append(kColumns[c] - width_of(text), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
}

std::string in_table_cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

}  // namespace

std::string describe_keys(const std::string& key) {
  std::string out;
  for (const Section& section : grouped(matching_rows(key))) {
    out += (out.empty() ? "" : "\n") + title_of(section) + "\n";
    for (const KeyRow& row : section.second) print_row(out, row);
  }
  return out;
}

std::string describe_markdown() {
  std::string out = "# Scenario keys\n";
  for (const Section& section : grouped(schema_rows())) {
    out += "\n## " + title_of(section) + "\n\n| key | value | default | meaning |\n|---|---|---|---|\n";
    for (const KeyRow& row : section.second)
      out += "| `" + row.key + "` | " + in_table_cell(type_of(row)) + " | " +
             (row.required || row.fallback.empty() ? default_of(row) : "`" + row.fallback + "`") + " | " +
             in_table_cell(row.text) + " |\n";
  }
  return out;
}

}  // namespace scarp

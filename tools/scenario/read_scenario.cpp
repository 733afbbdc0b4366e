// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/read_scenario.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "tools/scenario/check_scenario.hpp"
#include "tools/scenario/overrides.hpp"
#include "tools/scenario/parse_toml.hpp"
#include "tools/scenario/schema_reader.hpp"

namespace scarp {
namespace {

/// Points are read before the reader comes to the dimension, so it is looked up first. Where it is wrong, reading the
/// domain says so.
int dimension_of(const Node& root, const std::filesystem::path& folder) {
  DomainOptions domain;
  const Node* table = root.find("domain");
  if (!table) return domain.dimension;
  const Node* node = table->find("dimension");
  if (!node) return domain.dimension;
  if (node->kind == Node::Kind::integer && (node->integer == 2 || node->integer == 3))
    return static_cast<int>(node->integer);
  SchemaReader(folder, domain.dimension).read_table(domain, *table, "domain");
  return domain.dimension;
}

std::string read_text_file(const std::filesystem::path& file) {
  const SourceLocation where{file.string()};
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) throw Error("scenario", "there is no such scenario file", {}, {}, where);
  if (!std::filesystem::is_regular_file(status))
    throw Error("scenario", "this is not a scenario file", std::filesystem::is_directory(status) ? "a folder" : "",
                "a TOML file", where);
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw Error("scenario", "the scenario cannot be opened: " + std::string(std::strerror(errno)), {}, {}, where);
  // One byte more than is allowed tells a larger file without reading it.
  std::string text(kLargestScenario + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad())
    throw Error("scenario", "the scenario cannot be read: " + std::string(std::strerror(errno)), {}, {}, where);
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kLargestScenario)
    throw Error("scenario", "a scenario of this size is refused", {},
                "at most " + std::to_string(kLargestScenario) + " bytes", where);
  return text;
}

}  // namespace

Scenario parse_scenario(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                        const std::vector<std::string>& overrides) {
  Node root = parse_toml(text, name);
  for (const std::string& argument : overrides) apply_override(root, argument);
  Scenario scenario;
  SchemaReader(folder, dimension_of(root, folder)).read_table(scenario, root, "");
  check_scenario(scenario, root);
  return scenario;
}

Scenario read_scenario(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return parse_scenario(read_text_file(file), file.string(), file.parent_path(), overrides);
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The leaves of a scenario: from one value of the TOML tree to one member, with everything that can be wrong.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "solver/model/schema.hpp"
#include "tools/scenario/node.hpp"

namespace scarp {

/// All throw Error ("scenario") at the place of the value, naming `path`, the value as written and what is allowed.
double read_number(const Node& node, const Spec& spec, const std::string& path);
std::int64_t read_whole_number(const Node& node, const Spec& spec, const std::string& path, std::int64_t least,
                               std::int64_t most);
bool read_bool(const Node& node, const std::string& path);
std::string read_text(const Node& node, const std::string& path);
/// Index into `names`.
std::size_t read_enumerator(const Node& node, const std::vector<std::string>& names, const std::string& path);
/// An existing file, absolute and lexically normal; relative paths start in `folder`.
std::string read_input_file(const Node& node, const std::filesystem::path& folder, const std::string& path);
/// Exactly `count` numbers into `values`.
void read_tuple(const Node& node, const Spec& spec, const std::string& path, int count, double* values);

void expect_table(const Node& node, const std::string& path);
void expect_list(const Node& node, const std::string& path);
/// Refuses keys of a table that are not in `known`. `context` tells which alternative of a choice it is about.
void check_known_keys(const Node& table, const std::vector<std::string>& known, const std::string& path,
                      const std::string& context);
[[noreturn]] void refuse_missing(const Node& table, std::string_view key, const Spec& spec, const std::string& path);
/// The one key of `names` that is in the table.
std::size_t read_present_key(const Node& table, const std::vector<std::string>& names, const std::string& path);

std::string child_path(const std::string& path, std::string_view key);
/// "bodies.slide", by name where the item has one, else "bodies.0": as in --set.
std::string item_path(const std::string& path, const Node& item, std::size_t index);

}  // namespace scarp

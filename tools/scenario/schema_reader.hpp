// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The visitor that fills a described struct from a TOML tree.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include "tools/scenario/node.hpp"
#include "tools/scenario/read_values.hpp"
#include "tools/scenario/schema_kinds.hpp"
#include "tools/scenario/suggest.hpp"

namespace scarp {

class SchemaReader {
 public:
  /// @param folder    where relative input files start
  /// @param dimension of the scenario: how many entries a point has
  SchemaReader(std::filesystem::path folder, int dimension) : folder_(std::move(folder)), dimension_(dimension) {}

  /// @throws Error ("scenario") at the first unknown key, missing key or wrong value.
  template <Described S>
  void read_table(S& target, const Node& table, const std::string& path) {
    check_known_keys(table, keys_of<S>(), path, "");
    read_members(target, table, path);
  }

 private:
  template <Described S>
  void read_members(S& target, const Node& table, const std::string& path) {
    const int outside = dimension_;
    if (always_spatial<S>) dimension_ = 3;
    target.describe([&](std::string_view key, auto& member, const Spec& spec) {
      if (const Node* child = table.find(key))
        read(member, *child, spec, child_path(path, key));
      else if (spec.required)
        refuse_missing(table, key, spec, path);
    });
    dimension_ = outside;
  }

  template <class T>
  void read(T& member, const Node& node, const Spec& spec, const std::string& path) {
    if constexpr (std::is_same_v<T, bool>) {
      member = read_bool(node, path);
    } else if constexpr (WholeNumber<T>) {
      member = static_cast<T>(
          read_whole_number(node, spec, path, std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
    } else if constexpr (std::is_same_v<T, double>) {
      member = read_number(node, spec, path);
    } else if constexpr (std::is_same_v<T, std::string>) {
      member = read_text(node, path);
    } else if constexpr (std::is_same_v<T, InputFile>) {
      member.path = read_input_file(node, folder_, path);
    } else if constexpr (Tuple<T>) {
      member = T{};
      read_tuple(node, spec, path, entries_of<T>(dimension_), member.data());
    } else if constexpr (Enumerated<T>) {
      member = enum_names<T>::value[read_enumerator(node, enumerator_names<T>(), path)].second;
    } else if constexpr (is_optional<T>) {
      read(member.emplace(), node, spec, path);
    } else if constexpr (is_list<T>) {
      read_list(member, node, spec, path);
    } else if constexpr (is_map<T>) {
      expect_table(node, path);
      for (const Node& child : node.children) {
        if (child.key.empty()) refuse(child, "a name in " + path + " is empty");
        read(member[child.key], child, Spec{}, child_path(path, shortened(child.key)));
      }
    } else if constexpr (Choice<T>) {
      read_choice(member, node, path);
    } else if constexpr (ShortNamed<T>) {
      read_short(member, node, path);
    } else {
      static_assert(Described<T>, "a member of a kind that the schema does not know");
      expect_table(node, path);
      read_table(member, node, path);
    }
  }

  template <class T>
  void read_list(std::vector<T>& list, const Node& node, const Spec& spec, const std::string& path) {
    expect_list(node, path);
    list.clear();
    list.reserve(node.children.size());
    for (std::size_t i = 0; i < node.children.size(); ++i)
      read(list.emplace_back(), node.children[i], spec, item_path(path, node.children[i], i));
  }

  template <ShortNamed T>
  void read_short(T& member, const Node& node, const std::string& path) {
    if (node.is_table()) {
      member = short_names<T>::table;
      read_table(member, node, path);
    } else {
      member = short_names<T>::value[read_enumerator(node, short_names_of<T>(), path)].second;
    }
  }

  template <Choice C>
  void read_choice(C& choice, const Node& node, const std::string& path) {
    constexpr std::string_view tag = choice_key<C>::value;
    expect_table(node, path);
    const std::vector<std::string> names = alternative_names<C>();
    std::size_t wanted = 0;
    if constexpr (tag.empty()) {
      wanted = read_present_key(node, names, path);
    } else {
      const Node* chosen = node.find(tag);
      if (!chosen) {
        const std::string list = "one of " + quoted_list(names);
        refuse_missing(node, tag, Spec{.text = list}, path);
      }
      wanted = read_enumerator(*chosen, names, child_path(path, tag));
    }
    std::size_t index = 0;
    for_each_alternative<C>([&]<class Alternative>() {
      if (index++ != wanted) return;
      std::vector<std::string> keys = keys_of<Alternative>();
      if constexpr (!tag.empty()) keys.emplace(keys.begin(), tag);
      const std::string context =
          tag.empty() ? "" : " (" + std::string(tag) + " = \"" + std::string(Alternative::name) + "\")";
      check_known_keys(node, keys, path, context);
      read_members(choice.template emplace<Alternative>(), node, path);
    });
  }

  std::filesystem::path folder_;
  int dimension_;
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The visitor that turns a described struct into TOML values.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "tools/scenario/schema_kinds.hpp"
#include "tools/scenario/toml_text.hpp"

namespace scarp {

class SchemaWriter {
 public:
  explicit SchemaWriter(int dimension) : dimension_(dimension) {}

  /// `describe` is not const, hence the copy.
  template <class T>
  TomlValue write(T member) {
    TomlValue out;
    if constexpr (std::is_same_v<T, bool>) {
      out.text = member ? "true" : "false";
    } else if constexpr (WholeNumber<T>) {
      out.text = std::to_string(member);
    } else if constexpr (std::is_same_v<T, double>) {
      out.text = toml_double(member);
    } else if constexpr (std::is_same_v<T, std::string>) {
      out.text = toml_string(member);
    } else if constexpr (std::is_same_v<T, InputFile>) {
      out.text = toml_string(member.path);
    } else if constexpr (Enumerated<T>) {
      out.text = toml_string(name_of(member));
    } else if constexpr (Tuple<T>) {
      out.kind = TomlValue::Kind::array;
      for (int i = 0; i < entries_of<T>(dimension_); ++i) out.children.push_back(write(member[i]));
    } else if constexpr (is_list<T>) {
      out.kind = TomlValue::Kind::array;
      for (auto& item : member) out.children.push_back(write(std::move(item)));
    } else if constexpr (is_map<T>) {
      out.kind = TomlValue::Kind::table;
      for (auto& [key, value] : member) append(out, key, value);
    } else if constexpr (Choice<T>) {
      std::visit([&](auto& alternative) { write_alternative<T>(out, alternative); }, member);
    } else {
      static_assert(Described<T>, "a member of a kind that the schema does not know");
      if constexpr (ShortNamed<T>) {
        for (const auto& [name, value] : short_names<T>::value)
          if (value == member) out.text = toml_string(std::string(name));
        if (!out.text.empty()) return out;
      }
      write_members(out, member);
    }
    return out;
  }

 private:
  template <class T>
  void append(TomlValue& table, std::string_view key, T& member) {
    if constexpr (is_optional<T>) {
      if (member) append(table, key, *member);
    } else {
      table.children.push_back(write(member));
      table.children.back().key = key;
    }
  }

  template <Choice C, class Alternative>
  void write_alternative(TomlValue& out, Alternative& alternative) {
    constexpr std::string_view tag = choice_key<C>::value;
    out.kind = TomlValue::Kind::table;
    if constexpr (!tag.empty()) {
      std::string name(Alternative::name);
      append(out, tag, name);
    }
    write_members(out, alternative);
  }

  template <Described S>
  void write_members(TomlValue& out, S& source) {
    out.kind = TomlValue::Kind::table;
    const int outside = dimension_;
    if (always_spatial<S>) dimension_ = 3;
    source.describe([&](std::string_view key, auto& member, const Spec&) { append(out, key, member); });
    dimension_ = outside;
  }

  int dimension_;
};

}  // namespace scarp

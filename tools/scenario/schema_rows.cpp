// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/schema_rows.hpp"

#include <algorithm>

#include "solver/model/scenario.hpp"
#include "tools/scenario/range_text.hpp"
#include "tools/scenario/schema_kinds.hpp"
#include "tools/scenario/schema_writer.hpp"
#include "tools/scenario/suggest.hpp"

namespace scarp {
namespace {

template <class T>
concept Leaf = !Choice<T> && !Described<T> && !is_list<T> && !is_map<T> && !is_optional<T>;

template <class T>
std::string type_name(bool spatial) {
  if constexpr (std::is_same_v<T, bool>) return "true or false";
  if constexpr (WholeNumber<T>) return "whole number";
  if constexpr (std::is_same_v<T, double>) return "number";
  if constexpr (std::is_same_v<T, std::string>) return "text";
  if constexpr (std::is_same_v<T, InputFile>) return "file";
  if constexpr (std::is_same_v<T, Vec2>) return "2 numbers";
  if constexpr (std::is_same_v<T, Vec3>) return spatial ? "3 numbers" : "3 numbers (2D: 2)";
  if constexpr (Enumerated<T>) return quoted_list(enumerator_names<T>(), 99);
  if constexpr (is_optional<T>) return type_name<typename T::value_type>(spatial);
  if constexpr (is_map<T>) return "tables by name";
  if constexpr (Choice<T>)
    return choice_key<T>::value.empty() ? "table with one of " + quoted_list(alternative_names<T>(), 99) : "table";
  else if constexpr (ShortNamed<T>)
    return quoted_list(short_names_of<T>(), 99) + ", or table";
  else if constexpr (Described<T>)
    return "table";
  if constexpr (is_list<T>) {
    using Item = typename T::value_type;
    if constexpr (Choice<Item> || Described<Item>) return "list of tables";
    if constexpr (Enumerated<Item>) return "list of " + type_name<Item>(spatial);
    if constexpr (std::is_same_v<Item, std::string>) return "list of texts";
    if constexpr (std::is_same_v<Item, double>) return "list of numbers";
    if constexpr (Tuple<Item>) return "list of [" + std::string(std::is_same_v<Item, Vec2> ? "x, y" : "x, y, z") + "]";
  }
  return {};
}

/// Whole numbers as a reader writes them: "[50, -30, 25]".
std::string without_point_zero(const std::string& toml) {
  std::string out;
  for (std::size_t i = 0; i < toml.size(); ++i) {
    const bool ends = i + 2 >= toml.size() || toml[i + 2] == ',' || toml[i + 2] == ']';
    if (toml[i] == '.' && i + 1 < toml.size() && toml[i + 1] == '0' && ends)
      ++i;
    else
      out += toml[i];
  }
  return out;
}

class RowCollector {
 public:
  template <Described S>
  void table(const std::string& section, const std::string& condition, bool spatial) {
    S sample;
    sample.describe([&](std::string_view key, auto& member, const Spec& spec) {
      using T = std::remove_reference_t<decltype(member)>;
      rows_.push_back(row(section, condition, key, member, spec, spatial));
      below<T>(rows_.back().path(), spatial);
    });
  }

  std::vector<KeyRow> take() { return std::move(rows_); }

 private:
  template <class T>
  static KeyRow row(const std::string& section, const std::string& condition, std::string_view key, const T& member,
                    const Spec& spec, bool spatial) {
    KeyRow row{section,
               condition,
               std::string(key),
               type_name<T>(spatial),
               std::string(spec.unit),
               range_text(spec, ""),
               {},
               spec.required,
               std::string(spec.text)};
    if constexpr (Leaf<T> || is_list<T> || ShortNamed<T>)
      if (!spec.required) row.fallback = print_inline(SchemaWriter(3).write(member));
    if (row.fallback == "\"\"") row.fallback.clear();
    row.fallback = without_point_zero(row.fallback);
    return row;
  }

  /// The keys inside a member.
  template <class T>
  void below(const std::string& path, bool spatial) {
    if constexpr (is_optional<T>) {
      below<typename T::value_type>(path, spatial);
    } else if constexpr (is_list<T>) {
      using Item = typename T::value_type;
      if constexpr (Choice<Item> || Described<Item>) below<Item>(path + "[]", spatial || always_spatial<Item>);
    } else if constexpr (is_map<T>) {
      below<typename T::mapped_type>(path + ".NAME", spatial);
    } else if constexpr (Choice<T>) {
      alternatives<T>(path, spatial);
    } else if constexpr (Described<T>) {
      table<T>(path, "", spatial || always_spatial<T>);
    }
  }

  template <Choice C>
  void alternatives(const std::string& section, bool spatial) {
    const std::string tag(choice_key<C>::value);
    const std::vector<std::string> names = alternative_names<C>();
    if (!tag.empty()) rows_.push_back({section, "", tag, quoted_list(names, 99), "", "", "", true, "which kind it is"});
    std::vector<std::vector<KeyRow>> parts;
    for_each_alternative<C>([&]<class Alternative>() {
      RowCollector part;
      part.table<Alternative>(section, "", spatial);
      parts.push_back(part.take());
    });
    const auto is_shared = [&](const KeyRow& row) {
      return std::all_of(parts.begin(), parts.end(), [&](const std::vector<KeyRow>& part) {
        return std::find(part.begin(), part.end(), row) != part.end();
      });
    };
    std::vector<KeyRow> shared;
    std::copy_if(parts[0].begin(), parts[0].end(), std::back_inserter(shared), is_shared);
    rows_.insert(rows_.end(), shared.begin(), shared.end());
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (KeyRow& row : parts[i]) {
        if (std::find(shared.begin(), shared.end(), row) != shared.end()) continue;
        row.condition = (tag.empty() ? names[i] : tag + " = \"" + names[i] + "\"") +
                        (row.condition.empty() ? "" : ", " + row.condition);
        rows_.push_back(row);
      }
  }

  std::vector<KeyRow> rows_;
};

}  // namespace

std::vector<KeyRow> schema_rows() {
  RowCollector collector;
  collector.table<Scenario>("", "", false);
  return collector.take();
}

}  // namespace scarp

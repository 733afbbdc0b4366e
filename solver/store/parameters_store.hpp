// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Visitors for `describe` (solver/model/schema.hpp) that store any options struct as attributes of a group, so
// that a new law or parameter is stored without a line here.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/model/schema.hpp"
#include "solver/store/hdf5_store.hpp"

namespace scarp {

template <class T>
struct is_optional : std::false_type {};
template <class T>
struct is_optional<std::optional<T>> : std::true_type {};
template <class T>
struct is_vector : std::false_type {};
template <class T>
struct is_vector<std::vector<T>> : std::true_type {};
template <class T>
struct is_number_array : std::false_type {};
template <std::size_t n>
struct is_number_array<std::array<double, n>> : std::true_type {};

/// Writes each parameter as an attribute of `group`; nested names are joined by dots.
class ParameterWriter {
 public:
  ParameterWriter(Hdf5Writer& file, std::string group, std::string prefix = {})
      : file_(file), group_(std::move(group)), prefix_(std::move(prefix)) {}

  template <class T>
  void operator()(std::string_view name, T& value, const Spec&) {
    put(prefix_ + std::string(name), value);
  }

 private:
  template <class T>
  void put(const std::string& key, T& value) {
    if constexpr (is_optional<T>::value) {
      file_.attribute(group_, key + ".given", std::int64_t{value.has_value()});
      if (value) put(key, *value);
    } else if constexpr (is_vector<T>::value) {
      file_.attribute(group_, key + ".count", static_cast<std::int64_t>(value.size()));
      for (std::size_t i = 0; i < value.size(); ++i) put(key + "." + std::to_string(i), value[i]);
    } else if constexpr (std::is_enum_v<T>) {
      file_.text_attribute(group_, key, name_of(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      file_.text_attribute(group_, key, value);
    } else if constexpr (std::is_integral_v<T>) {  // bool too
      file_.attribute(group_, key, static_cast<std::int64_t>(value));
    } else if constexpr (std::is_same_v<T, double> || is_number_array<T>::value) {
      file_.attribute(group_, key, value);
    } else {
      value.describe(ParameterWriter(file_, group_, key + "."));
    }
  }

  Hdf5Writer& file_;
  std::string group_, prefix_;
};

/// An enum, which is stored by name.
template <class E>
E read_enum(const Hdf5Reader& file, const std::string& group, const std::string& key) {
  const std::string found = file.text_attribute(group, key);
  std::string allowed;
  for (const auto& [name, value] : enum_names<E>::value) {
    if (name == found) return value;
    allowed += (allowed.empty() ? "" : ", ") + std::string(name);
  }
  file.refuse(group + ": " + key, "'" + found + "'", allowed);
}

/// The counterpart; a parameter that is missing is an Error.
class ParameterReader {
 public:
  ParameterReader(const Hdf5Reader& file, std::string group, std::string prefix = {})
      : file_(file), group_(std::move(group)), prefix_(std::move(prefix)) {}

  template <class T>
  void operator()(std::string_view name, T& value, const Spec&) {
    get(prefix_ + std::string(name), value);
  }

 private:
  template <class T>
  void get(const std::string& key, T& value) {
    if constexpr (is_optional<T>::value) {
      value.reset();
      if (file_.attribute<std::int64_t>(group_, key + ".given") != 0) get(key, value.emplace());
    } else if constexpr (is_vector<T>::value) {
      value.clear();
      const auto count = file_.attribute<std::int64_t>(group_, key + ".count");
      for (std::int64_t i = 0; i < count; ++i) get(key + "." + std::to_string(i), value.emplace_back());
    } else if constexpr (std::is_enum_v<T>) {
      value = read_enum<T>(file_, group_, key);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = file_.text_attribute(group_, key);
    } else if constexpr (std::is_integral_v<T>) {
      const auto stored = file_.attribute<std::int64_t>(group_, key);
      value = static_cast<T>(stored);
      if (static_cast<std::int64_t>(value) != stored) file_.refuse(group_ + ": " + key, std::to_string(stored));
    } else if constexpr (std::is_same_v<T, double> || is_number_array<T>::value) {
      value = file_.attribute<T>(group_, key);
    } else {
      value.describe(ParameterReader(file_, group_, key + "."));
    }
  }

  const Hdf5Reader& file_;
  std::string group_, prefix_;
};

}  // namespace scarp

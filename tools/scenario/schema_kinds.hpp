// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a schema visitor can meet, told apart at compile time.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/scan_options.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

template <class T>
inline constexpr bool is_map = false;
template <class T>
inline constexpr bool is_map<std::map<std::string, T>> = true;

template <class T>
concept Choice = requires {
  choice_key<T>::value;
};

template <class T>
concept Enumerated = std::is_enum_v<T> && requires {
  enum_names<T>::value;
};

/// Numbers of a fixed count: Vec2, Vec3.
template <class T>
concept Tuple = std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>;

template <class T>
concept WholeNumber = std::is_integral_v<T> && !std::is_same_v<T, bool>;

struct AnyVisitor {
  template <class T>
  void operator()(std::string_view, T&, const Spec&) const {}
};
template <class T>
concept Described = requires(T t) {
  t.describe(AnyVisitor{});
};

/// A struct that may also be written as a bare name.
template <class T>
concept ShortNamed = Described<T> && requires {
  short_names<T>::value;
};

template <ShortNamed T>
std::vector<std::string> short_names_of() {
  std::vector<std::string> names;
  for (const auto& [name, value] : short_names<T>::value) names.emplace_back(name);
  return names;
}

/// Structs whose points have three entries in plane strain too: scans are spatial whatever is simulated.
template <class T>
inline constexpr bool always_spatial = std::is_same_v<T, ScanOptions>;

/// Calls f.template operator()<Alternative>() for each alternative of a std::variant, in order.
template <class Variant, class F>
void for_each_alternative(F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (f.template operator()<std::variant_alternative_t<I, Variant>>(), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
}

template <Choice C>
std::vector<std::string> alternative_names() {
  std::vector<std::string> names;
  for_each_alternative<C>([&]<class Alternative>() { names.emplace_back(Alternative::name); });
  return names;
}

template <Enumerated E>
std::vector<std::string> enumerator_names() {
  std::vector<std::string> names;
  for (const auto& [name, value] : enum_names<E>::value) names.emplace_back(name);
  return names;
}

template <Described S>
std::vector<std::string> keys_of() {
  std::vector<std::string> keys;
  S sample;
  sample.describe([&](std::string_view key, auto&, const Spec&) { keys.emplace_back(key); });
  return keys;
}

/// How many entries a Vec2 or Vec3 has in a scenario of this dimension.
template <Tuple T>
constexpr int entries_of(int dimension) {
  return std::is_same_v<T, Vec2> ? 2 : dimension;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vocabulary in which options describe themselves. An options struct holds its defaults in its member
// initialisers and names each key once:
//
//   struct VoxelThin {
//     static constexpr std::string_view name = "voxel-thin";
//     double size = 0;
//     template <class V> void describe(V&& v) {
//       v("size", size, Spec{.text = "edge of a voxel; one point is kept in each", .unit = "m", .above = 0,
//                            .required = true});
//     }
//   };
//
// Visitors (tools/scenario) make of it the parser, the validator, `scarp describe` and the resolved scenario.
// What a visitor meets as `member`: bool, int, std::int64_t, double, std::string, InputFile, Vec2, Vec3,
// std::vector<Vec2>, an enum with enum_names, std::optional of any of these or of a struct, a nested struct (with
// short_names also a bare name), a std::vector of structs, choices, strings or enums, std::map<std::string, ...>, and a
// choice (std::variant with a choice_key).
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace scarp {

/// What a coordinate means, so that the scenario can be moved to local coordinates in one sweep.
enum class Role { plain, position, elevation };

/// What is said of a key, once.
struct Spec {
  std::string_view text;       ///< one sentence for the reference
  std::string_view unit = "";  ///< SI symbol of a bare number ("Pa", "kg/m3", "deg"); empty: dimensionless
  double at_least = -INFINITY;
  double above = -INFINITY;  ///< exclusive
  double at_most = INFINITY;
  double below = INFINITY;  ///< exclusive
  bool required = false;
  Role role = Role::plain;
};

/// A file that the scenario names; the reader makes it relative to the scenario's folder.
struct InputFile {
  std::string path;
};

/// For a std::variant of option structs, each with a `name`: the key whose value selects the alternative
/// ("filter", "model"). An empty key means that the alternative is the one whose `name` is present as a key.
template <class Variant>
struct choice_key;

/// Names of an enum's values: specialise with `static constexpr std::array<std::pair<std::string_view, E>, n> value`.
template <class E>
struct enum_names;

/// For a struct that may also be written as a bare name: specialise with `static constexpr
/// std::array<std::pair<std::string_view, S>, n> value`, what the names stand for, and `static constexpr S table`,
/// what a table fills.
template <class S>
struct short_names;

template <class E>
std::string_view name_of(E value) {
  for (const auto& [name, entry] : enum_names<E>::value)
    if (entry == value) return name;
  return "?";
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// What holds the nodes of a face (or of a base): nothing, the normal velocity, all of the velocity.
enum class Condition : std::uint8_t { free, roller, fixed };
template <>
struct enum_names<Condition> {
  static constexpr std::array<std::pair<std::string_view, Condition>, 3> value{
      {{"free", Condition::free}, {"roller", Condition::roller}, {"fixed", Condition::fixed}}};
};

/// What a face of the domain does to the nodes on it: what a Condition does, or
/// absorbing: dashpots that let waves out (Lysmer and Kuhlemeyer 1969);
/// friction: nodes may leave the face, and those that press on it stick or slide after Coulomb.
enum class FaceCondition : std::uint8_t { free, roller, fixed, absorbing, friction };

struct Face {
  FaceCondition condition = FaceCondition::free;
  double friction = 0;  ///< Coulomb's coefficient, of the condition `friction`

  constexpr Face() = default;
  constexpr Face(FaceCondition c, double mu = 0) : condition(c), friction(mu) {}
  constexpr Face(Condition c)
      : condition(c == Condition::free     ? FaceCondition::free
                  : c == Condition::roller ? FaceCondition::roller
                                           : FaceCondition::fixed) {}
  bool operator==(const Face&) const = default;

  template <class V>
  void describe(V&& v) {
    v("friction", friction,
      Spec{
          .text = "Coulomb coefficient of a face that nodes may leave but not cross", .at_least = 0, .required = true});
  }
};
template <>
struct enum_names<FaceCondition> {
  static constexpr std::array<std::pair<std::string_view, FaceCondition>, 5> value{
      {{"free", FaceCondition::free},
       {"roller", FaceCondition::roller},
       {"fixed", FaceCondition::fixed},
       {"absorbing", FaceCondition::absorbing},
       {"friction", FaceCondition::friction}}};
};
/// A face is a name, or { friction = 0.4 }.
template <>
struct short_names<Face> {
  static constexpr std::array<std::pair<std::string_view, Face>, 4> value{{{"free", FaceCondition::free},
                                                                           {"roller", FaceCondition::roller},
                                                                           {"fixed", FaceCondition::fixed},
                                                                           {"absorbing", FaceCondition::absorbing}}};
  static constexpr Face table{FaceCondition::friction};
};

/// The box in which the simulation happens, local coordinates, m. Order of `faces`: x_min, x_max, y_min, ...
struct Domain {
  int dimension = 3;  ///< 3, or 2 for plane strain per metre of thickness
  double cell = 0;
  Vec3 min{0, 0, 0};
  Vec3 max{0, 0, 0};
  std::array<Face, 6> faces{};
};

/// A regular lattice of cubic (2D: square) cells; x is the fastest index. Plane strain is a flat z axis:
/// no cells and one node there, weight 1, no gradient.
struct Lattice {
  Vec3 origin{0, 0, 0};  ///< position of node (0, 0, 0)
  double cell = 0;       ///< edge, m
  std::array<std::int32_t, 3> cells{0, 0, 0};

  bool flat() const { return cells[2] == 0; }
  int dimension() const { return flat() ? 2 : 3; }
  std::array<std::int32_t, 3> nodes() const { return {cells[0] + 1, cells[1] + 1, cells[2] + 1}; }
  double cell_volume() const { return flat() ? cell * cell : cell * cell * cell; }
};

}  // namespace scarp

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

/// The box in which the simulation happens, local coordinates, m. Order of `faces`: x_min, x_max, y_min, ...
struct Domain {
  int dimension = 3;  ///< 3, or 2 for plane strain per metre of thickness
  double cell = 0;
  Vec3 min{0, 0, 0};
  Vec3 max{0, 0, 0};
  std::array<Condition, 6> faces{};
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

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/updated_boundary.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

std::uint8_t bits(Condition condition, int axis) {
  if (condition == Condition::free) return 0;
  return condition == Condition::fixed ? 7 : static_cast<std::uint8_t>(1 << axis);
}

std::uint8_t bits_of_face(const Face& face, int axis) {
  if (face.condition == FaceCondition::roller) return bits(Condition::roller, axis);
  return face.condition == FaceCondition::fixed ? bits(Condition::fixed, axis) : std::uint8_t{0};
}

/// Node indices on an axis whose functions do not vanish at lattice node i; first > last where it is outside.
/// Beyond a wall GIMP has one more node, which belongs to the wall's.
std::pair<int, int> functions_at(const UpdatedGrid& grid, int i, int axis) {
  const int cells = grid.cell_count[axis];
  if (i < 0 || i > cells) return {0, -1};
  switch (grid.shape) {
    case ShapeFunction::linear:
      return {i, i};
    case ShapeFunction::quadratic_bspline:
      return i == 0 ? std::pair(0, 0) : i == cells ? std::pair(cells + 1, cells + 1) : std::pair(i, i + 1);
    case ShapeFunction::gimp:
      return {i == 0 ? 0 : i + 1, i == cells ? cells + 2 : i + 1};
  }
  return {0, -1};
}

/// The body's lattice in whole cells from the domain's.
std::array<int, 3> offset_of(const UpdatedGrid& grid, const Body& body) {
  std::array<int, 3> offset{0, 0, 0};
  bool same = std::abs(body.lattice.cell - grid.cell) <= 1e-9 * grid.cell;
  for (int a = 0; a < grid.dimension; ++a) {
    const double cells = (body.lattice.origin[a] - grid.origin[a]) / grid.cell;
    same = same && std::abs(cells - std::round(cells)) <= 1e-6;
    if (same) offset[a] = static_cast<int>(std::lround(cells));
  }
  if (!same)
    throw Error("solve", "cell of updated-Lagrangian body '" + body.name + "', whose base is held at nodes of its own",
                shortest(body.lattice.cell) + " m", "that of the domain, " + shortest(grid.cell) + " m");
  return offset;
}

void hold_set(const UpdatedGrid& grid, UpdatedField& field, const NodeSet& set, const Body& body) {
  if (set.condition == Condition::roller && (set.axis < 0 || set.axis >= grid.dimension))
    throw Error("solve", "axis of the roller '" + set.name + "' of body '" + body.name + "'", std::to_string(set.axis),
                "0 to " + std::to_string(grid.dimension - 1));
  const std::array<int, 3> offset = offset_of(grid, body);
  for (const auto& node : set.nodes) {
    std::array<std::pair<int, int>, 3> range{};
    for (int a = 0; a < grid.dimension; ++a) range[a] = functions_at(grid, node[a] + offset[a], a);
    for (int k = range[2].first; k <= range[2].second; ++k)
      for (int j = range[1].first; j <= range[1].second; ++j)
        for (int i = range[0].first; i <= range[0].second; ++i)
          field.held_by_set[grid.lattice_node({i, j, k})] |= bits(set.condition, set.axis);
  }
}

}  // namespace

void find_held_axes(UpdatedGrid& grid, const Model& model) {
  for (int a = 0; a < grid.dimension; ++a)
    for (int side = 0; side < 2; ++side)
      grid.held_by_face[2 * a + side] = bits_of_face(model.domain.faces[2 * a + side], a);
  for (UpdatedField& field : grid.fields)
    for (const std::int32_t b : field.bodies) {
      const Body& body = model.bodies[b];
      if (body.held.empty()) continue;
      const auto& n = grid.node_count;
      field.held_by_set.resize(static_cast<std::size_t>(n[0]) * n[1] * n[2], 0);
      for (const NodeSet& set : body.held) hold_set(grid, field, set, body);
    }
}

void hold_nodes(UpdatedGrid& grid, int threads) {
  const int beyond = grid.shape == ShapeFunction::gimp ? 1 : 0;
  for (const UpdatedField& field : grid.fields)
    parallel_for(field.node_end - field.node_begin, threads, [&](std::size_t k) {
      const std::size_t i = field.node_begin + k;
      const auto& n = grid.nodes[i];
      std::uint8_t held = field.held_by_set.empty() ? 0 : field.held_by_set[grid.lattice_node(n)];
      for (int a = 0; a < grid.dimension; ++a) {
        if (n[a] <= beyond) held |= grid.held_by_face[2 * a];
        if (n[a] >= grid.node_count[a] - 1 - beyond) held |= grid.held_by_face[2 * a + 1];
      }
      grid.held[i] = held;
    });
}

}  // namespace scarp

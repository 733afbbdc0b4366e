// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/boundary.hpp"

#include <algorithm>
#include <string>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

std::uint8_t bits(Condition condition, int axis) {
  if (condition == Condition::free) return 0;
  return condition == Condition::fixed ? 7 : static_cast<std::uint8_t>(1 << axis);
}

std::uint8_t bits(FaceCondition condition, int axis) {
  if (condition == FaceCondition::roller) return bits(Condition::roller, axis);
  return condition == FaceCondition::fixed ? bits(Condition::fixed, axis) : std::uint8_t{0};
}

/// x fastest, like ReferenceGrid::nodes.
bool before(const LatticeIndex& a, const LatticeIndex& b) {
  return a[2] != b[2] ? a[2] < b[2] : a[1] != b[1] ? a[1] < b[1] : a[0] < b[0];
}

void hold_faces(std::vector<std::uint8_t>& held, const Domain& domain, const Lattice& lattice,
                const ReferenceGrid& grid) {
  const double slack = 1e-6 * lattice.cell;
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    for (int a = 0; a < grid.dimension; ++a) {
      const double x = lattice.origin[a] + grid.nodes[i][a] * lattice.cell;
      if (x <= domain.min[a] + slack) held[i] |= bits(domain.faces[2 * a].condition, a);
      if (x >= domain.max[a] - slack) held[i] |= bits(domain.faces[2 * a + 1].condition, a);
    }
}

void hold_set(std::vector<std::uint8_t>& held, const NodeSet& set, const Body& body, const ReferenceGrid& grid) {
  if (set.condition == Condition::roller && (set.axis < 0 || set.axis >= grid.dimension))
    throw Error("solve", "axis of the roller '" + set.name + "' of body '" + body.name + "'", std::to_string(set.axis),
                "0 to " + std::to_string(grid.dimension - 1));
  for (const LatticeIndex& node : set.nodes) {
    const auto found = std::lower_bound(grid.nodes.begin(), grid.nodes.end(), node, before);
    if (found != grid.nodes.end() && *found == node) held[found - grid.nodes.begin()] |= bits(set.condition, set.axis);
  }
}

}  // namespace

std::vector<std::uint8_t> held_axes(const Domain& domain, const Body& body, const ReferenceGrid& grid) {
  std::vector<std::uint8_t> held(grid.nodes.size(), 0);
  hold_faces(held, domain, body.lattice, grid);
  for (const NodeSet& set : body.held) hold_set(held, set, body, grid);
  return held;
}

}  // namespace scarp

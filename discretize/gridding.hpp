// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "discretize/axis.hpp"
#include "solver/model/domain.hpp"
#include "solver/model/scenario.hpp"

namespace scarp {

/// Most material points of a model, and most columns of a body's lattice; beyond it a scenario is refused.
inline constexpr double kMostParticles = 2e9;
inline constexpr double kMostColumns = 1e9;

/// A body's lattice with its sub-cells: `per_cell` material points in each direction of a cell. Points stand in
/// columns: along z in 3D, along y in 2D, where `y` is the flat axis.
struct SubLattice {
  Lattice lattice;
  int per_cell = 2;
  Axis x, y, up;

  bool flat() const { return lattice.flat(); }
  std::size_t columns() const { return static_cast<std::size_t>(x.count) * static_cast<std::size_t>(y.count); }
  std::size_t column(std::int32_t i, std::int32_t j) const { return static_cast<std::size_t>(j) * x.count + i; }
  Vec3 point(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return flat() ? Vec3{x.at(i), up.at(k), 0} : Vec3{x.at(i), y.at(j), up.at(k)};
  }
  double point_volume() const { return lattice.cell_volume() / (flat() ? per_cell * per_cell : cube(per_cell)); }

 private:
  static int cube(int n) { return n * n * n; }
};

/// What of a body decides where its lattice lies.
struct Extent {
  std::string body;
  Box3 bounds;        ///< local, m
  double volume = 0;  ///< m3 (2D: m2)
};

/// The box of the simulation: given corners, or the bodies' bounds outwards to whole cells.
/// @throws Error ("discretize") if it is empty or no whole number of cells, or if a body reaches outside a given
/// corner (names the body and the coordinate, as the site counts it).
Domain lay_domain(const DomainOptions& options, const std::vector<Extent>& bodies, const Vec3& site_origin);

/// The lattice of one body: nodes on domain.min + whole multiples of the body's cell, just wide enough for it.
/// @throws Error if points_per_cell is no square (2D) or cube (3D), if the lattice would be absurdly large, or if a
/// held upper face of the domain does not lie on its nodes.
SubLattice lay_lattice(const Domain& domain, const BodyOptions& options, const Extent& extent);

}  // namespace scarp

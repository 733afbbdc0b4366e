// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where fields meet: places of the lattice with nodes of several, and the cells whose particles say how they lie.
#include <algorithm>
#include <cmath>

#include "solver/core/contact_laws.hpp"
#include "solver/core/grid_contact.hpp"
#include "solver/core/signed_distance.hpp"
#include "solver/core/updated_window.hpp"

namespace scarp {
namespace {

constexpr std::uint32_t kNone = UpdatedGrid::kNone;
constexpr std::uint32_t kMany = kNone - 1;

/// f(block of the lattice) over the block at b and those around it.
template <class F>
void each_around(const UpdatedGrid& grid, const std::array<std::int32_t, 3>& b, F&& f) {
  std::array<std::int32_t, 3> low{}, high{};
  for (int a = 0; a < 3; ++a) {
    low[a] = std::max(0, b[a] - 1);
    high[a] = std::min(grid.block_count[a] - 1, b[a] + 1);
  }
  for (std::int32_t z = low[2]; z <= high[2]; ++z)
    for (std::int32_t y = low[1]; y <= high[1]; ++y)
      for (std::int32_t x = low[0]; x <= high[0]; ++x) f(grid.lattice_block(0, {x, y, z}));
}

/// Cells whose particles matter to the node of index f on an axis: those in the reach of its function, and those that
/// reach into the cells which grad is taken over.
std::array<std::int32_t, 2> cells_that_matter(const UpdatedGrid& grid, double place, std::int32_t f, int axis) {
  const auto low = static_cast<std::int32_t>(std::floor(place)) - 2, high = static_cast<std::int32_t>(std::ceil(place));
  return {std::max(0, std::min(low, f - grid.width + 1)), std::min(grid.cell_count[axis] - 1, std::max(high + 1, f))};
}

}  // namespace

GridContact::GridContact(const Model& model, const UpdatedGrid& grid)
    : model_(model), impulse_(model.bodies.size(), Vec3{0, 0, 0}) {
  const std::size_t fields = grid.fields.size();
  laws_.resize(fields * fields);
  for (std::size_t a = 0; a < fields; ++a)
    for (std::size_t b = 0; b < fields; ++b)
      if (a != b)
        laws_[a * fields + b] = contact_law_between(model, grid.fields[a].bodies[0], grid.fields[b].bodies[0]);
  fields_at_block_.assign(grid.lattice_blocks(), kNone);
  first_at_node_.assign(grid.node_of_lattice.size(), kNone);
  radius_.assign(model.particles.size(), 0);
  fit_to_boundaries();
}

/// Balls that reached beyond the boundary that their body was cut from touch it: a rim without the lattice's facets.
/// None grows: larger ones meet what is far to their side, and a blow on few of them loses energy.
void GridContact::fit_to_boundaries() {
  fit_.assign(model_.particles.size(), 1);
  for (const Body& body : model_.bodies) {
    if (body.formulation != Formulation::updated_lagrangian || body.boundary.triangles.empty()) continue;
    const SignedDistance boundary(body.boundary, body.ball_radius, model_.domain.dimension == 2);
    for (std::size_t p = body.begin; p < body.end; ++p) {
      const double edge = std::pow(model_.particles.reference_volume[p], 1.0 / model_.domain.dimension);
      const auto foot = boundary.at(model_.particles.reference_position[p], 0.5 * edge);
      if (foot) fit_[p] = std::max(0.0, -2 * foot->distance / edge);
    }
  }
}

void GridContact::follow(const UpdatedGrid& grid) {
  if (followed_ == grid.placings) return;
  followed_ = grid.placings;
  find_near_nodes(grid);
  list_places(grid);
  want_cells(grid);
}

/// Nodes of blocks that have another field's blocks beside them.
void GridContact::find_near_nodes(const UpdatedGrid& grid) {
  for (std::size_t b = 0; b < grid.blocks.size(); ++b) {
    std::uint32_t& there = fields_at_block_[grid.lattice_block(0, grid.blocks[b])];
    there = there == kNone ? grid.block_field[b] : kMany;
  }
  near_.assign(grid.nodes.size(), 0);
  near_nodes_.clear();
  for (std::size_t b = 0; b < grid.blocks.size(); ++b) {
    bool meets = false;
    each_around(grid, grid.blocks[b], [&](std::size_t around) {
      meets = meets || (fields_at_block_[around] != kNone && fields_at_block_[around] != grid.block_field[b]);
    });
    if (!meets) continue;
    for (std::size_t t = b * grid.tile(); t < (b + 1) * grid.tile(); ++t) {
      const std::uint32_t node = grid.tile_nodes[t];
      if (node == kNone || near_[node]) continue;
      near_[node] = 1;
      near_nodes_.push_back(node);
    }
  }
  for (const auto& b : grid.blocks) fields_at_block_[grid.lattice_block(0, b)] = kNone;
}

void GridContact::list_places(const UpdatedGrid& grid) {
  // Chains of the nodes at a place; the one of the first field heads it.
  next_.assign(near_nodes_.size(), kNone);
  for (std::size_t k = near_nodes_.size(); k-- > 0;) {
    std::uint32_t& first = first_at_node_[grid.lattice_node(grid.nodes[near_nodes_[k]])];
    next_[k] = first;
    first = static_cast<std::uint32_t>(k);
  }
  places_.clear();
  place_nodes_.clear();
  pairs_.clear();
  const std::size_t fields = grid.fields.size();
  for (std::size_t k = 0; k < near_nodes_.size(); ++k) {
    const auto& at = grid.nodes[near_nodes_[k]];
    if (first_at_node_[grid.lattice_node(at)] != k || next_[k] == kNone) continue;
    Place place;
    place.at = at;
    place.node_begin = static_cast<std::uint32_t>(place_nodes_.size());
    for (std::uint32_t j = static_cast<std::uint32_t>(k); j != kNone; j = next_[j])
      place_nodes_.push_back({near_nodes_[j], static_cast<std::uint32_t>(field_of_node(grid, near_nodes_[j])), {}});
    place.node_end = static_cast<std::uint32_t>(place_nodes_.size());
    place.pair_begin = static_cast<std::uint32_t>(pairs_.size());
    for (std::uint32_t a = place.node_begin; a < place.node_end; ++a)
      for (std::uint32_t b = a + 1; b < place.node_end; ++b) {
        Pair pair;
        pair.a = a;
        pair.b = b;
        pair.law = laws_[place_nodes_[a].field * fields + place_nodes_[b].field];
        pairs_.push_back(pair);
      }
    place.pair_end = static_cast<std::uint32_t>(pairs_.size());
    places_.push_back(place);
  }
  for (const std::uint32_t node : near_nodes_) first_at_node_[grid.lattice_node(grid.nodes[node])] = kNone;
  before_.resize(place_nodes_.size());
}

void GridContact::want_cells(const UpdatedGrid& grid) {
  wanted_.assign(grid.blocks.size(), 0);
  const std::int32_t e = grid.block_edge;
  with_shape(grid, [&]<int D, class S>() {
    for (const Place& place : places_) {
      std::array<std::array<std::int32_t, 2>, 3> range{};
      for (int a = 0; a < D; ++a)
        range[a] = cells_that_matter(grid, S::place(place.at[a], grid.cell_count[a]), place.at[a], a);
      for (std::uint32_t k = place.node_begin; k < place.node_end; ++k)
        for (std::int32_t z = range[2][0]; z <= range[2][1]; ++z)
          for (std::int32_t y = range[1][0]; y <= range[1][1]; ++y)
            for (std::int32_t x = range[0][0]; x <= range[0][1]; x = (x / e + 1) * e) {
              const std::uint32_t block =
                  grid.block_of_lattice[grid.lattice_block(place_nodes_[k].field, {x / e, y / e, z / e})];
              if (block == kNone) continue;
              const std::int32_t last = std::min(range[0][1], (x / e + 1) * e - 1);
              const std::uint64_t row = (std::uint64_t{2} << (last - x)) - 1;
              wanted_[block] |= row << ((z % e * e + y % e) * e + x % e);
            }
    }
  });
  wanted_blocks_.clear();
  tile_of_block_.assign(grid.blocks.size(), kNone);
  for (std::uint32_t b = 0; b < grid.blocks.size(); ++b) {
    if (wanted_[b] == 0) continue;
    tile_of_block_[b] = static_cast<std::uint32_t>(wanted_blocks_.size());
    wanted_blocks_.push_back(b);
  }
}

}  // namespace scarp

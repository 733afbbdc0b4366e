// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/updated_grid.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/core/updated_boundary.hpp"
#include "solver/core/updated_window.hpp"
#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

/// Two 4-byte indices per node of the domain: 2 GiB.
constexpr double kMostNodes = 1 << 28;

/// Particles keep this distance to the faces of their cell, in cells, so that every node of a window of linear
/// functions gets some mass: one without would have no velocity, but a slope.
constexpr double kInside = 1e-12;

/// How far beyond the lattice the centre of a particle without a size may be, in cells: rounding.
constexpr double kSlack = 1e-9;

constexpr std::size_t kPerTask = 4096;

std::string text(const Vec3& x) { return "(" + shortest(x[0]) + ", " + shortest(x[1]) + ", " + shortest(x[2]) + ")"; }

void lay_lattice(UpdatedGrid& grid, const Domain& domain) {
  if (!(domain.cell > 0) || !std::isfinite(domain.cell))
    throw Error("solve", "cell of the domain", shortest(domain.cell), "above 0 m");
  double count = 1;
  for (int a = 0; a < domain.dimension; ++a) {
    const double cells = (domain.max[a] - domain.min[a]) / domain.cell;
    if (!(cells > 0.5 && std::abs(cells - std::round(cells)) <= 1e-6 * std::max(1.0, cells)))
      throw Error("solve", std::string("extent of the domain along ") + "xyz"[a], shortest(cells) + " cells",
                  "whole cells, at least one, for updated-Lagrangian bodies");
    count *= std::round(cells) + grid.width - 1;
    if (!(count <= kMostNodes))
      throw Error("solve", "size of the domain, whose grid the updated-Lagrangian bodies share",
                  text(domain.max - domain.min) + " m in cells of " + shortest(domain.cell) + " m",
                  "at most 268 million nodes: a smaller domain or larger cells");
    grid.cell_count[a] = static_cast<std::int32_t>(std::lround(cells));
    grid.node_count[a] = grid.cell_count[a] + grid.width - 1;
  }
}

void add_body(UpdatedGrid& grid, const Model& model, std::int32_t index) {
  const Body& body = model.bodies[index];
  if (grid.fields.empty() || model.contact.method == ContactMethod::grid) {
    grid.fields.emplace_back();
    grid.fields.back().begin = grid.particles.size();
  }
  for (std::size_t p = body.begin; p < body.end; ++p) grid.particles.push_back(static_cast<std::uint32_t>(p));
  grid.fields.back().bodies.push_back(index);
  grid.fields.back().end = grid.particles.size();
}

void choose_particles(UpdatedGrid& grid, const Model& model) {
  if (model.particles.size() >= UpdatedGrid::kNone)
    throw Error("solve", "number of particles", std::to_string(model.particles.size()), "below 2^32 - 1");
  double density = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].formulation == Formulation::updated_lagrangian)
      add_body(grid, model, static_cast<std::int32_t>(b));
  for (const std::uint32_t p : grid.particles)
    density = std::max(density, model.particles.mass[p] / model.particles.reference_volume[p]);
  grid.light_mass = 1e-10 * density * std::pow(grid.cell, grid.dimension);
}

/// Half the edge of a square or cube of the reference volume.
void find_half_edges(UpdatedGrid& grid, const Model& model) {
  grid.half_edge.assign(model.particles.size(), 0);
  for (std::uint32_t p : grid.particles) {
    const double V0 = model.particles.reference_volume[p];
    const double half = 0.5 * (grid.dimension == 2 ? std::sqrt(V0) : std::cbrt(V0)) / grid.cell;
    if (half > 0.5 * (1 + 1e-9))
      throw Error("solve", "edge of particle " + std::to_string(model.particles.id[p]),
                  shortest(2 * half) + " cells of the domain", "at most 1 with shape = \"gimp\"");
    grid.half_edge[p] = std::min(half, 0.5);
  }
}

/// How far beyond the lattice a particle's centre may be, in cells. The uniform domain of a particle that a wall
/// holds may reach over it.
double slack_of(const UpdatedGrid& grid, std::size_t particle) {
  return grid.half_edge.empty() ? kSlack : grid.half_edge[particle] + kSlack;
}

/// Of the cell that holds particle p, or kNone, and its place in it.
std::uint32_t place(UpdatedGrid& grid, std::size_t field, const Vec3& x, std::uint32_t p) {
  const bool has_size = !grid.half_edge.empty();
  const double slack = slack_of(grid, p), beyond = has_size ? grid.half_edge[p] : -kInside, per_cell = 1 / grid.cell;
  std::array<std::int32_t, 3> block{0, 0, 0};
  std::uint32_t inside = 0;
  const int bits = grid.dimension == 2 ? 3 : 2;
  for (int a = grid.dimension - 1; a >= 0; --a) {
    const double s = (x[a] - grid.origin[a]) * per_cell;
    if (!(s >= -slack && s <= grid.cell_count[a] + slack)) return UpdatedGrid::kNone;
    const std::int32_t c = std::clamp(static_cast<std::int32_t>(s), 0, grid.cell_count[a] - 1);
    grid.xi[p][a] = std::clamp(s - c, -beyond, 1 + beyond);
    block[a] = c >> bits;
    inside = inside << bits | (c & (grid.block_edge - 1));
  }
  return static_cast<std::uint32_t>(grid.lattice_block(field, block)) * UpdatedGrid::kBlockCells + inside;
}

kernels::PlaceSweep place_sweep(UpdatedGrid& grid, const Particles& particles) {
  kernels::PlaceSweep sweep{};
  sweep.position = particles.position.data()->data();
  sweep.half_edge = grid.half_edge.empty() ? nullptr : grid.half_edge.data();
  sweep.xi = grid.xi.data()->data();
  sweep.keys = grid.cell_keys.data();
  sweep.per_cell = 1 / grid.cell;
  sweep.slack = kSlack;
  sweep.inside = grid.half_edge.empty() ? kInside : 0;
  for (int a = 0; a < 3; ++a) {
    sweep.origin[a] = grid.origin[a];
    sweep.cell_count[a] = grid.cell_count[a];
    sweep.block_count[a] = grid.block_count[a];
  }
  return sweep;
}

/// Of the entries [begin, end) of the list of particles, which are of one field.
void find_keys(UpdatedGrid& grid, const Particles& particles, std::size_t field, std::size_t begin, std::size_t end,
               KeyBlock& found) {
  for (std::size_t j = begin; j < end; ++j) {
    const std::uint32_t p = grid.particles[j];
    const std::uint32_t key = place(grid, field, particles.position[p], p);
    if (key == UpdatedGrid::kNone) found.outside = std::min(found.outside, j);
    found.changed |= key != grid.cell_keys[j];
    grid.cell_keys[j] = key;
  }
}

KeyBlock find_keys(UpdatedGrid& grid, const Particles& particles, int threads) {
  const std::size_t count = grid.particles.size();
  std::vector<KeyBlock>& found = grid.key_blocks;
  found.assign((count + kPerTask - 1) / kPerTask, {});
  const kernels::PlaceSweep sweep = place_sweep(grid, particles);
  parallel_for(found.size(), threads, [&](std::size_t t) {
    for (std::size_t f = 0; f < grid.fields.size(); ++f) {
      const std::size_t begin = std::max(t * kPerTask, grid.fields[f].begin);
      const std::size_t end = std::min((t + 1) * kPerTask, grid.fields[f].end);
      if (begin >= end) continue;
      if (!grid.kernels) {
        find_keys(grid, particles, f, begin, end, found[t]);
        continue;
      }
      kernels::PlaceSweep of_field = sweep;
      of_field.field = static_cast<double>(f);
      grid.kernels->particles.place[grid.dimension - 2](of_field, grid.particles.data(), begin, end, found[t]);
    }
  });
  KeyBlock all;
  for (const KeyBlock& keys : found) {
    all.outside = std::min(all.outside, keys.outside);
    all.changed |= keys.changed;
  }
  return all;
}

/// The cell `inside` a block of the lattice.
std::array<std::int32_t, 3> cell_in(const UpdatedGrid& grid, const std::array<std::int32_t, 3>& block, int inside) {
  const int e = grid.block_edge;
  return {block[0] * e + inside % e, block[1] * e + inside / e % e, block[2] * e + inside / (e * e)};
}

std::uint32_t block_of(UpdatedGrid& grid, std::uint32_t key) {
  const std::uint32_t place = key / UpdatedGrid::kBlockCells;
  std::uint32_t& block = grid.block_of_lattice[place];
  if (block == UpdatedGrid::kNone) {
    block = static_cast<std::uint32_t>(grid.blocks.size());
    const auto nx = static_cast<std::uint32_t>(grid.block_count[0]),
               ny = static_cast<std::uint32_t>(grid.block_count[1]),
               nz = static_cast<std::uint32_t>(grid.block_count[2]);
    grid.blocks.push_back({static_cast<std::int32_t>(place % nx), static_cast<std::int32_t>(place / nx % ny),
                           static_cast<std::int32_t>(place / nx / ny % nz)});
    grid.block_field.push_back(place / nx / ny / nz);
    grid.counts.resize(grid.counts.size() + UpdatedGrid::kBlockCells, 0);
  }
  return block;
}

/// A stable counting sort of the particles by cell; blocks stand in the order in which particles name them, and so by
/// field.
void sort_into_cells(UpdatedGrid& grid) {
  constexpr int in_block = UpdatedGrid::kBlockCells;
  for (std::size_t b = 0; b < grid.blocks.size(); ++b)
    grid.block_of_lattice[grid.lattice_block(grid.block_field[b], grid.blocks[b])] = UpdatedGrid::kNone;
  grid.blocks.clear();
  grid.block_field.clear();
  grid.counts.clear();
  for (std::uint32_t key : grid.cell_keys) {
    const std::size_t block = block_of(grid, key);
    ++grid.counts[block * in_block + key % in_block];
  }
  grid.cells.clear();
  grid.occupied.clear();
  grid.first_in_tile.clear();
  grid.cell_begin.assign(1, 0);
  grid.block_begin.assign(1, 0);
  std::uint32_t begin = 0;
  for (std::size_t b = 0; b < grid.blocks.size(); ++b) {
    const auto place = static_cast<std::uint32_t>(grid.lattice_block(grid.block_field[b], grid.blocks[b]));
    for (int inside = 0; inside < in_block; ++inside) {
      std::uint32_t& count = grid.counts[b * in_block + inside];
      const std::uint32_t own = count;
      count = begin;
      if (own == 0) continue;
      const auto cell = cell_in(grid, grid.blocks[b], inside);
      const int e = grid.block_edge, t = grid.tile_edge;
      grid.cells.push_back(cell);
      grid.occupied.push_back(place * in_block + inside);
      grid.first_in_tile.push_back((cell[2] % e * t + cell[1] % e) * t + cell[0] % e);
      grid.cell_begin.push_back(begin += own);
    }
    grid.block_begin.push_back(static_cast<std::uint32_t>(grid.cells.size()));
  }
  for (std::size_t j = 0; j < grid.particles.size(); ++j) {
    const std::uint32_t key = grid.cell_keys[j];
    const std::size_t block = grid.block_of_lattice[key / in_block];
    grid.members[grid.counts[block * in_block + key % in_block]++] = grid.particles[j];
  }
}

/// Of one block: gives its tile's functions their nodes.
void number_nodes_of(UpdatedGrid& grid, std::size_t block) {
  const int w = grid.width, t = grid.tile_edge, deep = grid.dimension == 2 ? 1 : w;
  std::uint32_t* tile = &grid.tile_nodes[block * grid.tile()];
  for (std::uint32_t c = grid.block_begin[block]; c < grid.block_begin[block + 1]; ++c)
    for (int k = 0; k < deep; ++k)
      for (int j = 0; j < w; ++j)
        for (int i = 0; i < w; ++i) {
          std::uint32_t& entry = tile[grid.first_in_tile[c] + (k * t + j) * t + i];
          if (entry != UpdatedGrid::kNone) continue;
          const std::array<std::int32_t, 3> at{grid.cells[c][0] + i, grid.cells[c][1] + j, grid.cells[c][2] + k};
          std::uint32_t& node = grid.node_of_lattice[grid.lattice_node(at)];
          if (node == UpdatedGrid::kNone) {
            node = static_cast<std::uint32_t>(grid.nodes.size());
            grid.nodes.push_back(at);
          }
          entry = node;
        }
}

/// Ends what node_of_lattice says of a field.
void forget_nodes(UpdatedGrid& grid, const UpdatedField& field) {
  for (std::uint32_t i = field.node_begin; i < field.node_end; ++i)
    grid.node_of_lattice[grid.lattice_node(grid.nodes[i])] = UpdatedGrid::kNone;
}

void number_nodes(UpdatedGrid& grid) {
  forget_nodes(grid, grid.fields.back());
  grid.nodes.clear();
  grid.tile_nodes.assign(grid.blocks.size() * grid.tile(), UpdatedGrid::kNone);
  for (auto& colour : grid.colours) colour.clear();
  for (std::size_t b = 0, f = 0; f < grid.fields.size(); ++f) {
    UpdatedField& field = grid.fields[f];
    if (f > 0) forget_nodes(grid, grid.fields[f - 1]);
    field.node_begin = static_cast<std::uint32_t>(grid.nodes.size());
    for (; b < grid.blocks.size() && grid.block_field[b] == f; ++b) {
      const auto& place = grid.blocks[b];
      grid.colours[(place[0] & 1) + 2 * (place[1] & 1) + 4 * (place[2] & 1)].push_back(static_cast<std::uint32_t>(b));
      number_nodes_of(grid, b);
    }
    field.node_end = static_cast<std::uint32_t>(grid.nodes.size());
  }
  const std::size_t nodes = grid.nodes.size();
  grid.tiles.resize(grid.tile_nodes.size());
  grid.momentum_tiles.resize(grid.tile_nodes.size());
  grid.sums.resize(nodes);
  grid.held.resize(nodes);
  grid.mass.resize(nodes);
  grid.velocity.resize(nodes);
  grid.velocity_updated.resize(nodes);
}

}  // namespace

UpdatedGrid make_updated_grid(const Model& model, ShapeFunction shape, int threads) {
  UpdatedGrid grid;
  grid.dimension = model.domain.dimension;
  grid.shape = shape;
  grid.width = shape == ShapeFunction::linear ? 2 : shape == ShapeFunction::quadratic_bspline ? 3 : 4;
  grid.cell = model.domain.cell;
  grid.origin = model.domain.min;
  lay_lattice(grid, model.domain);
  choose_particles(grid, model);
  if (shape == ShapeFunction::gimp) find_half_edges(grid, model);
  find_held_axes(grid, model);
  grid.block_edge = kernels::block_edge(grid.dimension);
  grid.tile_edge = grid.block_edge + grid.width - 1;
  for (int a = 0; a < grid.dimension; ++a)
    grid.block_count[a] = (grid.cell_count[a] + grid.block_edge - 1) / grid.block_edge;
  const double keys = static_cast<double>(grid.lattice_blocks() * UpdatedGrid::kBlockCells);
  if (!(keys * static_cast<double>(grid.fields.size()) < UpdatedGrid::kNone))
    throw Error("solve", "cells of the domain x bodies with a field of their own",
                shortest(keys) + " x " + std::to_string(grid.fields.size()),
                "below 2^32: a smaller domain, larger cells, or contact.method other than \"grid\"");
  grid.block_of_lattice.assign(grid.lattice_blocks() * grid.fields.size(), UpdatedGrid::kNone);
  const auto& n = grid.node_count;
  grid.node_of_lattice.assign(static_cast<std::size_t>(n[0]) * n[1] * n[2], UpdatedGrid::kNone);
  grid.cell_keys.assign(grid.particles.size(), UpdatedGrid::kNone);
  grid.members.resize(grid.particles.size());
  grid.xi.assign(model.particles.size(), Vec3{0, 0, 0});
  const std::int64_t outside = place_particles(grid, model.particles, threads);
  if (outside >= 0)
    throw Error("solve",
                "particle " + std::to_string(model.particles.id[outside]) + " of updated-Lagrangian body '" +
                    model.bodies[model.particles.body[outside]].name + "' lies outside the domain",
                text(model.particles.position[outside]),
                text(model.domain.min) + " to " + text(model.domain.max) + " m");
  return grid;
}

std::int64_t place_particles(UpdatedGrid& grid, const Particles& particles, int threads) {
  const KeyBlock found = find_keys(grid, particles, threads);
  if (found.outside < grid.particles.size()) return grid.particles[found.outside];
  if (found.changed) {
    std::swap(grid.occupied, grid.occupied_before);
    sort_into_cells(grid);
    if (grid.occupied != grid.occupied_before) {
      number_nodes(grid);
      hold_nodes(grid, threads);
      ++grid.placings;
    }
  }
  grid.held_now = grid.held;
  return -1;
}

std::vector<Vec3> node_positions(const UpdatedGrid& grid) {
  std::vector<Vec3> positions(grid.nodes.size(), grid.origin);
  with_shape(grid, [&]<int D, class S>() {
    for (std::size_t i = 0; i < positions.size(); ++i)
      for (int a = 0; a < D; ++a) positions[i][a] += grid.cell * S::place(grid.nodes[i][a], grid.cell_count[a]);
  });
  return positions;
}

void average_volumes(UpdatedGrid& grid) {
  grid.averages = true;
  grid.trial.assign(grid.particles.size(), kIdentity);
}

double memory_bytes(const UpdatedGrid& grid) {
  double bytes = 0;
  const auto add = [&](const auto&... arrays) {
    ((bytes += static_cast<double>(arrays.size()) * sizeof(arrays[0])), ...);
  };
  for (const UpdatedField& field : grid.fields) add(field.held_by_set);
  add(grid.particles, grid.half_edge, grid.block_field, grid.block_of_lattice, grid.node_of_lattice, grid.cell_keys);
  add(grid.key_blocks, grid.blocks, grid.counts, grid.block_begin, grid.tile_nodes, grid.momentum_tiles, grid.tiles);
  add(grid.cells, grid.cell_begin, grid.first_in_tile, grid.occupied, grid.occupied_before, grid.members, grid.xi);
  add(grid.affine, grid.filtered, grid.term, grid.kept);
  add(grid.volume, grid.trial, grid.nodes, grid.held, grid.held_now, grid.sums, grid.mass, grid.velocity,
      grid.velocity_updated);
  return bytes;
}

}  // namespace scarp

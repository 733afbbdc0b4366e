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

void choose_particles(UpdatedGrid& grid, const Model& model) {
  if (model.particles.size() >= UpdatedGrid::kNone)
    throw Error("solve", "number of particles", std::to_string(model.particles.size()), "below 2^32 - 1");
  double density = 0;
  for (const Body& body : model.bodies) {
    if (body.formulation != Formulation::updated_lagrangian) continue;
    for (std::size_t p = body.begin; p < body.end; ++p) {
      grid.particles.push_back(static_cast<std::uint32_t>(p));
      density = std::max(density, model.particles.mass[p] / model.particles.reference_volume[p]);
    }
  }
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
  return grid.half_edge.empty() ? 1e-9 : grid.half_edge[particle] + 1e-9;
}

std::uint32_t key_of(const UpdatedGrid& grid, const Vec3& x, double slack) {
  std::array<std::int32_t, 3> c{0, 0, 0};
  for (int a = 0; a < grid.dimension; ++a) {
    const double s = (x[a] - grid.origin[a]) / grid.cell;
    if (!(s >= -slack && s <= grid.cell_count[a] + slack)) return UpdatedGrid::kNone;
    c[a] = std::clamp(static_cast<std::int32_t>(std::floor(s)), 0, grid.cell_count[a] - 1);
  }
  return static_cast<std::uint32_t>(grid.lattice_cell(c));
}

KeyBlock find_keys(UpdatedGrid& grid, const Particles& particles, int threads) {
  const std::size_t count = grid.particles.size();
  std::vector<KeyBlock>& found = grid.key_blocks;
  found.assign((count + kPerTask - 1) / kPerTask, {});
  parallel_for(found.size(), threads, [&](std::size_t t) {
    for (std::size_t j = t * kPerTask; j < std::min(count, (t + 1) * kPerTask); ++j) {
      const std::uint32_t p = grid.particles[j];
      const std::uint32_t key = key_of(grid, particles.position[p], slack_of(grid, p));
      if (key == UpdatedGrid::kNone) found[t].outside = std::min(found[t].outside, j);
      found[t].changed |= key != grid.cell_keys[j];
      grid.cell_keys[j] = key;
    }
  });
  KeyBlock all;
  for (const KeyBlock& keys : found) {
    all.outside = std::min(all.outside, keys.outside);
    all.changed |= keys.changed;
  }
  return all;
}

std::uint32_t node_key(const UpdatedGrid& grid, const std::array<std::int32_t, 3>& cell, int k) {
  const int w = grid.width;
  return static_cast<std::uint32_t>(grid.lattice_node({cell[0] + k % w, cell[1] + k / w % w, cell[2] + k / (w * w)}));
}

/// Forgets the occupied cells and their nodes; touches nothing else of the lattice.
void clear(UpdatedGrid& grid) {
  for (const auto& c : grid.cells) grid.cell_of_lattice[grid.lattice_cell(c)] = UpdatedGrid::kNone;
  for (const auto& n : grid.nodes) grid.node_of_lattice[grid.lattice_node(n)] = UpdatedGrid::kNone;
  grid.cells.clear();
  grid.nodes.clear();
}

/// A stable counting sort of the particles by cell; cells stand in the order in which particles name them.
void sort_into_cells(UpdatedGrid& grid) {
  grid.cell_begin.assign(1, 0);
  for (std::uint32_t key : grid.cell_keys) {
    std::uint32_t& cell = grid.cell_of_lattice[key];
    if (cell == UpdatedGrid::kNone) {
      cell = static_cast<std::uint32_t>(grid.cells.size());
      const auto nx = static_cast<std::uint32_t>(grid.cell_count[0]),
                 ny = static_cast<std::uint32_t>(grid.cell_count[1]);
      grid.cells.push_back({static_cast<std::int32_t>(key % nx), static_cast<std::int32_t>(key / nx % ny),
                            static_cast<std::int32_t>(key / nx / ny)});
      grid.cell_begin.push_back(0);
    }
    ++grid.cell_begin[cell + 1];
  }
  // Ranges, then filled from the front: cell_begin[c] runs through the cell's range to the next one's begin.
  std::size_t begin = 0;
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    const std::size_t count = grid.cell_begin[c + 1];
    grid.cell_begin[c] = begin;
    begin += count;
  }
  for (std::size_t j = 0; j < grid.particles.size(); ++j)
    grid.members[grid.cell_begin[grid.cell_of_lattice[grid.cell_keys[j]]]++] = grid.particles[j];
  for (std::size_t c = grid.cells.size(); c > 0; --c) grid.cell_begin[c] = grid.cell_begin[c - 1];
  grid.cell_begin[0] = 0;
}

void number_nodes(UpdatedGrid& grid) {
  const int window = grid.window(), w = grid.width;
  for (const auto& cell : grid.cells)
    for (int k = 0; k < window; ++k) {
      std::uint32_t& node = grid.node_of_lattice[node_key(grid, cell, k)];
      if (node != UpdatedGrid::kNone) continue;
      node = static_cast<std::uint32_t>(grid.nodes.size());
      grid.nodes.push_back({cell[0] + k % w, cell[1] + k / w % w, cell[2] + k / (w * w)});
    }
  const std::size_t nodes = grid.nodes.size();
  grid.slots.resize(grid.cells.size() * window);
  grid.held.resize(nodes);
  grid.mass.resize(nodes);
  grid.velocity.resize(nodes);
  grid.velocity_updated.resize(nodes);
}

void find_places(UpdatedGrid& grid, const Particles& particles, int threads) {
  parallel_for(grid.cells.size(), threads, [&](std::size_t c) {
    for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
      const std::uint32_t p = grid.members[m];
      const double beyond = grid.half_edge.empty() ? -kInside : grid.half_edge[p];
      for (int a = 0; a < grid.dimension; ++a)
        grid.xi[m][a] =
            std::clamp((particles.position[p][a] - grid.origin[a]) / grid.cell - grid.cells[c][a], -beyond, 1 + beyond);
    }
  });
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
  const auto product = [](const std::array<std::int32_t, 3>& n) {
    return static_cast<std::size_t>(n[0]) * n[1] * n[2];
  };
  grid.cell_of_lattice.assign(product(grid.cell_count), UpdatedGrid::kNone);
  grid.node_of_lattice.assign(product(grid.node_count), UpdatedGrid::kNone);
  grid.cell_keys.assign(grid.particles.size(), UpdatedGrid::kNone);
  grid.members.resize(grid.particles.size());
  grid.xi.assign(grid.particles.size(), Vec3{0, 0, 0});
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
    clear(grid);
    sort_into_cells(grid);
    number_nodes(grid);
    hold_nodes(grid, threads);
    ++grid.placings;
  }
  grid.held_now = grid.held;
  find_places(grid, particles, threads);
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
  add(grid.particles, grid.half_edge, grid.held_by_set, grid.cell_of_lattice, grid.node_of_lattice, grid.cell_keys);
  add(grid.key_blocks, grid.cells, grid.cell_begin, grid.members, grid.xi, grid.slots);
  add(grid.affine, grid.filtered, grid.term, grid.kept);
  add(grid.trial, grid.nodes, grid.held, grid.held_now, grid.mass, grid.velocity, grid.velocity_updated);
  return bytes;
}

}  // namespace scarp

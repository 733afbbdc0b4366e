// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/reference_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>

#include "solver/core/linear_cell.hpp"
#include "solver/kernels/particles.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

std::string text(const Vec3& x) { return "(" + shortest(x[0]) + ", " + shortest(x[1]) + ", " + shortest(x[2]) + ")"; }

struct Place {
  LatticeIndex cell{0, 0, 0};
  Vec3 xi{0, 0, 0};
};

/// Where the particles of a grid stand, and how far they are kept from the faces of their cells, in cells.
struct Places {
  const std::vector<Vec3>& X;
  double inset = 0;
};

Places reference_places(const Model& model) { return {model.particles.reference_position}; }
Places current_places(const Model& model) { return {model.particles.position, 1e-3}; }

/// A particle on the lattice's upper face belongs to the last cell; 1e-9 cell beyond is taken for rounding.
Place place_of(const Model& model, const Body& body, const Places& places, std::size_t particle) {
  const Vec3& X = places.X[particle];
  Place place;
  for (int a = 0; a < body.lattice.dimension(); ++a) {
    const double s = (X[a] - body.lattice.origin[a]) / body.lattice.cell;
    const std::int32_t count = body.lattice.cells[a];
    if (!(s >= -1e-9 && s <= count + 1e-9))
      throw Error("solve",
                  "particle " + std::to_string(model.particles.id[particle]) + " of body '" + body.name +
                      "' lies outside the body's lattice",
                  text(X), "within the lattice of " + std::to_string(count) + " cells along " + "xyz"[a]);
    place.cell[a] = std::clamp(static_cast<std::int32_t>(std::floor(s)), 0, count - 1);
    place.xi[a] = std::clamp(s - place.cell[a], places.inset, 1 - places.inset);
  }
  return place;
}

/// Lexicographic, x fastest. Nodes have one more per axis than cells; the same strides serve both.
std::int64_t key_of(const Lattice& lattice, const LatticeIndex& i) {
  const std::int64_t nx = lattice.cells[0] + std::int64_t{1}, ny = lattice.cells[1] + std::int64_t{1};
  return (i[2] * ny + i[1]) * nx + i[0];
}

/// Of the block of 64 cells in which the sweeps over updated-Lagrangian particles go, in the same order; 0 for bodies
/// that go by rows of cells.
std::int64_t block_key_of(const Body& body, const LatticeIndex& i) {
  if (body.formulation != Formulation::updated_lagrangian) return 0;
  const int edge = kernels::block_edge(body.lattice.dimension());
  return key_of(body.lattice, {i[0] / edge, i[1] / edge, i[2] / edge});
}

LatticeIndex index_of(const Lattice& lattice, std::int64_t key) {
  const std::int64_t nx = lattice.cells[0] + std::int64_t{1}, ny = lattice.cells[1] + std::int64_t{1};
  return {static_cast<std::int32_t>(key % nx), static_cast<std::int32_t>(key / nx % ny),
          static_cast<std::int32_t>(key / nx / ny)};
}

void check_lattice(const Body& body) {
  const auto nodes = body.lattice.nodes();
  const double count = static_cast<double>(nodes[0]) * nodes[1] * nodes[2];
  if (body.lattice.cells[0] < 1 || body.lattice.cells[1] < 1 || body.lattice.cells[2] < 0 || !(count < 9e18))
    throw Error("solve", "number of cells of the lattice of body '" + body.name + "'", shortest(count),
                "at least one cell per axis, fewer than 9e18 in all");
}

std::vector<std::int64_t> node_keys(const Lattice& lattice, const std::vector<std::int64_t>& cell_keys) {
  const std::int64_t nx = lattice.cells[0] + std::int64_t{1}, ny = lattice.cells[1] + std::int64_t{1};
  const int corners = lattice.flat() ? 4 : 8;
  std::vector<std::int64_t> keys;
  keys.reserve(cell_keys.size() * corners);
  for (std::int64_t cell : cell_keys)
    for (int k = 0; k < corners; ++k) keys.push_back(cell + (k & 1) + nx * (k >> 1 & 1) + nx * ny * (k >> 2));
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

void connect(ReferenceGrid& grid, const Lattice& lattice, const std::vector<std::int64_t>& cell_keys) {
  const std::vector<std::int64_t> keys = node_keys(lattice, cell_keys);
  const std::int64_t nx = lattice.cells[0] + std::int64_t{1}, ny = lattice.cells[1] + std::int64_t{1};
  const std::size_t corners = grid.corners();
  if (cell_keys.size() * corners > std::numeric_limits<std::uint32_t>::max())
    throw Error("solve", "number of occupied cells of a body", std::to_string(cell_keys.size()),
                "at most " + std::to_string(std::numeric_limits<std::uint32_t>::max() / corners));
  grid.nodes.reserve(keys.size());
  grid.cell_nodes.reserve(cell_keys.size() * corners);
  for (std::int64_t key : keys) grid.nodes.push_back(index_of(lattice, key));
  grid.around_begin.assign(keys.size() + 1, 0);
  for (std::int64_t cell : cell_keys)
    for (std::size_t k = 0; k < corners; ++k) {
      const std::int64_t key = cell + static_cast<std::int64_t>((k & 1) + nx * (k >> 1 & 1) + nx * ny * (k >> 2));
      const auto node = std::lower_bound(keys.begin(), keys.end(), key) - keys.begin();
      grid.cell_nodes.push_back(static_cast<std::uint32_t>(node));
      ++grid.around_begin[node + 1];
    }
  std::partial_sum(grid.around_begin.begin(), grid.around_begin.end(), grid.around_begin.begin());
  grid.around.resize(grid.cell_nodes.size());
  std::vector<std::uint32_t> next(grid.around_begin.begin(), grid.around_begin.end() - 1);
  for (std::uint32_t slot = 0; slot < grid.cell_nodes.size(); ++slot) grid.around[next[grid.cell_nodes[slot]]++] = slot;
}

template <int D>
void weigh(ReferenceGrid& grid, const Model& model, const Body& body, const Places& places) {
  using Cell = LinearCell<D>;
  grid.node_mass.assign(grid.nodes.size(), 0);
  double heaviest = 0;
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    typename Cell::Values m, sums{};
    for (std::size_t p = grid.cell_begin[c]; p < grid.cell_begin[c + 1]; ++p) {
      Cell::monomials(place_of(model, body, places, p).xi, m);
      Cell::add_value(sums, m, model.particles.mass[p]);
      heaviest = std::max(heaviest, model.particles.mass[p]);
    }
    Cell::to_corners(sums);
    for (int k = 0; k < Cell::N; ++k) grid.node_mass[grid.cell_nodes[c * Cell::N + k]] += sums[k];
  }
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    if (grid.node_mass[i] > 1e-12 * heaviest) continue;
    const std::size_t cell = grid.around[grid.around_begin[i]] / Cell::N;
    const std::size_t p = grid.cell_begin[cell];
    throw Error("solve",
                "particle " + std::to_string(model.particles.id[p]) + " of body '" + body.name +
                    "' lies on a face of its cell, and no other gives mass to the node across",
                text(model.particles.reference_position[p]), "reference positions inside the cells");
  }
}

/// What particles of a body are sorted by: block and cell, material and id.
using Rank = std::tuple<std::int64_t, std::int64_t, std::int32_t, std::int64_t>;
Rank rank_of(const Model& model, const Body& body, const Places& places, std::size_t p) {
  const LatticeIndex cell = place_of(model, body, places, p).cell;
  return {block_key_of(body, cell), key_of(body.lattice, cell), model.particles.material[p], model.particles.id[p]};
}

bool is_in_order(const Model& model, const Body& body, const Places& places) {
  check_lattice(body);
  Rank last = rank_of(model, body, places, body.begin);
  for (std::size_t p = body.begin + 1; p < body.end; ++p) {
    const Rank next = rank_of(model, body, places, p);
    if (!(last < next)) return false;
    last = next;
  }
  return true;
}

/// Puts the body's part of `order` in order.
void order_by_cell(std::vector<std::size_t>& order, const Model& model, const Body& body, const Places& places) {
  check_lattice(body);
  std::vector<Rank> ranks;
  ranks.reserve(body.end - body.begin);
  for (std::size_t p = body.begin; p < body.end; ++p) ranks.push_back(rank_of(model, body, places, p));
  std::sort(order.begin() + static_cast<std::ptrdiff_t>(body.begin),
            order.begin() + static_cast<std::ptrdiff_t>(body.end),
            [&](std::size_t a, std::size_t b) { return ranks[a - body.begin] < ranks[b - body.begin]; });
}

std::vector<std::size_t> present_order(const Model& model) {
  std::vector<std::size_t> order(model.particles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

void put_in_order(Model& model, const std::vector<std::size_t>& order) {
  if (!std::is_sorted(order.begin(), order.end())) permute_particles(model.particles, order);
}

/// Of particles in order.
std::size_t count_cells(const Model& model, const Body& body, const Places& places) {
  std::size_t cells = 0;
  LatticeIndex last{-1, -1, -1};
  for (std::size_t p = body.begin; p < body.end; ++p) {
    const LatticeIndex cell = place_of(model, body, places, p).cell;
    cells += cell != last;
    last = cell;
  }
  return cells;
}

ReferenceGrid build_grid(const Model& model, const Body& body, const Places& places, bool keep_places) {
  check_lattice(body);
  ReferenceGrid grid;
  grid.dimension = body.lattice.dimension();
  grid.cell = body.lattice.cell;
  grid.origin = body.lattice.origin;
  if (keep_places) grid.xi.reserve(body.end - body.begin);
  std::vector<std::int64_t> cell_keys;
  const std::size_t cells = count_cells(model, body, places);
  cell_keys.reserve(cells);
  grid.cells.reserve(cells);
  grid.cell_begin.reserve(cells + 1);
  for (std::size_t p = body.begin; p < body.end; ++p) {
    const Place place = place_of(model, body, places, p);
    if (keep_places) grid.xi.push_back(place.xi);
    const std::int64_t key = key_of(body.lattice, place.cell);
    if (!cell_keys.empty() && cell_keys.back() == key) continue;
    cell_keys.push_back(key);
    grid.cells.push_back(place.cell);
    grid.cell_begin.push_back(p);
  }
  grid.cell_begin.push_back(body.end);
  connect(grid, body.lattice, cell_keys);
  grid.dimension == 2 ? weigh<2>(grid, model, body, places) : weigh<3>(grid, model, body, places);
  return grid;
}

}  // namespace

void sort_by_cell(Model& model) {
  if (std::all_of(model.bodies.begin(), model.bodies.end(),
                  [&](const Body& body) { return is_in_order(model, body, reference_places(model)); }))
    return;
  std::vector<std::size_t> order = present_order(model);
  for (const Body& body : model.bodies) order_by_cell(order, model, body, reference_places(model));
  put_in_order(model, order);
}

void sort_by_current_cell(Model& model, const Body& body) {
  std::vector<std::size_t> order = present_order(model);
  order_by_cell(order, model, body, current_places(model));
  put_in_order(model, order);
}

ReferenceGrid build_reference_grid(const Model& model, const Body& body, bool keep_places) {
  return build_grid(model, body, reference_places(model), keep_places);
}

ReferenceGrid build_current_grid(const Model& model, const Body& body) {
  return build_grid(model, body, current_places(model), true);
}

GridCounts count_grid(const Model& model, const Body& body) {
  check_lattice(body);
  std::vector<std::int64_t> keys;
  keys.reserve(body.end - body.begin);
  for (std::size_t p = body.begin; p < body.end; ++p) {
    const std::int64_t key = key_of(body.lattice, place_of(model, body, reference_places(model), p).cell);
    if (keys.empty() || keys.back() != key) keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return {keys.size(), node_keys(body.lattice, keys).size()};
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/total_body.hpp"

#include <algorithm>

#include "solver/core/boundary.hpp"
#include "solver/core/law_kernels.hpp"
#include "solver/core/wave_speeds.hpp"

namespace scarp {
namespace {

/// Enough work to hide the cost of handing it out, few enough that any number of threads is kept busy.
constexpr std::uint32_t kCellsPerTask = 64;

/// The material of all particles of a cell, or -1. Within a cell they are sorted by material.
std::int32_t material_of_cell(const Particles& particles, const ReferenceGrid& grid, std::uint32_t cell) {
  const std::int32_t first = particles.material[grid.cell_begin[cell]];
  return first == particles.material[grid.cell_begin[cell + 1] - 1] ? first : -1;
}

std::vector<CellTask> cut_into_tasks(const Particles& particles, const ReferenceGrid& grid) {
  std::vector<CellTask> tasks;
  for (std::uint32_t cell = 0; cell < grid.cells.size(); ++cell) {
    const std::int32_t material = material_of_cell(particles, grid, cell);
    if (tasks.empty() || tasks.back().material != material || cell - tasks.back().begin == kCellsPerTask)
      tasks.push_back({.begin = cell, .end = cell, .material = material});
    tasks.back().end = cell + 1;
  }
  return tasks;
}

std::vector<Vec3> positions_of(const ReferenceGrid& grid, const Lattice& lattice) {
  std::vector<Vec3> positions;
  positions.reserve(grid.nodes.size());
  for (const LatticeIndex& i : grid.nodes)
    positions.push_back(lattice.origin + lattice.cell * Vec3{1.0 * i[0], 1.0 * i[1], 1.0 * i[2]});
  return positions;
}

void make_arrays(TotalBody& total) {
  total.velocity.assign(total.grid.nodes.size(), Vec3{0, 0, 0});
  total.velocity_updated.assign(total.grid.nodes.size(), Vec3{0, 0, 0});
  total.slots.assign(total.grid.cell_nodes.size(), Vec3{0, 0, 0});
}

/// All but those.
TotalBody make_body(const Model& model, const Body& body, ReferenceGrid grid) {
  TotalBody total;
  total.begin = body.begin;
  total.end = body.end;
  total.grid = std::move(grid);
  for (const NamedMaterial& material : model.materials) total.laws.push_back(prepare(material.law, body.lattice.cell));
  total.tasks = cut_into_tasks(model.particles, total.grid);
  total.held = held_axes(model.domain, body, total.grid);
  total.held_now = total.held;
  total.node_positions = positions_of(total.grid, body.lattice);
  total.conditions.faces = NodeFaces(
      model.domain, body.lattice.cell, total.node_positions, total.held,
      has_absorbing_face(model.domain) ? node_wave_speeds(model, total.grid, body.begin) : std::vector<Vec2>(), true);
  const std::size_t nodes = total.grid.nodes.size();
  total.inverse_mass.resize(nodes);
  std::transform(total.grid.node_mass.begin(), total.grid.node_mass.end(), total.inverse_mass.begin(),
                 [](double m) { return 1 / m; });
  return total;
}

}  // namespace

TotalBody make_bare_body(const Model& model, const Body& body) {
  return make_body(model, body, build_reference_grid(model, body, false));
}

void make_room_for_sweeps(TotalBody& total, const Model& model, const Body& body) {
  total.grid.xi.reserve(body.end - body.begin);
  for (std::size_t cell = 0; cell < total.grid.cells.size(); ++cell)
    for (std::size_t p = total.grid.cell_begin[cell]; p < total.grid.cell_begin[cell + 1]; ++p)
      total.grid.xi.push_back(total.grid.place_of(cell, model.particles.reference_position[p]));
  make_arrays(total);
}

void use_kernels(TotalBody& total, const Model& model, const kernels::Kernels& widest) {
  if (widest.lanes == 1) return;
  total.kernels = &best_filled(total.grid.cell_begin, widest);
  total.law_parameters = kernels_of(model);
}

TotalBody make_total_body(const Model& model, const Body& body) {
  TotalBody total = make_bare_body(model, body);
  make_room_for_sweeps(total, model, body);
  return total;
}

TotalBody make_total_body(const Model& model, const Body& body, ReferenceGrid grid) {
  TotalBody total = make_body(model, body, std::move(grid));
  make_arrays(total);
  return total;
}

}  // namespace scarp

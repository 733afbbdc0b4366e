// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/total_loads.hpp"

#include <algorithm>
#include <string>

#include "solver/core/check_model.hpp"
#include "solver/core/linear_cell.hpp"
#include "solver/core/pore_water.hpp"
#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

/// sum_p phi_Ip f_p of the body's particles.
template <int D>
std::vector<Vec3> map_forces(const TotalBody& body, const Particles& particles, const ParticleForces& load) {
  using Cell = LinearCell<D>;
  std::vector<Vec3> nodes(body.grid.nodes.size(), Vec3{0, 0, 0});
  for (std::size_t k = 0; k < load.particles.size(); ++k) {
    const std::size_t p = load.particles[k];
    if (p < body.begin || p >= body.end) continue;
    const auto& begin = body.grid.cell_begin;
    const std::size_t cell = std::upper_bound(begin.begin(), begin.end(), p) - begin.begin() - 1;
    typename Cell::Values m, weights{};
    Cell::monomials(body.grid.place(cell, p - body.begin, particles.reference_position[p]), m);
    Cell::add_value(weights, m, 1);
    Cell::to_corners(weights);
    for (int c = 0; c < Cell::N; ++c) {
      Vec3& node = nodes[body.grid.cell_nodes[cell * Cell::N + c]];
      node = node + weights[c] * load.forces[k];
    }
  }
  return nodes;
}

/// Whether any node is in the region of what a load imposes, per load.
std::vector<bool> set_loads(TotalBody& body, const Model& model, const std::vector<ParticleForces>& forces) {
  NodeLoads& loads = body.conditions.loads;
  std::vector<bool> found = loads.impose(model, body.node_positions, model.particles.body[body.begin], body.held);
  body.held_now = body.held;
  for (const ParticleForces& load : forces)
    loads.add_forces(load.table,
                     body.grid.dimension == 2 ? map_forces<2>(body, model.particles, load)
                                              : map_forces<3>(body, model.particles, load),
                     body.held);
  return found;
}

template <int D>
void add_water(const Particles& particles, TotalBody& body, const WaterTable& water, double ramp, std::size_t cell) {
  using Cell = LinearCell<D>;
  typename Cell::Values m, sums[D]{};
  for (std::size_t p = body.grid.cell_begin[cell]; p < body.grid.cell_begin[cell + 1]; ++p) {
    const Vec3 force = ramp * water_force(water, particles, p, D);
    Cell::monomials(body.grid.xi[p - body.begin], m);
    for (int d = 0; d < D; ++d) Cell::add_value(sums[d], m, force[d]);
  }
  for (int d = 0; d < D; ++d) Cell::to_corners(sums[d]);
  for (int k = 0; k < Cell::N; ++k)
    for (int d = 0; d < D; ++d) body.water_slots[cell * Cell::N + k][d] = sums[d][k];
}

}  // namespace

void map_water_force(const Particles& particles, TotalBody& body, const WaterTable& water, double ramp, int threads) {
  body.water_slots.resize(body.slots.size(), Vec3{0, 0, 0});
  parallel_for(body.tasks.size(), threads, [&](std::size_t t) {
    for (std::size_t cell = body.tasks[t].begin; cell < body.tasks[t].end; ++cell)
      body.grid.dimension == 2 ? add_water<2>(particles, body, water, ramp, cell)
                               : add_water<3>(particles, body, water, ramp, cell);
  });
  std::vector<Vec3>& nodes = body.conditions.loads.present;
  nodes.resize(body.grid.nodes.size());
  parallel_for(nodes.size(), threads, [&](std::size_t i) {
    Vec3 sum{0, 0, 0};
    for (std::uint32_t s = body.grid.around_begin[i]; s < body.grid.around_begin[i + 1]; ++s)
      sum = sum + body.water_slots[body.grid.around[s]];
    nodes[i] = free_part(sum, body.held[i]);
  });
}

void set_loads(std::vector<TotalBody>& bodies, const Model& model) {
  if (model.loads.empty()) return;
  const std::vector<ParticleForces> forces = find_particle_forces(model);
  std::vector<bool> found(model.loads.size(), has_formulation(model, Formulation::updated_lagrangian));
  for (TotalBody& body : bodies) {
    const std::vector<bool> here = set_loads(body, model, forces);
    for (std::size_t l = 0; l < found.size(); ++l) found[l] = found[l] || here[l];
  }
  for (std::size_t l = 0; l < found.size(); ++l)
    if ((model.loads[l].velocity || model.loads[l].displacement) && !found[l])
      throw Error("solve", "load '" + model.loads[l].name + "': its motion is imposed on no node", "",
                  "a region with nodes of a body, which are a cell apart");
}

void set_loads(TotalBody& body, const Model& model) {
  if (!model.loads.empty()) set_loads(body, model, find_particle_forces(model));
}

}  // namespace scarp

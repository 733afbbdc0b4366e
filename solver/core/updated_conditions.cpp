// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/updated_conditions.hpp"

#include <algorithm>

#include "solver/core/pore_water.hpp"
#include "solver/core/shaking.hpp"
#include "solver/core/updated_window.hpp"
#include "solver/core/wave_speeds.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// Where the nodes count as standing: functions beyond a wall belong to it.
std::vector<Vec3> places(const UpdatedGrid& grid, const Domain& domain) {
  std::vector<Vec3> positions = node_positions(grid);
  for (Vec3& x : positions)
    for (int a = 0; a < grid.dimension; ++a) x[a] = std::clamp(x[a], domain.min[a], domain.max[a]);
  return positions;
}

/// Whether some function of the grid, occupied or not, stands in the region.
template <int D, class S>
bool reaches(const LoadRegion& region, const Model& model, const UpdatedGrid& grid) {
  Vec3 x = model.domain.min;  // a region is a box: it is met on each axis by itself
  if (region.face) {
    const int side = static_cast<int>(*region.face);
    x[side / 2] = side % 2 == 0 ? model.domain.min[side / 2] : model.domain.max[side / 2];
  }
  LoadRegion part = region;
  part.body.reset();
  for (int a = 0; a < D; ++a) {
    if (region.face && static_cast<int>(*region.face) / 2 == a) continue;
    double nearest = x[a];
    if (region.box)
      for (int f = 0; f < grid.node_count[a]; ++f) {
        const double place = grid.origin[a] + grid.cell * S::place(f, grid.cell_count[a]);
        if (place >= region.box->min[a] - 1e-6 * grid.cell && place <= region.box->max[a] + 1e-6 * grid.cell)
          nearest = std::clamp(place, model.domain.min[a], model.domain.max[a]);
      }
    x[a] = nearest;
  }
  return (!part.box && !part.face) || node_in(part, model, x, -1);
}

void require_nodes(const Model& model, const UpdatedGrid& grid) {
  for (const LoadOptions& load : model.loads) {
    if (!(load.velocity || load.displacement) || load.where.body) continue;
    bool met = false;
    with_shape(grid, [&]<int D, class S>() { met = reaches<D, S>(load.where, model, grid); });
    if (!met)
      throw Error("solve", "load '" + load.name + "': its motion is imposed on no node", "",
                  "a region with nodes of the domain's grid, which are a cell apart");
  }
}

/// Mass of a full wall's node, in cells below the area that belongs to it.
double mass_depth(ShapeFunction shape) { return shape == ShapeFunction::quadratic_bspline ? 1.0 / 3 : 0.5; }

/// c_p and c_s at the nodes, weighted by phi_Ip m_p; of the windows of cells on an absorbing face only.
template <int D, class S>
void add_wave_speeds(const Model& model, const UpdatedGrid& grid, const std::vector<Vec2>& of_materials,
                     std::vector<Vec2>& speeds) {
  std::vector<double> mass(grid.nodes.size(), 0);
  for_each_updated_cell(grid, 1, [&](std::size_t b, std::size_t c) {
    bool beside = false;
    for (int a = 0; a < D; ++a)
      beside = beside || (grid.cells[c][a] == 0 && model.domain.faces[2 * a].condition == FaceCondition::absorbing) ||
               (grid.cells[c][a] == grid.cell_count[a] - 1 &&
                model.domain.faces[2 * a + 1].condition == FaceCondition::absorbing);
    if (!beside) return;
    for (std::size_t m = grid.cell_begin[c]; m < grid.cell_begin[c + 1]; ++m) {
      const std::uint32_t p = grid.members[m];
      const Vec2 speed = wave_speeds_of(model, of_materials, p);
      WindowWeights<D, S>(grid, c, m).each_value([&](int k, double phi) {
        const std::uint32_t node = window_node<D, S>(grid, b, c, k);
        const double weight = phi * model.particles.mass[p];
        mass[node] += weight;
        for (int i = 0; i < 2; ++i) speeds[node][i] += weight * speed[i];
      });
    }
  });
  for (std::size_t i = 0; i < speeds.size(); ++i)
    if (mass[i] > 0)
      for (double& c : speeds[i]) c /= mass[i];
}

}  // namespace

UpdatedConditions::UpdatedConditions(const Model& model, UpdatedGrid& grid, double damping, RigidBodies* rigid)
    : model_(model),
      damping_(damping),
      acting_faces_(std::any_of(model.domain.faces.begin(), model.domain.faces.end(),
                                [](const Face& face) {
                                  return face.condition == FaceCondition::friction ||
                                         face.condition == FaceCondition::absorbing;
                                })),
      loads_(find_particle_forces(model)),
      rigid_(rigid) {
  conditions_.damping = damping;
  if (has_absorbing_face(model.domain)) material_speeds_ = material_wave_speeds(model);
  if (!loads_.empty() || model.water) particle_force_.assign(model.particles.size(), Vec3{0, 0, 0});
  require_nodes(model, grid);
  follow(grid);
}

void UpdatedConditions::follow(UpdatedGrid& grid) {
  const bool others = followed_ != grid.placings;
  if (rigid_ && others) {
    places_ = places(grid, model_.domain);
    lattice_nodes_.clear();
    for (const auto& node : grid.nodes) lattice_nodes_.push_back(grid.lattice_node(node));
  }
  if (rigid_ && (others || rigid_->move())) conditions_.rigid.find(*rigid_, places_, grid.cell, lattice_nodes_);
  if (!others) return;
  followed_ = grid.placings;
  if (!model_.loads.empty()) {
    conditions_.loads.impose(model_, places(grid, model_.domain), -1, grid.held);
    grid.held_now = grid.held;
  }
  if (acting_faces_) find_faces(grid);
}

void UpdatedConditions::find_faces(const UpdatedGrid& grid) {
  std::vector<Vec2> speeds;
  if (!material_speeds_.empty()) {
    speeds.assign(grid.nodes.size(), Vec2{0, 0});
    with_shape(grid, [&]<int D, class S>() { add_wave_speeds<D, S>(model_, grid, material_speeds_, speeds); });
  }
  NodeFaces faces(model_.domain, grid.cell, node_positions(grid), grid.held, speeds, false, mass_depth(grid.shape));
  faces.take_over(conditions_.faces);
  faces.each_support([&](std::uint32_t node, int side, Vec3& support) {
    const auto found = supports_.find({field_of_node(grid, node), grid.lattice_node(grid.nodes[node]), side});
    if (found != supports_.end()) support = found->second;
  });
  conditions_.faces = std::move(faces);
}

void UpdatedConditions::find_particle_forces_at(double time) {
  for (const ParticleForces& load : loads_)
    for (std::uint32_t p : load.particles) particle_force_[p] = {0, 0, 0};
  for (const ParticleForces& load : loads_) {
    const double factor = factor_at(load.table, time);
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
      Vec3& force = particle_force_[load.particles[k]];
      force = force + factor * load.forces[k];
    }
  }
}

void UpdatedConditions::map_forces(UpdatedGrid& grid, double ramp, int threads) {
  const auto force_on = [&](std::uint32_t p) {
    const Vec3& load = particle_force_[p];
    return model_.water ? load + ramp * water_force(*model_.water, model_.particles, p, grid.dimension) : load;
  };
  std::vector<Vec3>& nodes = conditions_.loads.present;
  nodes.assign(grid.nodes.size(), Vec3{0, 0, 0});
  map_vectors(grid, threads, force_on, [&](std::uint32_t node, const Vec3& sum) { nodes[node] = nodes[node] + sum; });
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = free_part(nodes[i], grid.held[i]);
}

NodeWork UpdatedConditions::act(UpdatedGrid& grid, double time, double dt, const Vec3& missing_gravity, double ramp,
                                int threads) {
  send_waves(conditions_.faces, model_.shaking, time, dt);
  if (!particle_force_.empty()) {
    find_particle_forces_at(conditions_.loads.time_of_forces(time, dt));
    map_forces(grid, ramp, threads);
  }
  const NodeStep nodes{
      grid.nodes.size(), grid.mass.data(), grid.velocity.data(), grid.velocity_updated.data(), dt, time};
  return act_on_nodes(conditions_, nodes, grid.held_now, missing_gravity, threads);
}

void UpdatedConditions::begin_relaxing(double damping) {
  conditions_.damping = damping;
  conditions_.faces.hold_still(true);
  conditions_.loads.hold_still(true);
}

void UpdatedConditions::rest(UpdatedGrid& grid) {
  conditions_.damping = damping_;
  conditions_.faces.hold_still(false);
  conditions_.loads.hold_still(false);
  conditions_.faces.each_support([&](std::uint32_t node, int side, const Vec3& support) {
    supports_[{field_of_node(grid, node), grid.lattice_node(grid.nodes[node]), side}] = support;
  });
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/loads.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

bool in_box(const BoxShape& box, const Vec3& x, int dimension, double slack) {
  for (int a = 0; a < dimension; ++a)
    if (!(x[a] >= box.min[a] - slack && x[a] <= box.max[a] + slack)) return false;
  return true;
}

std::string title(const Model& model, std::size_t load) {
  const std::string& name = model.loads[load].name;
  return "load " + (name.empty() ? std::to_string(load) : "'" + name + "'");
}

void check_load(const Model& model, std::size_t index) {
  const LoadOptions& load = model.loads[index];
  if (load.velocity.has_value() + load.traction.has_value() + load.force.has_value() != 1)
    throw Error("solve", title(model, index), "", "one of velocity, traction and force");
  for (const auto& value : {load.velocity, load.traction, load.force})
    if (value && (!is_finite(*value) || (model.domain.dimension == 2 && (*value)[2] != 0)))
      throw Error("solve", title(model, index), "", "finite numbers, in plane strain in the plane");
  for (std::size_t r = 0; r < load.table.size(); ++r)
    if (!std::isfinite(load.table[r][0]) || !std::isfinite(load.table[r][1]) ||
        (r > 0 && !(load.table[r - 1][0] < load.table[r][0])))
      throw Error("solve", "table of " + title(model, index), shortest(load.table[r][0]) + " s", "rising times");
}

ParticleForces tractions(const Model& model, const LoadOptions& load) {
  ParticleForces result{load.table, {}, {}};
  const Particles& particles = model.particles;
  const double power = (model.domain.dimension - 1.0) / model.domain.dimension;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (!particles.surface[p] || !in_box(load.where.box, particles.reference_position[p], model.domain.dimension, 0))
      continue;
    result.particles.push_back(static_cast<std::uint32_t>(p));
    result.forces.push_back(std::pow(particles.reference_volume[p], power) * *load.traction);
  }
  return result;
}

ParticleForces shared_force(const Model& model, const LoadOptions& load) {
  ParticleForces result{load.table, {}, {}};
  const Particles& particles = model.particles;
  double mass = 0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (!in_box(load.where.box, particles.reference_position[p], model.domain.dimension, 0)) continue;
    result.particles.push_back(static_cast<std::uint32_t>(p));
    mass += particles.mass[p];
  }
  for (std::uint32_t p : result.particles) result.forces.push_back((particles.mass[p] / mass) * *load.force);
  return result;
}

}  // namespace

double factor_at(const std::vector<Vec2>& table, double time) {
  if (table.empty()) return 1;
  const auto next =
      std::upper_bound(table.begin(), table.end(), time, [](double t, const Vec2& row) { return t < row[0]; });
  if (next == table.begin()) return table.front()[1];
  if (next == table.end()) return table.back()[1];
  const Vec2 &a = *(next - 1), &b = *next;
  return a[1] + (time - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
}

std::vector<ParticleForces> find_particle_forces(const Model& model) {
  std::vector<ParticleForces> result;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    check_load(model, i);
    const LoadOptions& load = model.loads[i];
    if (load.velocity) continue;
    result.push_back(load.traction ? tractions(model, load) : shared_force(model, load));
    if (result.back().particles.empty())
      throw Error("solve", title(model, i), "",
                  load.traction ? "a region with particles of a surface" : "a region with particles");
  }
  return result;
}

std::vector<bool> NodeLoads::impose_velocities(const Model& model, const std::vector<Vec3>& positions,
                                               std::vector<std::uint8_t>& held) {
  std::vector<bool> found(model.loads.size(), false);
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const LoadOptions& load = model.loads[l];
    if (!load.velocity) continue;
    Velocity imposed{load.table, *load.velocity, 0, {}};
    for (int a = 0; a < model.domain.dimension; ++a)
      if (load.axes.find("xyz"[a]) != std::string::npos) imposed.axes |= static_cast<std::uint8_t>(1 << a);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (!in_box(load.where.box, positions[i], model.domain.dimension, 1e-6 * model.domain.cell)) continue;
      imposed.nodes.push_back(static_cast<std::uint32_t>(i));
      held[i] &= static_cast<std::uint8_t>(~imposed.axes);
    }
    found[l] = !imposed.nodes.empty();
    if (found[l]) velocities_.push_back(std::move(imposed));
  }
  return found;
}

void NodeLoads::add_forces(const std::vector<Vec2>& table, const std::vector<Vec3>& node_forces,
                           const std::vector<std::uint8_t>& held) {
  Forces forces{table, {}, {}};
  for (std::size_t i = 0; i < node_forces.size(); ++i) {
    Vec3 force = node_forces[i];
    for (int a = 0; a < 3; ++a)
      if (held[i] >> a & 1) force[a] = 0;
    if (force == Vec3{0, 0, 0}) continue;
    forces.nodes.push_back(static_cast<std::uint32_t>(i));
    forces.forces.push_back(force);
  }
  if (!forces.nodes.empty()) forces_.push_back(std::move(forces));
}

void NodeLoads::push(const NodeStep& step) const {
  for (const Forces& load : forces_) {
    const double impulse = step.dt * force_factor(load, step);
    for (std::size_t k = 0; k < load.nodes.size(); ++k) {
      const std::uint32_t i = load.nodes[k];
      if (step.mass[i] > 0) step.after[i] = step.after[i] + (impulse / step.mass[i]) * load.forces[k];
    }
  }
}

double NodeLoads::work_of_push(const NodeStep& step) const {
  double work = 0;
  for (const Forces& load : forces_) {
    const double impulse = step.dt * force_factor(load, step);
    for (std::size_t k = 0; k < load.nodes.size(); ++k) {
      const std::uint32_t i = load.nodes[k];
      if (step.mass[i] > 0) work += 0.5 * impulse * dot(load.forces[k], step.before[i] + step.after[i]);
    }
  }
  return work;
}

double NodeLoads::drive(const NodeStep& step) const {
  double work = 0;
  for (const Velocity& imposed : velocities_) {
    const Vec3 v = velocity_at(imposed, step.time + step.dt);
    for (std::uint32_t i : imposed.nodes) {
      const Vec3 trial = step.after[i];
      for (int a = 0; a < 3; ++a)
        if (imposed.axes >> a & 1) step.after[i][a] = v[a];
      work += work_on_node(step.mass[i], step.before[i], trial, step.after[i]);
    }
  }
  return work;
}

void NodeLoads::hold(std::vector<Vec3>& velocity, double time) const {
  for (const Velocity& imposed : velocities_) {
    const Vec3 v = velocity_at(imposed, time);
    for (std::uint32_t i : imposed.nodes)
      for (int a = 0; a < 3; ++a)
        if (imposed.axes >> a & 1) velocity[i][a] = v[a];
  }
}

}  // namespace scarp

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

/// On or beyond a face of the domain.
bool at_face(FaceName face, const Domain& domain, const Vec3& x, double slack) {
  const int side = static_cast<int>(face), axis = side / 2;
  return side % 2 == 0 ? x[axis] <= domain.min[axis] + slack : x[axis] >= domain.max[axis] - slack;
}

bool imposes(const LoadOptions& load) { return load.velocity || load.displacement; }

bool body_in(const LoadRegion& region, const Model& model, std::int32_t body) {
  return !region.body || (body >= 0 && model.bodies[body].name == *region.body);
}

std::string title(const Model& model, std::size_t load) {
  const std::string& name = model.loads[load].name;
  return "load " + (name.empty() ? std::to_string(load) : "'" + name + "'");
}

void check_region(const Model& model, std::size_t index) {
  const LoadRegion& region = model.loads[index].where;
  if (!region.box && !region.face && !region.body)
    throw Error("solve", "region of " + title(model, index), "", "at least one of box, face and body");
  if (region.face && static_cast<int>(*region.face) >= 2 * model.domain.dimension)
    throw Error("solve", "face of " + title(model, index), std::string(name_of(*region.face)),
                "one of the plane: x_min to y_max");
  if (!region.body) return;
  const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                 [&](const Body& candidate) { return candidate.name == *region.body; });
  if (body == model.bodies.end())
    throw Error("solve", "body of " + title(model, index), "'" + *region.body + "'", "the name of a body");
  if (body->formulation == Formulation::rigid)
    throw Error("solve", title(model, index) + " acts on a rigid body", "'" + *region.body + "'",
                "a body that deforms; bodies.rigid says how a rigid one moves");
  if (imposes(model.loads[index]) && body->formulation == Formulation::updated_lagrangian)
    throw Error("solve", title(model, index) + " imposes a motion on the nodes of a body", "'" + *region.body + "'",
                "a total-Lagrangian body; updated-Lagrangian ones share their nodes: give a box or a face");
}

void check_load(const Model& model, std::size_t index) {
  const LoadOptions& load = model.loads[index];
  if (load.velocity.has_value() + load.displacement.has_value() + load.traction.has_value() + load.force.has_value() !=
      1)
    throw Error("solve", title(model, index), "", "one of velocity, displacement, traction and force");
  for (const auto& value : {load.velocity, load.displacement, load.traction, load.force})
    if (value && (!is_finite(*value) || (model.domain.dimension == 2 && (*value)[2] != 0)))
      throw Error("solve", title(model, index), "", "finite numbers, in plane strain in the plane");
  check_table(load.table, title(model, index));
  if (load.displacement && factor_at(load.table, 0) != 0)
    throw Error("solve", "table of " + title(model, index) + ", a displacement, at time 0",
                shortest(factor_at(load.table, 0)), "0: it would jump there");
  check_region(model, index);
}

ParticleForces tractions(const Model& model, const LoadOptions& load) {
  ParticleForces result{load.table, {}, {}};
  const Particles& particles = model.particles;
  const double power = (model.domain.dimension - 1.0) / model.domain.dimension;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (!particles.surface[p] || !particle_in(load.where, model, p)) continue;
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
    if (!particle_in(load.where, model, p)) continue;
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

double integral_of_factor(const std::vector<Vec2>& table, double time) {
  // From the first row on, by trapezia; before it the factor is that of the row.
  const auto from_first_row = [&](double t) {
    double sum = 0, begin = table.front()[0];
    if (t <= begin) return (t - begin) * table.front()[1];
    for (const Vec2& row : table) {
      const double end = std::min(t, row[0]);
      sum += 0.5 * (factor_at(table, begin) + factor_at(table, end)) * (end - begin);
      begin = end;
    }
    return sum + table.back()[1] * (t - begin);
  };
  return table.empty() ? time : from_first_row(time) - from_first_row(0);
}

void check_table(const std::vector<Vec2>& table, const std::string& of) {
  for (std::size_t r = 0; r < table.size(); ++r)
    if (!std::isfinite(table[r][0]) || !std::isfinite(table[r][1]) || (r > 0 && !(table[r - 1][0] < table[r][0])))
      throw Error("solve", "table of " + of, shortest(table[r][0]) + " s", "rising times");
}

bool particle_in(const LoadRegion& region, const Model& model, std::size_t p) {
  const Vec3& X = model.particles.reference_position[p];
  const int D = model.domain.dimension;
  if (!body_in(region, model, model.particles.body[p])) return false;
  if (region.box && !in_box(*region.box, X, D, 0)) return false;
  const double edge = std::pow(model.particles.reference_volume[p], 1.0 / D);
  return !region.face || at_face(*region.face, model.domain, X, 0.75 * edge);
}

bool node_in(const LoadRegion& region, const Model& model, const Vec3& x, std::int32_t body) {
  const double slack = 1e-6 * model.domain.cell;
  return body_in(region, model, body) && (!region.box || in_box(*region.box, x, model.domain.dimension, slack)) &&
         (!region.face || at_face(*region.face, model.domain, x, slack));
}

std::vector<ParticleForces> find_particle_forces(const Model& model) {
  std::vector<ParticleForces> result;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    check_load(model, i);
    const LoadOptions& load = model.loads[i];
    if (imposes(load)) continue;
    result.push_back(load.traction ? tractions(model, load) : shared_force(model, load));
    if (result.back().particles.empty())
      throw Error("solve", title(model, i), "",
                  load.traction ? "a region with particles of a surface" : "a region with particles");
  }
  return result;
}

std::vector<bool> NodeLoads::impose(const Model& model, const std::vector<Vec3>& positions, std::int32_t body,
                                    std::vector<std::uint8_t>& held) {
  std::vector<bool> found(model.loads.size(), false);
  std::size_t next = 0;
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const LoadOptions& load = model.loads[l];
    if (!imposes(load)) continue;
    if (next == imposed_.size())
      imposed_.push_back(
          {load.table, load.velocity ? *load.velocity : *load.displacement, load.displacement.has_value(), 0, {}});
    Imposed& imposed = imposed_[next++];
    for (int a = 0; a < model.domain.dimension; ++a)
      if (load.axes.find("xyz"[a]) != std::string::npos) imposed.axes |= static_cast<std::uint8_t>(1 << a);
    imposed.nodes.clear();
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (!node_in(load.where, model, positions[i], body)) continue;
      imposed.nodes.push_back(static_cast<std::uint32_t>(i));
      held[i] &= static_cast<std::uint8_t>(~imposed.axes);
    }
    found[l] = !imposed.nodes.empty();
  }
  return found;
}

void NodeLoads::add_forces(const std::vector<Vec2>& table, const std::vector<Vec3>& node_forces,
                           const std::vector<std::uint8_t>& held) {
  Forces forces{table, {}, {}};
  for (std::size_t i = 0; i < node_forces.size(); ++i) {
    const Vec3 force = free_part(node_forces[i], held[i]);
    if (force == Vec3{0, 0, 0}) continue;
    forces.nodes.push_back(static_cast<std::uint32_t>(i));
    forces.forces.push_back(force);
  }
  if (!forces.nodes.empty()) forces_.push_back(std::move(forces));
}

void NodeLoads::hold_still(bool still) {
  still_ = still;
  begun_ = false;
}

void NodeLoads::begin(const NodeStep& step) {
  begun_ = true;
  for (Imposed& imposed : imposed_) {
    const auto factor = [&](double time) { return still_ ? 0 : factor_at(imposed.table, time); };
    const double end = step.time + step.dt;
    imposed.now = (imposed.displacement ? (factor(end) - factor(step.time)) / step.dt : factor(end)) * imposed.amount;
  }
}

/// f(node, force) of all forces on nodes with mass.
template <class F>
void NodeLoads::each_force(const NodeStep& step, F&& f) const {
  for (const Forces& load : forces_) {
    const double factor = factor_at(load.table, time_of_forces(step.time, step.dt));
    for (std::size_t k = 0; k < load.nodes.size(); ++k)
      if (step.mass[load.nodes[k]] > 0) f(load.nodes[k], factor * load.forces[k]);
  }
  for (std::size_t i = 0; i < present.size(); ++i)
    if (step.mass[i] > 0) f(i, present[i]);
}

void NodeLoads::push(const NodeStep& step) const {
  each_force(step, [&](std::size_t i, const Vec3& force) {
    step.after[i] = step.after[i] + (step.dt / step.mass[i]) * force;
  });
}

double NodeLoads::work_of_push(const NodeStep& step) const {
  double work = 0;
  each_force(step, [&](std::size_t i, const Vec3& force) {
    work += 0.5 * step.dt * dot(force, step.before[i] + step.after[i]);
  });
  return work;
}

double NodeLoads::drive(const NodeStep& step) const {
  double work = 0;
  for (const Imposed& imposed : imposed_)
    for (std::uint32_t i : imposed.nodes) {
      const Vec3 trial = step.after[i];
      set(step.after[i], imposed);
      work += work_on_node(step.mass[i], step.before[i], trial, step.after[i]);
    }
  return work;
}

void NodeLoads::add_imposed_axes(std::vector<std::uint8_t>& axes) const {
  for (const Imposed& imposed : imposed_)
    for (std::uint32_t i : imposed.nodes) axes[i] |= imposed.axes;
}

void NodeLoads::hold(std::vector<Vec3>& velocity) const {
  if (!begun_) return;
  for (const Imposed& imposed : imposed_)
    for (std::uint32_t i : imposed.nodes) set(velocity[i], imposed);
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/rigid_nodes.hpp"

#include <cmath>

namespace scarp {
namespace {

/// Nodes deeper in a body than this, in cells, are out of reach of anything that came to its surface.
constexpr double kDeepest = 3;

}  // namespace

void RigidNodes::find(RigidBodies& bodies, const std::vector<Vec3>& places, double cell,
                      const std::vector<std::size_t>& keys) {
  bodies_ = &bodies;
  nodes_.clear();
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    for (std::uint32_t r = 0; r < bodies.size(); ++r)
      if (keys.empty() || bodies[r].moves) find_at(i, r, places[i], cell, nodes_);
    if (keys.empty()) continue;
    if (keys[i] >= kept_at_.size()) kept_at_.resize(keys[i] + 1);
    Kept& kept = kept_at_[keys[i]];
    if (!kept.known) {
      kept = {static_cast<std::uint32_t>(kept_.size()), 0, true};
      for (std::uint32_t r = 0; r < bodies.size(); ++r)
        if (!bodies[r].moves) find_at(i, r, places[i], cell, kept_);
      kept.end = static_cast<std::uint32_t>(kept_.size());
    }
    for (std::uint32_t k = kept.begin; k < kept.end; ++k) {
      nodes_.push_back(kept_[k]);
      nodes_.back().node = i;
    }
  }
}

void RigidNodes::find_at(std::uint32_t i, std::uint32_t rigid, const Vec3& x, double cell,
                         std::vector<Node>& nodes) const {
  const RigidBody& body = (*bodies_)[rigid];
  const auto foot = body.foot(x, kDeepest * cell);
  if (!foot || foot->distance > 0.5 * cell) return;
  nodes.push_back({i, rigid, x, foot->normal, false, false, body.kind, {}, {}, false, false});
  if (foot->distance >= 0) return;
  const auto beyond = body.surface.at_sheet(body.material_point(body.now, x), -1.0 * foot->face);
  nodes.back().thin = beyond && beyond->distance > -cell;
}

std::size_t RigidNodes::grip(RigidBodies& bodies, std::size_t rigid, const std::vector<Vec3>& places, double cell) {
  bodies_ = &bodies;
  const std::size_t before = nodes_.size();
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const auto foot = bodies[rigid].foot(places[i], INFINITY);
    if (foot->distance > 1e-6 * cell) continue;
    nodes_.push_back(
        {i, static_cast<std::uint32_t>(rigid), places[i], foot->normal, true, false, {true, 0}, {}, {}, false, false});
  }
  return nodes_.size() - before;
}

void RigidNodes::begin(const NodeStep& step) {
  for (Node& node : nodes_) {
    const RigidBody& body = (*bodies_)[node.rigid];
    node.pressed = node.stuck = false;
    if (node.gripped) {  // it is where the body has it: its velocity is the mean of the step
      node.before = step.before[node.node];
      node.after = (1 / step.dt) * (body.place(body.now, node.x) - body.place(body.before, node.x));
    } else {
      node.before = body.before.velocity_at(node.x);
      node.after = body.now.velocity_at(node.x);
    }
  }
}

/// Coulomb's friction with a body of infinite mass.
void RigidNodes::rub(Node& node, Vec3& velocity) {
  const Vec3 relative = velocity - node.after;
  if (node.thin && dot(relative, node.n) > 0) node.n = -1.0 * node.n;
  const double closing = -dot(relative, node.n);
  if (!(closing > 0)) return;
  const Vec3 slide = relative + closing * node.n;
  const double speed = norm(slide), most = node.surface.friction * closing;
  node.pressed = true;
  node.stuck = speed <= most;
  velocity = node.stuck ? node.after : node.after + (1 - most / speed) * slide;
}

NodeWork RigidNodes::act(const NodeStep& step) {
  NodeWork work;
  for (Node& node : nodes_) {
    if (!(step.mass[node.node] > 0)) continue;
    Vec3& velocity = step.after[node.node];
    const Vec3 trial = velocity;
    if (node.surface.rough) {
      velocity = node.after;
      node.pressed = node.stuck = true;
    } else {
      rub(node, velocity);
    }
    const double mass = step.mass[node.node];
    const Vec3 impulse = mass * (velocity - trial);
    const double given = 0.5 * dot(impulse, node.before + node.after);
    work.external += given;
    work.friction += given - work_on_node(mass, step.before[node.node], trial, velocity);
    Vec3& on_body = (*bodies_)[node.rigid].impulse;
    on_body = on_body - impulse;
  }
  return work;
}

void RigidNodes::hold(std::vector<Vec3>& velocity) const {
  for (const Node& node : nodes_) {
    Vec3& v = velocity[node.node];
    if (node.stuck)
      v = node.after;
    else if (node.pressed)
      v = v + dot(node.after - v, node.n) * node.n;
  }
}

void RigidNodes::add_axes(std::vector<std::uint8_t>& axes) const {
  for (const Node& node : nodes_)
    if (node.stuck) axes[node.node] |= 7;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/node_faces.hpp"

#include <cmath>
#include <string>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr std::uint8_t kAllAxes = 7;

void check_friction(const Domain& domain) {
  for (const Face& face : domain.faces)
    if (face.condition == FaceCondition::friction && !(face.friction >= 0 && std::isfinite(face.friction)))
      throw Error("solve", "friction of a face of the domain", shortest(face.friction), "0 or above");
}

}  // namespace

NodeFaces::NodeFaces(const Domain& domain, double cell, const std::vector<Vec3>& positions,
                     const std::vector<std::uint8_t>& held, const std::vector<Vec2>& wave_speeds, bool carried,
                     double mass_depth)
    : carried_(carried) {
  check_friction(domain);
  const double slack = 1e-6 * cell;
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (int side = 0; side < 2 * domain.dimension; ++side) {
      const Face& condition = domain.faces[side];
      const int axis = side / 2;
      const bool lower = side % 2 == 0;
      const bool absorbing = condition.condition == FaceCondition::absorbing;
      if (!absorbing && condition.condition != FaceCondition::friction) continue;
      if (lower ? positions[i][axis] > domain.min[axis] + slack : positions[i][axis] < domain.max[axis] - slack)
        continue;
      FaceNode face;
      face.node = static_cast<std::uint32_t>(i);
      face.axis = static_cast<std::uint8_t>(axis);
      face.held = held[i];
      face.inward = lower ? 1 : -1;
      face.absorbing = absorbing;
      face.friction = condition.friction;
      if (absorbing)
        for (int a = 0; a < 3; ++a) face.rate[a] = wave_speeds[i][a == axis ? 0 : 1] / (mass_depth * cell);
      nodes_.push_back(face);
    }
}

NodeWork NodeFaces::act(const NodeStep& step, std::vector<std::uint8_t>& held_now) {
  NodeWork work;
  for (const FaceNode& face : nodes_) held_now[face.node] = face.held;
  for (FaceNode& face : nodes_) {
    if (!(step.mass[face.node] > 0)) continue;
    if (face.absorbing)
      absorb(face, step, held_now[face.node], work);
    else
      work.friction += rub(face, step, held_now[face.node]);
  }
  return work;
}

/// The energy lost.
double NodeFaces::rub(FaceNode& face, const NodeStep& step, std::uint8_t& held_now) const {
  Vec3& v = step.after[face.node];
  const Vec3 trial = v;
  const double closing = -face.gap / step.dt;  // the normal velocity that just closes the gap
  const double normal = face.inward * v[face.axis];
  if (normal < closing) {
    v[face.axis] = face.inward * closing;
    Vec3 along = v;
    along[face.axis] = 0;
    const double speed = norm(along), most = face.friction * (closing - normal);
    const bool sticks = face.friction > 0 && most >= speed;
    const double kept = sticks ? 0 : most > 0 ? 1 - most / speed : 1;
    for (int a = 0; a < 3; ++a)
      if (a != face.axis) v[a] *= kept;
    if (face.gap == 0) held_now |= sticks ? kAllAxes : static_cast<std::uint8_t>(1 << face.axis);
  }
  if (carried_) face.gap = std::max(0.0, face.gap + step.dt * face.inward * v[face.axis]);
  return -work_on_node(step.mass[face.node], step.before[face.node], trial, v);
}

void NodeFaces::absorb(FaceNode& face, const NodeStep& step, std::uint8_t& held_now, NodeWork& work) const {
  Vec3& v = step.after[face.node];
  const Vec3& before = step.before[face.node];
  const double mass = step.mass[face.node];
  if (still_) {
    face.support = (-mass / step.dt) * v;
    v = {0, 0, 0};
    held_now = kAllAxes;
    return;
  }
  const Vec3& wave = incoming_[face.side()];
  for (int a = 0; a < 3; ++a) {
    if (face.held >> a & 1) continue;
    const double r = step.dt * face.rate[a], push = 2 * r * wave[a];
    v[a] = (v[a] + push) / (1 + r);
    const double carried = 0.5 * mass * (before[a] + v[a]);
    work.damping += r * v[a] * carried;
    work.external += push * carried;
  }
}

void NodeFaces::push(const NodeStep& step) const {
  if (still_) return;
  for (const FaceNode& face : nodes_)
    if (step.mass[face.node] > 0)
      step.after[face.node] = step.after[face.node] + (step.dt / step.mass[face.node]) * face.support;
}

double NodeFaces::work_of_push(const NodeStep& step) const {
  double work = 0;
  for (const FaceNode& face : nodes_)
    if (!still_ && step.mass[face.node] > 0)
      work += 0.5 * step.dt * dot(face.support, step.before[face.node] + step.after[face.node]);
  return work;
}

}  // namespace scarp

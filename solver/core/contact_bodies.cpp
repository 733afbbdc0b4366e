// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact before the first step: who can meet whom.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/core/contact.hpp"
#include "solver/core/contact_laws.hpp"
#include "solver/core/contact_touch.hpp"
#include "solver/core/wave_speeds.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// How far things move before the geometry of contact is found anew, in spacings.
constexpr double kSteady = 0.02;

}  // namespace

Contact::Contact(const Model& model, TotalLagrangian* total, UpdatedLagrangian* updated, RigidBodies* rigid)
    : model_(model),
      total_(total),
      updated_(updated),
      dimension_(model.domain.dimension),
      rigid_(rigid),
      net_(model.bodies.size(), Vec3{0, 0, 0}),
      impulse_(model.bodies.size(), Vec3{0, 0, 0}) {
  for (const ContactLaw& law : contact_laws_of_materials(model)) material_friction_.push_back(law.friction);
  std::size_t next = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].formulation == Formulation::total_lagrangian)
      add_total_body(static_cast<std::int32_t>(b), next++);
    else if (model.bodies[b].formulation == Formulation::updated_lagrangian)
      add_updated_body(static_cast<std::int32_t>(b));
  for (std::size_t r = 0; rigid_ && r < rigid_->size(); ++r) add_rigid_points(r);
  for (ContactBody& body : bodies_) {
    size_buffers(body);
    if (body.rigid < 0) margin_ = std::max(margin_, 0.5 * body.spacing);
    steady_ = steady_ > 0 ? std::min(steady_, kSteady * body.spacing) : kSteady * body.spacing;
  }
  // A ball is large beside the points of others, and counts where there is nothing else.
  if (!(margin_ > 0) && !bodies_.empty()) margin_ = 0.5 * bodies_.front().spacing;
  add_links();
  add_faces();
  add_walls();
  make_lists();
  fit_balls();
  find_geometry();
  for (ContactLink& link : links_) find_forces(link, true);
  for (ContactFace& face : faces_) find_forces(face);
  for (ContactWall& wall : walls_) find_forces(wall);
  refuse_overlap();
}

void Contact::add_total_body(std::int32_t index, std::size_t of_total) {
  ContactBody body;
  body.body = index;
  body.total = true;
  body.surface = find_contact_surface(model_, model_.bodies[index], total_->body(of_total));
  if (body.surface.size() == 0)
    throw Error("solve", "surface of body '" + model_.bodies[index].name + "'", "none found",
                "at least two particles across every part, so that contact knows where the body ends");
  body.spacing = body.surface.spacing;
  body.area = body.surface.area;
  body.mobility = body.surface.mobility;
  body.radius.assign(body.size(), 0);
  total_->prepare_contact(of_total, body.surface);
  bodies_.push_back(std::move(body));
  total_index_.push_back(of_total);
}

void Contact::add_updated_body(std::int32_t index) {
  const Body& from = model_.bodies[index];
  ContactBody body;
  body.body = index;
  body.begin = from.begin;
  const std::size_t count = from.end - from.begin;
  for (std::size_t p = from.begin; p < from.end; ++p) body.mobility.push_back(1 / model_.particles.mass[p]);
  body.spacing = mean_spacing(model_, from);
  body.area.assign(count, 0);
  body.radius.assign(count, 0);
  body.fit.assign(count, 1);
  bodies_.push_back(std::move(body));
  total_index_.push_back(0);
}

void Contact::size_buffers(ContactBody& body) {
  const std::size_t count = body.size();
  for (auto* field : {&body.y, &body.n, &body.moved, &body.seen, &body.force}) field->assign(count, Vec3{0, 0, 0});
  body.stiffness.assign(count, 0);
  body.seen_at.assign(count, -1);
  body.is_active.assign(count, 0);
  body.is_live.assign(count, 0);
  body.active.reserve(count);
  body.live.reserve(count);
  const std::vector<Vec2> speeds = material_wave_speeds(model_);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t p = body.total ? body.surface.particle[i] : body.rigid >= 0 ? body.begin : body.begin + i;
    const double c_p = wave_speeds_of(model_, speeds, p)[0];
    body.modulus.push_back(model_.particles.mass[p] / model_.particles.reference_volume[p] * c_p * c_p);
    body.material.push_back(model_.particles.material[p]);
  }
  if (everything_.size() < count) {
    everything_.resize(count);
    std::iota(everything_.begin(), everything_.end(), 0u);
  }
}

void Contact::add_links() {
  for (std::size_t a = 0; a < bodies_.size(); ++a)
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!bodies_[b].total || bodies_[a].rigid >= 0 || (a == b && !model_.contact.self_contact)) continue;
      ContactLink link;
      link.slave = a;
      link.master = b;
      link.share = bodies_[a].total ? 0.5 : 1;
      if (const auto law = contact_law_of_bodies(model_, bodies_[a].body, bodies_[b].body))
        link.friction = law->friction;
      link.slid.assign(bodies_[a].size(), Vec3{0, 0, 0});
      link.stretch.assign(bodies_[a].size(), Vec3{0, 0, 0});
      link.touching.assign(bodies_[a].size(), 0);
      links_.push_back(std::move(link));
    }
}

void Contact::add_faces() {
  const Domain& domain = model_.domain;
  const double slack = 1e-6 * domain.cell;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (int side = 0; bodies_[b].total && side < 2 * dimension_; ++side) {
      if (domain.faces[side].condition != FaceCondition::friction) continue;
      ContactFace face;
      face.body = b;
      face.axis = side / 2;
      face.inward = side % 2 == 0 ? 1 : -1;
      face.place = side % 2 == 0 ? domain.min[face.axis] : domain.max[face.axis];
      face.friction = domain.faces[side].friction;
      const std::vector<Vec3>& nodes = total_->body(total_index_[b]).node_positions;
      if (std::any_of(nodes.begin(), nodes.end(),
                      [&](const Vec3& x) { return face.inward * (x[face.axis] - face.place) <= slack; }))
        continue;
      face.stiffness.assign(bodies_[b].size(), 0);
      face.stretch.assign(bodies_[b].size(), Vec3{0, 0, 0});
      face.touching.assign(bodies_[b].size(), 0);
      faces_.push_back(std::move(face));
    }
}

/// Particles stand on a lattice, whatever is beside them: balls that a surface cuts at the start are as small as it
/// leaves them, for good, or they would be thrown off it.
void Contact::fit_balls() {
  for (const ContactWall& wall : walls_) {
    ContactBody& body = bodies_[wall.body];
    if (body.fit.empty()) continue;
    for (std::uint32_t i : wall.candidates)
      if (const auto foot = (*rigid_)[wall.rigid].foot(body.y[i], body.radius[i]))
        fit_ball(body, i, body.radius[i] - foot->distance);
  }
  for (const ContactLink& link : links_) {
    ContactBody& body = bodies_[link.slave];
    if (body.fit.empty()) continue;
    for (const ContactLink::Candidate& candidate : link.candidates) {
      Touch touch;
      if (!look(link, candidate, touch)) continue;
      stand_above(link, candidate, touch);
      fit_ball(body, candidate.point, touch.depth);
    }
  }
}

/// @param depth  at most as deep as its middle: one that is beyond the surface is not shrunk to fit
void Contact::fit_ball(ContactBody& body, std::uint32_t i, double depth) {
  if (!(depth > 0 && depth <= body.radius[i])) return;
  body.fit[i] *= 1 - depth / body.radius[i];
  body.radius[i] -= depth;
}

/// Springs as deep as this would throw the bodies apart.
void Contact::refuse_overlap() const {
  for (const ContactWall& wall : walls_) refuse_overlap(wall);
  for (const ContactLink& link : links_) {
    const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
    for (std::uint32_t i : a.live) {
      const double depth = a.stiffness[i] > 0 ? norm(a.force[i]) / a.stiffness[i] : 0;
      const double most = 0.5 * std::min(a.spacing, b.spacing);
      if (link.touching[i] && depth > most)
        throw Error("solve",
                    "depth by which bodies '" + model_.bodies[a.body].name + "' and '" + model_.bodies[b.body].name +
                        "' overlap at the start",
                    shortest(depth) + " m", "at most half the spacing of their particles, " + shortest(most) + " m");
    }
  }
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/contact.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/contact_touch.hpp"
#include "solver/materials/tensor.hpp"

namespace scarp {
namespace {

/// Share of their stable step that springs can do with: they are a means, whose waves nobody follows. Not where
/// updated-Lagrangian bodies meet them, as what is lost then grows with the step.
constexpr double kLeastCourant = 0.25;

}  // namespace

void Contact::update() {
  if (rigid_) rigid_->begin_contact();
  for (ContactBody& body : bodies_) follow(body);
  find_fastest();
  const auto shift = [&](auto anchor, const std::vector<RigidState>& of_rigid) {
    return std::max(farthest_shift(anchor), shift_of_rigid(of_rigid));
  };
  const bool steady = shift(&ContactBody::geometry_anchor, rigid_geometry_anchor_) < steady_;
  if (!steady) {
    for (ContactLink& link : links_) find_slides(link);
    // They hold until the geometry is found the next time.
    const bool lists_hold = shift(&ContactBody::list_anchor, rigid_list_anchor_) < allowed_ - steady_;
    if (!lists_hold) make_lists();
    find_geometry();
  }
  for (ContactBody& body : bodies_)
    for (std::uint32_t i : body.live) body.force[i] = {0, 0, 0};
  stored_ = 0;
  std::fill(net_.begin(), net_.end(), Vec3{0, 0, 0});
  for (ContactLink& link : links_) find_forces(link, !steady);
  for (ContactFace& face : faces_) find_forces(face);
  for (ContactWall& wall : walls_) find_forces(wall);
  if (rigid_) rigid_->count_work();
}

double Contact::farthest_shift(std::vector<Vec3> ContactBody::*anchor) const {
  double shift = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const ContactBody& body = bodies_[b];
    if (body.rigid >= 0) continue;
    if (body.total) {
      shift = std::max(shift, total_->contact_shift(total_index_[b], body.surface, body.*anchor));
      continue;
    }
    for (std::size_t i = 0; i < body.size(); ++i)
      shift = std::max(shift, norm(model_.particles.position[body.begin + i] - (body.*anchor)[i]));
  }
  return shift;
}

void Contact::set_anchor(ContactBody& body, std::vector<Vec3>& anchor) const {
  if (body.total)
    return total_->anchor_contact(total_index_[static_cast<std::size_t>(&body - bodies_.data())], body.surface, anchor);
  if (body.rigid >= 0) return;
  const auto first = model_.particles.position.begin() + static_cast<std::ptrdiff_t>(body.begin);
  anchor.assign(first, first + static_cast<std::ptrdiff_t>(body.size()));
}

/// @param normals  and sizes of balls
void Contact::locate(ContactBody& body, const std::vector<std::uint32_t>& points, std::size_t count, bool normals) {
  if (body.total)
    return total_->locate_contact(total_index_[static_cast<std::size_t>(&body - bodies_.data())], body.surface,
                                  points.data(), count, body.y, normals ? &body.n : nullptr);
  if (body.rigid >= 0) return locate_rigid(body, points, count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = points[k], p = body.begin + i;
    body.y[i] = model_.particles.position[p];
    if (!normals) continue;
    // What has been torn apart is no larger for that.
    const double J = std::min(1.0, determinant(model_.particles.deformation_gradient[p]));
    const double edge = std::pow(J * model_.particles.reference_volume[p], 1.0 / dimension_);
    body.radius[i] = 0.5 * body.fit[i] * edge;
    body.area[i] = dimension_ == 2 ? edge : edge * edge;
  }
}

void Contact::follow(ContactBody& body) {
  for (std::uint32_t i : body.live) body.moved[i] = body.y[i];
  locate(body, body.live, body.live.size(), false);
  for (std::uint32_t i : body.live) body.moved[i] = body.y[i] - body.moved[i];
}

void Contact::make_lists() {
  for (ContactBody& body : bodies_) {
    locate(body, everything_, body.size(), true);
    body.box = {};
    for (const Vec3& y : body.y) body.box.extend(y);
    std::fill(body.is_active.begin(), body.is_active.end(), std::uint8_t{0});
    set_anchor(body, body.list_anchor);
  }
  // Far bodies may come nearer by all that is between them; near ones by the margin.
  allowed_ = INFINITY;
  for (ContactLink& link : links_) {
    const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
    const double apart = distance(a.box, b.box, dimension_) - reach(a, b);
    allowed_ = std::min(allowed_, 0.45 * std::max(margin_, apart));
  }
  for (ContactBody& body : bodies_)
    if (body.total) body.cells.build(body.y, 5 * margin_, dimension_);
  for (ContactLink& link : links_) list_candidates(link);
  for (ContactFace& face : faces_) list_candidates(face);
  set_anchor(rigid_list_anchor_);
  for (ContactWall& wall : walls_) list_candidates(wall);
  for (ContactBody& body : bodies_) {
    body.active.clear();
    for (std::uint32_t i = 0; i < body.size(); ++i)
      if (body.is_active[i]) body.active.push_back(i);
  }
}

/// Of the listed points as they stand. Springs that a point will meet in a step at most count for that step already:
/// who enters them in a long one is thrown back by more than what he came with.
void Contact::find_geometry() {
  for (ContactBody& body : bodies_) {
    locate(body, body.active, body.active.size(), true);
    set_anchor(body, body.geometry_anchor);
    body.pressed = false;
    for (std::uint32_t i : body.active) {
      body.stiffness[i] = 0;
      if (!body.is_live[i]) body.moved[i] = {0, 0, 0};
    }
    for (std::uint32_t i : body.live) body.is_live[i] = 0;
    body.live.clear();
  }
  for (ContactLink& link : links_) find_geometry(link);
  for (ContactFace& face : faces_) find_geometry(face);
  set_anchor(rigid_geometry_anchor_);
  for (ContactWall& wall : walls_) find_geometry(wall);
  for (ContactBody& body : bodies_)
    for (std::uint32_t i : body.active) {
      body.seen[i] = body.y[i];
      body.seen_at[i] = time_;
      if (body.is_live[i]) body.live.push_back(i);
    }
}

/// How far a point goes in a step at most, as it has moved since it was seen last.
Vec3 Contact::motion(const ContactBody& body, std::uint32_t i) const {
  const double time = time_ - body.seen_at[i];
  return body.seen_at[i] >= 0 && time > 0 ? (longest_step_ / time) * (body.y[i] - body.seen[i]) : Vec3{0, 0, 0};
}

/// The tangential spring after the surfaces have slid over each other by `slid`: what it pulls back with.
/// What has come to touch in this step counts from where it did: of a way straight through the surface the part below.
/// @param friction  Coulomb's, which with the depth, m, limits the stretch
Vec3 Contact::rub(Vec3& stretch, bool touched, const Vec3& slid, const Vec3& n, double stiffness, double friction,
                  double depth) {
  const auto tangential = [&](const Vec3& a) { return a - dot(a, n) * n; };
  const double sunk = -dot(slid, n), share = touched ? 1 : sunk > 0 ? std::min(1.0, depth / sunk) : 0;
  const double most = friction * depth;
  const Vec3 before = tangential(stretch), trial = before + share * tangential(slid);
  const double length = norm(trial);
  stretch = length > most ? (most / length) * trial : trial;
  // Work on the spring less what it stores.
  friction_ += 0.5 * stiffness * dot(before + stretch, trial - stretch);
  stored_ += 0.5 * stiffness * dot(stretch, stretch);
  return stiffness * stretch;
}

void Contact::push(double dt) {
  elapsed_ += dt;
  time_ += dt;
  last_step_ = dt;
  longest_step_ = std::max(longest_step_, dt);
  for (std::size_t b = 0; b < net_.size(); ++b) impulse_[b] = impulse_[b] + dt * net_[b];
  pushed_.clear();
  pushes_.clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const ContactBody& body = bodies_[b];
    if (!body.pressed || body.rigid >= 0) continue;
    if (body.total) {
      total_->push_contact(total_index_[b], body.surface, body.live.data(), body.live.size(), body.force);
      continue;
    }
    for (std::uint32_t i : body.live) {
      if (body.stiffness[i] == 0) continue;
      pushed_.push_back(static_cast<std::uint32_t>(body.begin + i));
      pushes_.push_back(body.force[i]);
    }
  }
  if (updated_) updated_->push_contact(pushed_, pushes_);
}

double Contact::stable_time_step(double courant) const {
  // The springs of a pair see the mobilities of both sides; no pair has more than the two largest.
  double most = 0, second = 0;
  const auto take = [&](double square) {
    second = std::max(second, std::min(most, square));
    most = std::max(most, square);
  };
  for (const ContactBody& body : bodies_) {
    if (!body.pressed || body.rigid >= 0) continue;
    double stiffness = 0, mobility = 0;
    for (std::uint32_t i : body.live) {
      if (body.stiffness[i] == 0) continue;
      stiffness = std::max(stiffness, body.stiffness[i]);
      mobility = std::max(mobility, body.mobility[i]);
    }
    take(stiffness * mobility);
  }
  for (std::size_t r = 0; rigid_ && r < rigid_->size(); ++r) take((*rigid_)[r].stiffness_per_mass);
  if (model_.contact.self_contact) second = most;
  const double of_springs = updated_ || !walls_.empty() ? courant : std::max(courant, kLeastCourant);
  const double stable = most > 0 ? of_springs * 2 / std::sqrt(most + second) : INFINITY;
  return std::min({stable, courant * rigid_step_, time_to_go()});
}

std::vector<Vec3> Contact::take_mean_force() {
  std::vector<Vec3> mean = elapsed_ > 0 ? impulse_ : net_;
  if (elapsed_ > 0)
    for (Vec3& force : mean) force = (1 / elapsed_) * force;
  std::fill(impulse_.begin(), impulse_.end(), Vec3{0, 0, 0});
  elapsed_ = 0;
  return mean;
}

}  // namespace scarp

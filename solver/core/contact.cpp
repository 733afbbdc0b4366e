// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/core/contact_touch.hpp"
#include "solver/core/wave_speeds.hpp"
#include "solver/materials/tensor.hpp"

namespace scarp {
namespace {

/// Share of their stable step that springs can do with: they are a means, whose waves nobody follows. Not where
/// updated-Lagrangian bodies meet them, as what is lost then grows with the step.
constexpr double kLeastCourant = 0.25;

/// S += wd (x) d.
void add_square(Sym6& S, const Vec3& wd, const Vec3& d) {
  S[0] += wd[0] * d[0], S[1] += wd[1] * d[1], S[2] += wd[2] * d[2];
  S[3] += wd[0] * d[1], S[4] += wd[1] * d[2], S[5] += wd[0] * d[2];
}

Vec3 times(const Sym6& S, const Vec3& a) {
  return {S[0] * a[0] + S[3] * a[1] + S[5] * a[2], S[3] * a[0] + S[1] * a[1] + S[4] * a[2],
          S[5] * a[0] + S[4] * a[1] + S[2] * a[2]};
}

}  // namespace

void Contact::update() {
  if (rigid_) rigid_->begin_contact();
  for (ContactBody& body : bodies_) follow(body);
  find_fastest();
  const auto shift = [&](auto anchor, const std::vector<RigidState>& of_rigid) {
    return std::max(farthest_shift(anchor), shift_of_rigid(of_rigid));
  };
  const bool lists_hold = shift(&ContactBody::list_anchor, rigid_list_anchor_) < allowed_;
  const bool steady = lists_hold && shift(&ContactBody::geometry_anchor, rigid_geometry_anchor_) < steady_;
  if (!steady) {
    for (ContactLink& link : links_) find_slides(link);
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
    const double J = determinant(model_.particles.deformation_gradient[p]);
    const double edge = std::pow(J * model_.particles.reference_volume[p], 1.0 / dimension_);
    body.radius[i] = 0.5 * edge;
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

void Contact::list_candidates(ContactLink& link) {
  ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  link.candidates.clear();
  link.masters.clear();
  const double far = reach(a, b) + margin_;
  // What is near in the material is near anyway; and through a sheet the other side faces away, too.
  const double joined = link.slave == link.master ? 2 * reach(a, b) : 0;
  if (distance(a.box, b.box, dimension_) > far) return;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    if (!within(b.box, a.y[i], far, dimension_)) continue;
    const auto begin = static_cast<std::uint32_t>(link.masters.size());
    b.cells.each_near(a.y[i], [&](std::uint32_t q) {
      if (dot(a.y[i] - b.y[q], a.y[i] - b.y[q]) > far * far) return;
      if (joined > 0 && norm(a.surface.Y[i] - b.surface.Y[q]) < joined) return;
      link.masters.push_back(q);
      b.is_active[q] = 1;
    });
    if (link.masters.size() == begin) continue;
    a.is_active[i] = 1;
    link.candidates.push_back({.point = i, .begin = begin, .end = static_cast<std::uint32_t>(link.masters.size())});
  }
  link.share_of_master.assign(link.masters.size(), 0);
}

void Contact::list_candidates(ContactFace& face) {
  ContactBody& body = bodies_[face.body];
  const double lowest = face.inward > 0 ? body.box.min[face.axis] : body.box.max[face.axis];
  allowed_ = std::min(allowed_, 0.9 * std::max(margin_, face.inward * (lowest - face.place)));
  face.candidates.clear();
  for (std::uint32_t i = 0; i < body.size(); ++i) {
    if (face.inward * (body.y[i][face.axis] - face.place) > margin_) continue;
    face.candidates.push_back(i);
    body.is_active[i] = 1;
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

void Contact::find_geometry(ContactLink& link) {
  for (ContactLink::Candidate& candidate : link.candidates) {
    Touch touch;
    candidate.live = look(link, candidate, touch);
    if (candidate.live) {
      stand_above(link, candidate, touch);
      // Depth and what it may grow by until the geometry is found again: both bodies may move.
      const Vec3 motion_over =
          motion(bodies_[link.slave], candidate.point) - motion(bodies_[link.master], touch.nearest);
      candidate.live = touch.depth + 2 * steady_ + std::max(0.0, -dot(motion_over, touch.n)) > 0;
    }
    if (candidate.live) {
      make_live(link, candidate, touch);
      continue;
    }
    // What the tangential spring held when the surfaces parted went on the way down to no pressure.
    link.touching[candidate.point] = 0;
    link.stretch[candidate.point] = link.slid[candidate.point] = {0, 0, 0};
  }
}

/// How far a point goes in a step at most, as it has moved since it was seen last.
Vec3 Contact::motion(const ContactBody& body, std::uint32_t i) const {
  const double time = time_ - body.seen_at[i];
  return body.seen_at[i] >= 0 && time > 0 ? (longest_step_ / time) * (body.y[i] - body.seen[i]) : Vec3{0, 0, 0};
}

void Contact::make_live(ContactLink& link, ContactLink::Candidate& candidate, const Touch& touch) {
  ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  candidate.n = touch.n;
  candidate.stiffness = touch.stiffness;
  candidate.friction = friction_of(link, candidate.point, touch.nearest);
  a.is_live[candidate.point] = 1;
  a.stiffness[candidate.point] += touch.stiffness;
  a.pressed = b.pressed = true;
  for (std::uint32_t k = candidate.begin; k < candidate.end; ++k) {
    const double share = weights_[k - candidate.begin] / touch.weight;
    link.share_of_master[k] = share;
    if (share == 0) continue;
    b.is_live[link.masters[k]] = 1;
    b.stiffness[link.masters[k]] += share * touch.stiffness;
  }
}

/// Before the geometry changes.
void Contact::find_slides(ContactLink& link) {
  const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  for (const ContactLink::Candidate& candidate : link.candidates) {
    if (!candidate.live) continue;
    Vec3 slid = a.moved[candidate.point];
    for (std::uint32_t k = candidate.begin; k < candidate.end; ++k)
      if (link.share_of_master[k] != 0) slid = slid - link.share_of_master[k] * b.moved[link.masters[k]];
    link.slid[candidate.point] = slid;
  }
}

void Contact::find_forces(ContactLink& link, bool slides_known) {
  ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  if (!slides_known) find_slides(link);
  for (const ContactLink::Candidate& candidate : link.candidates) {
    if (!candidate.live) continue;
    const std::uint32_t i = candidate.point;
    Vec3 above = a.y[i];
    for (std::uint32_t k = candidate.begin; k < candidate.end; ++k)
      if (link.share_of_master[k] != 0) above = above - link.share_of_master[k] * b.y[link.masters[k]];
    const double depth = a.radius[i] - dot(above, candidate.n), stiffness = candidate.stiffness;
    if (!(depth > 0)) {
      link.touching[i] = 0;
      link.stretch[i] = {0, 0, 0};
      continue;
    }
    stored_ += 0.5 * stiffness * depth * depth;
    Vec3 force = stiffness * depth * candidate.n;
    if (candidate.friction > 0)
      force = force -
              rub(link.stretch[i], link.touching[i], link.slid[i], candidate.n, stiffness, candidate.friction * depth);
    link.touching[i] = 1;
    a.force[i] = a.force[i] + force;
    for (std::uint32_t k = candidate.begin; k < candidate.end; ++k)
      if (link.share_of_master[k] != 0) {
        const std::uint32_t q = link.masters[k];
        b.force[q] = b.force[q] - link.share_of_master[k] * force;
      }
    net_[a.body] = net_[a.body] + force;
    net_[b.body] = net_[b.body] - force;
  }
}

void Contact::find_geometry(ContactFace& face) {
  ContactBody& body = bodies_[face.body];
  for (std::uint32_t i : face.candidates) {
    const double depth = face.inward * (face.place - body.y[i][face.axis]);
    const double closing = -face.inward * motion(body, i)[face.axis];
    if (face.inward * body.n[i][face.axis] > kFacing || !(depth + steady_ + std::max(0.0, closing) > 0)) {
      face.stiffness[i] = 0;
      face.touching[i] = 0;
      face.stretch[i] = {0, 0, 0};
      continue;
    }
    face.stiffness[i] = model_.contact.stiffness * body.area[i] * body.modulus[i] / body.spacing;
    body.stiffness[i] += face.stiffness[i];
    body.is_live[i] = 1;
    body.pressed = true;
  }
}

void Contact::find_forces(ContactFace& face) {
  ContactBody& body = bodies_[face.body];
  Vec3 n{0, 0, 0};
  n[face.axis] = face.inward;
  for (std::uint32_t i : face.candidates) {
    const double stiffness = face.stiffness[i];
    if (stiffness == 0) continue;
    const double depth = face.inward * (face.place - body.y[i][face.axis]);
    if (!(depth > 0)) {
      face.touching[i] = 0;
      face.stretch[i] = {0, 0, 0};
      continue;
    }
    stored_ += 0.5 * stiffness * depth * depth;
    Vec3 force = stiffness * depth * n;
    if (face.friction > 0)
      force = force - rub(face.stretch[i], face.touching[i], body.moved[i], n, stiffness, face.friction * depth);
    face.touching[i] = 1;
    body.force[i] = body.force[i] + force;
    net_[body.body] = net_[body.body] + force;
  }
}

/// Whether there is a surface to be above or below: its normal there and the masters' weights.
bool Contact::look(const ContactLink& link, const ContactLink::Candidate& candidate, Touch& touch) {
  const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  const std::uint32_t i = candidate.point;
  const Vec3 y = a.y[i], facing = a.n[i];
  const double R = reach(a, b), per_square = 1 / (R * R);
  if (weights_.size() < candidate.end - candidate.begin) weights_.resize(2 * (candidate.end - candidate.begin));
  double cover = 0, modulus = 0, heaviest = 0;
  for (std::uint32_t k = candidate.begin; k < candidate.end; ++k) {
    double& w = weights_[k - candidate.begin] = 0;
    const std::uint32_t q = link.masters[k];
    const Vec3 d = b.y[q] - y;
    const double square = dot(d, d) * per_square;
    if (square >= 1 || (a.total && dot(facing, b.n[q]) > kFacing)) continue;
    const double h = dot(d, b.n[q]), across = 1 - square + h * h * per_square;
    w = b.area[q] * (1 - square) * (1 - square);
    touch.weight += w;
    modulus += w * b.modulus[q];
    cover += b.area[q] * across * across;
    touch.n = touch.n + w * b.n[q];
    const Vec3 wd = w * d;
    touch.first = touch.first + wd;
    add_square(touch.second, wd, d);
    if (w > heaviest) {
      heaviest = w;
      touch.nearest = q;
    }
  }
  if (!(touch.weight > 0)) return false;
  const double length = norm(touch.n);
  if (!(length > 0)) return false;
  touch.n = (1 / length) * touch.n;
  const double whole = dimension_ == 2 ? 16 * R / 15 : std::numbers::pi * R * R / 3;
  touch.stiffness = link.share * std::min(1.0, 2 * cover / whole) * model_.contact.stiffness * a.area[i] *
                    std::min(a.modulus[i], modulus / touch.weight) / std::min(a.spacing, b.spacing);
  return true;
}

/// Height over the plane through the masters' weighted mean, after the weights are tilted so that this mean stands
/// right below the point: then turning normals and the masters' uneven places do not change the height, which only the
/// work of the forces may. One-sided neighbourhoods at a rim are tilted by less.
void Contact::stand_above(const ContactLink& link, const ContactLink::Candidate& candidate, Touch& touch) {
  const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  const Vec3 y = a.y[candidate.point], n = touch.n;
  const Vec3 across = std::abs(n[2]) < 0.9 ? Vec3{-n[1], n[0], 0} : Vec3{0, -n[2], n[1]};
  const Vec3 e = (1 / norm(across)) * across, f = dimension_ == 3 ? cross(n, e) : Vec3{0, 0, 0};
  const double R = reach(a, b), least = 0.05 * touch.weight * R * R;
  const Vec3 on_e = times(touch.second, e);
  const double ee = least + dot(e, on_e), ff = least + dot(f, times(touch.second, f)), ef = dot(f, on_e);
  const double me = dot(touch.first, e), mf = dot(touch.first, f), D = ee * ff - ef * ef;
  const Vec3 tilt = ((mf * ef - me * ff) / D) * e + ((me * ef - mf * ee) / D) * f;
  double height = 0;
  touch.weight = 0;
  for (std::uint32_t k = candidate.begin; k < candidate.end; ++k) {
    double& w = weights_[k - candidate.begin];
    if (w == 0) continue;
    const Vec3 d = b.y[link.masters[k]] - y;
    w *= std::max(0.0, 1 + dot(tilt, d));
    touch.weight += w;
    height -= w * dot(d, n);
  }
  touch.depth = a.radius[candidate.point] - height / touch.weight;
}

/// The tangential spring after the surfaces have slid over each other by `slid`: what it pulls back with.
/// @param most  its longest stretch by Coulomb's law, m
Vec3 Contact::rub(Vec3& stretch, bool touched, const Vec3& slid, const Vec3& n, double stiffness, double most) {
  const auto tangential = [&](const Vec3& a) { return a - dot(a, n) * n; };
  const Vec3 before = tangential(stretch), trial = touched ? before + tangential(slid) : Vec3{0, 0, 0};
  const double length = norm(trial);
  stretch = length > most ? (most / length) * trial : trial;
  // Work on the spring less what it stores.
  friction_ += 0.5 * stiffness * dot(before + stretch, trial - stretch);
  stored_ += 0.5 * stiffness * dot(stretch, stretch);
  return stiffness * stretch;
}

double Contact::friction_of(const ContactLink& link, std::uint32_t point, std::uint32_t master) const {
  if (link.friction) return *link.friction;
  const std::size_t a = bodies_[link.slave].material[point], b = bodies_[link.master].material[master];
  return material_friction_[a * model_.materials.size() + b];
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

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact with rigid bodies.
#include <algorithm>
#include <cmath>

#include "solver/core/contact.hpp"
#include "solver/core/contact_laws.hpp"
#include "solver/core/contact_touch.hpp"
#include "solver/core/surface_points.hpp"
#include "solver/core/wave_speeds.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr Vec3 kNone{0, 0, 0};

Box3 box_of(const RigidBody& body, int dimension) {
  Box3 box;
  for (Vec3 x : body.corners(body.now)) {
    if (dimension == 2) x[2] = 0;
    box.extend(x);
  }
  return box;
}

}  // namespace

/// What of a free rigid body meets other rigid ones; of a body that is moved only if it is a ball.
void Contact::add_rigid_points(std::size_t index) {
  const RigidBody& rigid = (*rigid_)[index];
  const Body& of = model_.bodies[rigid.body];
  ContactBody body;
  body.body = rigid.body;
  body.rigid = static_cast<std::int32_t>(index);
  body.begin = of.begin;
  body.spacing = mean_spacing(model_, of);
  if (rigid.surface.is_ball()) {
    const double R = rigid.surface.radius();
    body.reference = {rigid.surface.centre()};
    body.radius = {R};
    body.area = {dimension_ == 2 ? R : R * R};
    body.spacing = R;
  } else if (rigid.free) {
    SurfacePoints points = spread_points(of.boundary, body.spacing, dimension_);
    body.reference = std::move(points.places);
    body.area = std::move(points.areas);
    body.radius.assign(body.area.size(), 0);
  } else {
    return;
  }
  body.mobility.assign(body.reference.size(), 0);
  bodies_.push_back(std::move(body));
  total_index_.push_back(0);
}

void Contact::add_walls() {
  if (!rigid_) return;
  const auto ball = [&](std::size_t r) { return (*rigid_)[r].surface.is_ball(); };
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (std::size_t r = 0; r < rigid_->size(); ++r) {
      const RigidBody& wall = (*rigid_)[r];
      const auto& grips = model_.bodies[wall.body].rigid.grips;
      if (std::find(grips.begin(), grips.end(), model_.bodies[bodies_[b].body].name) != grips.end()) continue;
      if (bodies_[b].rigid < 0) {
        add_wall(b, r, 1);
        continue;
      }
      const auto a = static_cast<std::size_t>(bodies_[b].rigid);
      if (a == r || !((*rigid_)[a].free || wall.free)) continue;
      // A ball's distance to a surface is exact: it looks, the first of two.
      if (ball(a) ? ball(r) && r < a : ball(r)) continue;
      add_wall(b, r, !ball(a) && wall.free ? 0.5 : 1);
    }
}

/// What contact.pairs say, bodies before materials, else the wall's surface; of two rigid bodies the smoother one's.
std::vector<double> Contact::friction_of(const ContactBody& body, const RigidBody& wall) const {
  const auto of = [](const RigidBody& rigid) { return rigid.kind.rough ? INFINITY : rigid.kind.friction; };
  const double own = body.rigid >= 0 ? std::min(of(wall), of((*rigid_)[body.rigid])) : of(wall);
  std::vector<double> friction(model_.materials.size(), own);
  const std::int32_t of_wall = model_.particles.material[model_.bodies[wall.body].begin];
  for (std::size_t m = 0; m < friction.size(); ++m)
    if (const auto law = contact_law_of_materials(model_, static_cast<std::int32_t>(m), of_wall))
      friction[m] = law->friction;
  if (const auto law = contact_law_of_bodies(model_, body.body, wall.body))
    friction.assign(friction.size(), law->friction);
  return friction;
}

void Contact::add_wall(std::size_t body, std::size_t rigid, double share) {
  ContactWall wall;
  wall.body = body;
  wall.rigid = rigid;
  wall.share = share;
  const RigidBody& of = (*rigid_)[rigid];
  wall.friction = friction_of(bodies_[body], of);
  const std::size_t count = bodies_[body].size();
  for (auto* field : {&wall.stretch, &wall.facing, &wall.last, &wall.clear_at}) field->assign(count, kNone);
  wall.clear.assign(count, 0);
  wall.touching.assign(count, 0);
  wall.seen.assign(count, 0);
  // A rigid body that is met by one that deforms is as stiff as that one; of two rigid ones the softer counts.
  wall.modulus = INFINITY;
  if (bodies_[body].rigid >= 0) {
    const std::size_t p = model_.bodies[of.body].begin;
    const double c = wave_speeds_of(model_, material_wave_speeds(model_), p)[0];
    wall.modulus = model_.particles.mass[p] / model_.particles.reference_volume[p] * c * c;
    limit_rigid_step(bodies_[body], of, wall.modulus);
  }
  walls_.push_back(std::move(wall));
}

/// To a step that is safe before the two touch: as if a half of the one, or all of a ball, pressed at its longest arm.
void Contact::limit_rigid_step(const ContactBody& points, const RigidBody& wall, double modulus) {
  const RigidBody& own = (*rigid_)[points.rigid];
  double area = 0, mobility = 0;
  for (double a : points.area) area += own.surface.is_ball() ? a : 0.5 * a;
  for (const RigidBody* body : {&own, &wall})
    if (body->free) mobility += body->mobility(body->longest_arm());
  const double stiffness = model_.contact.stiffness * std::min(points.modulus[0], modulus) * area / points.spacing;
  rigid_step_ = std::min(rigid_step_, 2 / std::sqrt(stiffness * mobility));
}

void Contact::locate_rigid(ContactBody& body, const std::vector<std::uint32_t>& points, std::size_t count) {
  const RigidBody& rigid = (*rigid_)[body.rigid];
  for (std::size_t k = 0; k < count; ++k) body.y[points[k]] = rigid.place(rigid.now, body.reference[points[k]]);
}

void Contact::set_anchor(std::vector<RigidState>& anchor) const {
  anchor.clear();
  for (std::size_t r = 0; rigid_ && r < rigid_->size(); ++r) anchor.push_back((*rigid_)[r].now);
}

double Contact::shift_of_rigid(const std::vector<RigidState>& anchor) const {
  double shift = 0;
  for (std::size_t r = 0; r < anchor.size(); ++r) {
    const RigidBody& body = (*rigid_)[r];
    const std::array<Vec3, 8> before = body.corners(anchor[r]), now = body.corners(body.now);
    for (std::size_t k = 0; k < 8; ++k) shift = std::max(shift, norm(now[k] - before[k]));
  }
  return shift;
}

void Contact::find_fastest() {
  ++updates_;
  fastest_ = 0;
  if (walls_.empty() || !(last_step_ > 0)) return;
  for (const ContactBody& body : bodies_)
    for (std::uint32_t i : body.live) fastest_ = std::max(fastest_, norm(body.moved[i]) / last_step_);
}

/// No point goes farther in a step than a part of what the lists leave it.
double Contact::time_to_go() const {
  if (walls_.empty()) return INFINITY;
  double way = INFINITY;
  for (const ContactWall& wall : walls_) way = std::min(way, 0.25 * bodies_[wall.body].spacing);
  return std::min(fastest_ > 0 ? way / fastest_ : INFINITY, rigid_->time_to_go(way));
}

void Contact::list_candidates(ContactWall& wall) {
  ContactBody& body = bodies_[wall.body];
  const RigidBody& rigid = (*rigid_)[wall.rigid];
  const Box3 box = box_of(rigid, dimension_);
  wall.reach = body.spacing;
  for (double r : body.radius) wall.reach = std::max(wall.reach, r + body.spacing);
  const double far = wall.reach + margin_, apart = distance(body.box, box, dimension_) - wall.reach;
  allowed_ = std::min(allowed_, 0.45 * std::max(margin_, apart));
  wall.candidates.clear();
  for (std::uint32_t i = 0; i < body.size() && apart <= margin_; ++i) {
    if (!within(box, body.y[i], far, dimension_)) continue;
    if (!wall.touching[i] && !is_near(wall, i, rigid.material_point(rigid.now, body.y[i]), far)) continue;
    wall.candidates.push_back(i);
    body.is_active[i] = 1;
  }
}

/// Whether the surface is within a distance of a point. Looks for it only where what is known leaves that open.
bool Contact::is_near(ContactWall& wall, std::uint32_t i, const Vec3& z, double distance) const {
  if (wall.clear_of(i, z) > distance) return false;
  const auto foot = (*rigid_)[wall.rigid].surface.at(z, distance);
  wall.clear[i] = foot ? foot->distance : distance;
  wall.clear_at[i] = z;
  return foot.has_value();
}

double Contact::stiffness_of(const ContactWall& wall, std::uint32_t i) const {
  const ContactBody& body = bodies_[wall.body];
  return wall.share * model_.contact.stiffness * body.area[i] * std::min(body.modulus[i], wall.modulus) / body.spacing;
}

/// Rigid surfaces are looked at in each step: here only what the springs may be until the next time counts.
void Contact::find_geometry(ContactWall& wall) {
  ContactBody& body = bodies_[wall.body];
  const RigidBody& rigid = (*rigid_)[wall.rigid];
  for (std::uint32_t i : wall.candidates) {
    body.is_live[i] = 1;
    const double way = 0.25 * body.spacing + 2 * steady_;
    if (!wall.touching[i] && !is_near(wall, i, rigid.material_point(rigid.now, body.y[i]), body.radius[i] + way))
      continue;
    body.stiffness[i] += stiffness_of(wall, i);
    body.pressed = true;
  }
}

void Contact::leave(ContactWall& wall, std::uint32_t i, double stiffness) {
  if (wall.touching[i]) friction_ += 0.5 * stiffness * dot(wall.stretch[i], wall.stretch[i]);
  wall.touching[i] = 0;
  wall.stretch[i] = wall.facing[i] = kNone;
}

void Contact::find_forces(ContactWall& wall) {
  ContactBody& body = bodies_[wall.body];
  RigidBody& rigid = (*rigid_)[wall.rigid];
  for (std::uint32_t i : wall.candidates) {
    const Vec3 z = rigid.material_point(rigid.now, body.y[i]);
    Touch touch;
    touch.stiffness = stiffness_of(wall, i);
    const bool found = look(wall, i, z, touch);
    wall.last[i] = z;
    wall.seen[i] = updates_;
    if (!found || (body.total && dot(body.n[i], touch.n) > kFacing)) {
      leave(wall, i, touch.stiffness);
      continue;
    }
    press(wall, i, z, touch);
  }
}

/// How a point stands to the surface. One that has come in by a sheet of it stays with this sheet until it has come
/// out again, or left it beyond its rim.
bool Contact::look(ContactWall& wall, std::uint32_t i, const Vec3& z, Touch& touch) const {
  const RigidBody& rigid = (*rigid_)[wall.rigid];
  const SignedDistance& surface = rigid.surface;
  const double radius = bodies_[wall.body].radius[i];
  if (wall.clear_of(i, z) > std::max(radius, 0.0)) return false;
  Vec3& facing = wall.facing[i];
  if (facing == kNone && wall.seen[i] + 1 == updates_)
    if (const auto entered = surface.entered(wall.last[i], z)) facing = *entered;
  std::optional<SignedDistance::Foot> foot;
  if (facing != kNone) foot = surface.at_sheet(z, facing);
  if (!foot) {
    // As deep as bodies may overlap at the start, and farther than it goes in a step.
    const double far = std::max(radius, 0.0) + 0.5 * bodies_[wall.body].spacing;
    foot = surface.at(z, far);
    wall.clear[i] = foot ? foot->distance : far;
    wall.clear_at[i] = z;
  }
  if (!foot) return false;
  touch.depth = radius - foot->distance;
  touch.n = rigid.place(rigid.now, rigid.reference_centre + foot->normal) - rigid.now.centre;
  facing = touch.depth > 0 ? foot->face : kNone;
  return true;
}

void Contact::press(ContactWall& wall, std::uint32_t i, const Vec3& z, const Touch& touch) {
  ContactBody& a = bodies_[wall.body];
  RigidBody& b = (*rigid_)[wall.rigid];
  RigidBody* const rigid_a = a.rigid >= 0 ? &(*rigid_)[a.rigid] : nullptr;
  // Where they meet, and where the two points that are there now have been before.
  const Vec3 meet = rigid_a ? a.y[i] - (a.radius[i] - touch.depth) * touch.n : a.y[i];
  const Vec3 of_a =
      rigid_a ? rigid_a->place(rigid_a->before, rigid_a->material_point(rigid_a->now, meet)) : a.y[i] - a.moved[i];
  const Vec3 of_b = b.place(b.before, rigid_a ? b.material_point(b.now, meet) : z);
  const Vec3 slid = last_step_ > 0 ? of_b - of_a : kNone;
  const double closing = last_step_ > 0 ? -dot(slid, touch.n) * longest_step_ / last_step_ : 0;
  if (touch.depth + std::max(0.0, closing) > 0) {
    b.stiffen(meet, touch.stiffness);
    if (rigid_a) rigid_a->stiffen(meet, touch.stiffness);
  }
  if (!(touch.depth > 0)) return leave(wall, i, touch.stiffness);
  stored_ += 0.5 * touch.stiffness * touch.depth * touch.depth;
  Vec3 force = touch.stiffness * touch.depth * touch.n;
  const double mu = wall.friction[a.material[i]];
  if (mu > 0) force = force - rub(wall.stretch[i], wall.touching[i], slid, touch.n, touch.stiffness, mu, touch.depth);
  wall.touching[i] = 1;
  a.force[i] = a.force[i] + force;
  if (rigid_a) rigid_a->push(meet, force);
  b.push(meet, -1.0 * force);
  net_[a.body] = net_[a.body] + force;
  net_[b.body] = net_[b.body] - force;
}

void Contact::refuse_overlap(const ContactWall& wall) const {
  const ContactBody& body = bodies_[wall.body];
  const RigidBody& rigid = (*rigid_)[wall.rigid];
  const double most = 0.5 * body.spacing;
  const Box3 box = box_of(rigid, dimension_);
  for (std::uint32_t i = 0; i < body.size(); ++i) {
    if (!within(box, body.y[i], body.radius[i], dimension_)) continue;
    const double depth = body.radius[i] - rigid.foot(body.y[i], INFINITY)->distance;
    if (depth > most)
      throw Error("solve",
                  "depth by which body '" + model_.bodies[body.body].name + "' and rigid body '" +
                      model_.bodies[rigid.body].name + "' overlap at the start",
                  shortest(depth) + " m", "at most half the spacing of its particles, " + shortest(most) + " m");
  }
}

}  // namespace scarp

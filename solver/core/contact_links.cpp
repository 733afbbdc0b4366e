// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact between surfaces, and between them and balls: see contact.hpp.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/core/contact_touch.hpp"

namespace scarp {
namespace {

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
    const auto end = static_cast<std::uint32_t>(link.masters.size());
    near_.reserve(end - begin);
    link.candidates.push_back({.point = i, .begin = begin, .end = end});
  }
  link.shares.reserve(link.masters.size());
}

void Contact::find_geometry(ContactLink& link) {
  link.shares.clear();
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

void Contact::make_live(ContactLink& link, ContactLink::Candidate& candidate, const Touch& touch) {
  ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  candidate.n = touch.n;
  candidate.stiffness = touch.stiffness;
  candidate.friction = friction_of(link, candidate.point, touch.nearest);
  a.is_live[candidate.point] = 1;
  a.stiffness[candidate.point] += touch.stiffness;
  a.pressed = b.pressed = true;
  candidate.shares_begin = static_cast<std::uint32_t>(link.shares.size());
  for (const NearMaster& near : near_) {
    const double part = near.weight / touch.weight;
    if (part == 0) continue;
    link.shares.push_back({near.point, part});
    b.is_live[near.point] = 1;
    b.stiffness[near.point] += part * touch.stiffness;
  }
  candidate.shares_end = static_cast<std::uint32_t>(link.shares.size());
}

/// Before the geometry changes.
void Contact::find_slides(ContactLink& link) {
  const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  for (const ContactLink::Candidate& candidate : link.candidates) {
    if (!candidate.live) continue;
    Vec3 slid = a.moved[candidate.point];
    for (std::uint32_t k = candidate.shares_begin; k < candidate.shares_end; ++k)
      slid = slid - link.shares[k].part * b.moved[link.shares[k].point];
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
    for (std::uint32_t k = candidate.shares_begin; k < candidate.shares_end; ++k)
      above = above - link.shares[k].part * b.y[link.shares[k].point];
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
              rub(link.stretch[i], link.touching[i], link.slid[i], candidate.n, stiffness, candidate.friction, depth);
    link.touching[i] = 1;
    a.force[i] = a.force[i] + force;
    for (std::uint32_t k = candidate.shares_begin; k < candidate.shares_end; ++k) {
      const ContactLink::Share& share = link.shares[k];
      b.force[share.point] = b.force[share.point] - share.part * force;
    }
    net_[a.body] = net_[a.body] + force;
    net_[b.body] = net_[b.body] - force;
  }
}

/// Whether there is a surface to be above or below: its normal there and the masters' weights.
bool Contact::look(const ContactLink& link, const ContactLink::Candidate& candidate, Touch& touch) {
  const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  const std::uint32_t i = candidate.point;
  const Vec3 y = a.y[i], facing = a.n[i];
  const double R = reach(a, b), per_square = 1 / (R * R);
  near_.clear();
  double cover = 0, modulus = 0, heaviest = 0;
  for (std::uint32_t k = candidate.begin; k < candidate.end; ++k) {
    const std::uint32_t q = link.masters[k];
    const Vec3 d = b.y[q] - y;
    const double square = dot(d, d) * per_square;
    if (square >= 1 || (a.total && dot(facing, b.n[q]) > kFacing)) continue;
    const double h = dot(d, b.n[q]), across = 1 - square + h * h * per_square;
    const double w = b.area[q] * (1 - square) * (1 - square);
    near_.push_back({q, w, d});
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
  const Vec3& n = touch.n;
  const Vec3 across = std::abs(n[2]) < 0.9 ? Vec3{-n[1], n[0], 0} : Vec3{0, -n[2], n[1]};
  const Vec3 e = (1 / norm(across)) * across, f = dimension_ == 3 ? cross(n, e) : Vec3{0, 0, 0};
  const double R = reach(a, b), least = 0.05 * touch.weight * R * R;
  const Vec3 on_e = times(touch.second, e);
  const double ee = least + dot(e, on_e), ff = least + dot(f, times(touch.second, f)), ef = dot(f, on_e);
  const double me = dot(touch.first, e), mf = dot(touch.first, f), D = ee * ff - ef * ef;
  const Vec3 tilt = ((mf * ef - me * ff) / D) * e + ((me * ef - mf * ee) / D) * f;
  double height = 0;
  touch.weight = 0;
  for (NearMaster& near : near_) {
    near.weight *= std::max(0.0, 1 + dot(tilt, near.d));
    touch.weight += near.weight;
    height -= near.weight * dot(near.d, n);
  }
  touch.depth = a.radius[candidate.point] - height / touch.weight;
}

double Contact::friction_of(const ContactLink& link, std::uint32_t point, std::uint32_t master) const {
  if (link.friction) return *link.friction;
  const std::size_t a = bodies_[link.slave].material[point], b = bodies_[link.master].material[master];
  return material_friction_[a * model_.materials.size() + b];
}

}  // namespace scarp

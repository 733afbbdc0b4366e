// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/core/wave_speeds.hpp"
#include "solver/materials/tensor.hpp"

namespace scarp {
namespace {

/// Surfaces press where they face each other, not where a point is beside a rim: cosine between the normals.
constexpr double kFacing = -0.2;

double distance(const Box3& a, const Box3& b, int dimension) {
  double square = 0;
  for (int i = 0; i < dimension; ++i) {
    const double d = std::max({0.0, a.min[i] - b.max[i], b.min[i] - a.max[i]});
    square += d * d;
  }
  return std::sqrt(square);
}

bool within(const Box3& box, const Vec3& x, double margin, int dimension) {
  for (int i = 0; i < dimension; ++i)
    if (!(x[i] >= box.min[i] - margin && x[i] <= box.max[i] + margin)) return false;
  return true;
}

}  // namespace

/// A point and the other body's surface.
struct Contact::Touch {
  double depth = 0;      ///< m
  Vec3 n{0, 0, 0};       ///< of the other body, outward
  double stiffness = 0;  ///< N/m
  double weight = 0;     ///< sum of the masters' weights
  std::uint32_t nearest = 0;
};

void Contact::update() {
  if (lists_hold())
    for (ContactBody& body : bodies_) locate(body, false);
  else
    make_lists();
  for (ContactBody& body : bodies_) {
    body.pressed = false;
    for (std::uint32_t i : body.active) {
      body.force[i] = {0, 0, 0};
      body.stiffness[i] = 0;
    }
  }
  stored_ = 0;
  std::fill(net_.begin(), net_.end(), Vec3{0, 0, 0});
  for (ContactLink& link : links_) find_forces(link);
  for (ContactFace& face : faces_) find_forces(face);
}

bool Contact::lists_hold() {
  double shift = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    ContactBody& body = bodies_[b];
    if (body.total) {
      shift = std::max(shift, total_->contact_shift(total_index_[b], body.surface, body.anchor));
      continue;
    }
    for (std::size_t i = 0; i < body.size(); ++i)
      shift = std::max(shift, norm(model_.particles.position[body.begin + i] - body.anchor[i]));
  }
  return shift < allowed_;
}

/// Places and normals, of the active points or of all.
void Contact::locate(ContactBody& body, bool all) {
  const std::vector<std::uint32_t>& points = all ? everything_ : body.active;
  const std::size_t count = all ? body.size() : points.size();
  for (std::size_t k = 0; k < count; ++k) body.moved[points[k]] = body.y[points[k]];
  if (body.total)
    total_->locate_contact(total_index_[static_cast<std::size_t>(&body - bodies_.data())], body.surface, points.data(),
                           count, body.y, body.n);
  else
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = points[k], p = body.begin + i;
      const double J = determinant(model_.particles.deformation_gradient[p]);
      const double edge = std::pow(J * model_.particles.reference_volume[p], 1.0 / dimension_);
      body.y[i] = model_.particles.position[p];
      body.radius[i] = 0.5 * edge;
      body.area[i] = dimension_ == 2 ? edge : edge * edge;
    }
  for (std::size_t k = 0; k < count; ++k) body.moved[points[k]] = body.y[points[k]] - body.moved[points[k]];
}

void Contact::make_lists() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    ContactBody& body = bodies_[b];
    locate(body, true);
    body.box = {};
    for (const Vec3& y : body.y) body.box.extend(y);
    std::fill(body.is_active.begin(), body.is_active.end(), std::uint8_t{0});
    if (body.total)
      total_->anchor_contact(total_index_[b], body.surface, body.anchor);
    else
      body.anchor = body.y;
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
    link.candidates.push_back({i, begin, static_cast<std::uint32_t>(link.masters.size())});
  }
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

void Contact::find_forces(ContactFace& face) {
  ContactBody& body = bodies_[face.body];
  Touch touch;
  touch.n[face.axis] = face.inward;
  for (std::uint32_t i : face.candidates) {
    touch.depth = face.inward * (face.place - body.y[i][face.axis]);
    touch.stiffness = model_.contact.stiffness * body.area[i] * body.modulus[i] / body.spacing;
    const double closing = last_step_ > 0 ? -dot(body.moved[i], touch.n) * longest_step_ / last_step_ : 0;
    const bool facing = dot(body.n[i], touch.n) <= kFacing;
    if (facing && touch.depth + std::max(0.0, closing) > 0) {
      body.stiffness[i] += touch.stiffness;
      body.pressed = true;
    }
    if (!facing || !(touch.depth > 0)) {
      face.touching[i] = 0;
      face.stretch[i] = {0, 0, 0};
      continue;
    }
    stored_ += 0.5 * touch.stiffness * touch.depth * touch.depth;
    Vec3 force = touch.stiffness * touch.depth * touch.n;
    if (face.friction > 0) force = force - rub(face.stretch[i], face.touching[i], body.moved[i], touch, face.friction);
    face.touching[i] = 1;
    body.force[i] = body.force[i] + force;
    net_[body.body] = net_[body.body] + force;
  }
}

void Contact::find_forces(ContactLink& link) {
  for (const ContactLink::Candidate& candidate : link.candidates) {
    Touch touch;
    const bool found = look(link, candidate, touch);
    if (found && touch.depth > 0) {
      press(link, candidate, touch);
      continue;
    }
    if (found && touch.depth + approach(link, candidate, touch) > 0) stiffen(link, candidate, touch);
    // What the tangential spring held when the surfaces parted went on the way down to no pressure.
    link.touching[candidate.point] = 0;
    link.stretch[candidate.point] = {0, 0, 0};
  }
}

/// By how much the point comes nearer in a step at most. Springs that it will meet count for that step already: who
/// enters them in a long one is thrown back by more than what he came with.
double Contact::approach(const ContactLink& link, const ContactLink::Candidate& candidate, const Touch& touch) const {
  const Vec3 slid = slid_over(link, candidate, touch);
  return last_step_ > 0 ? -dot(slid, touch.n) * longest_step_ / last_step_ : 0;
}

/// Motion of the point since the last update, less the masters' mean one.
Vec3 Contact::slid_over(const ContactLink& link, const ContactLink::Candidate& candidate, const Touch& touch) const {
  const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  Vec3 carried{0, 0, 0};
  for (std::uint32_t j = candidate.begin; j < candidate.end; ++j)
    carried = carried + weights_[j - candidate.begin] * b.moved[link.masters[j]];
  return a.moved[candidate.point] - (1 / touch.weight) * carried;
}

void Contact::stiffen(const ContactLink& link, const ContactLink::Candidate& candidate, const Touch& touch) {
  ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  a.stiffness[candidate.point] += touch.stiffness;
  a.pressed = b.pressed = true;
  for (std::uint32_t j = candidate.begin; j < candidate.end; ++j)
    b.stiffness[link.masters[j]] += weights_[j - candidate.begin] / touch.weight * touch.stiffness;
}

/// Whether there is a surface to be above or below, and how the point stands to it.
bool Contact::look(const ContactLink& link, const ContactLink::Candidate& candidate, Touch& touch) {
  const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  const std::uint32_t i = candidate.point;
  const Vec3 y = a.y[i];
  const double R = reach(a, b), per_square = 1 / (R * R);
  if (weights_.size() < candidate.end - candidate.begin) weights_.resize(2 * (candidate.end - candidate.begin));
  double cover = 0, modulus = 0, heaviest = 0;
  for (std::uint32_t k = candidate.begin; k < candidate.end; ++k) {
    double& w = weights_[k - candidate.begin] = 0;
    const std::uint32_t q = link.masters[k];
    const Vec3 d = y - b.y[q];
    const double square = dot(d, d) * per_square;
    if (square >= 1 || (a.total && dot(a.n[i], b.n[q]) > kFacing)) continue;
    const double h = dot(d, b.n[q]), across = 1 - square + h * h * per_square;
    w = b.area[q] * (1 - square) * (1 - square);
    touch.weight += w;
    modulus += w * b.modulus[q];
    cover += b.area[q] * across * across;
    touch.n = touch.n + w * b.n[q];
    if (w > heaviest) {
      heaviest = w;
      touch.nearest = q;
    }
  }
  if (!(touch.weight > 0)) return false;
  const double length = norm(touch.n);
  if (!(length > 0)) return false;
  touch.n = (1 / length) * touch.n;
  touch.depth = a.radius[i] - height_above(link, candidate, touch);
  const double whole = dimension_ == 2 ? 16 * R / 15 : std::numbers::pi * R * R / 3;
  touch.stiffness = link.share * std::min(1.0, 2 * cover / whole) * model_.contact.stiffness * a.area[i] *
                    std::min(a.modulus[i], modulus / touch.weight) / std::min(a.spacing, b.spacing);
  return true;
}

/// Height over the plane through the masters' weighted mean, after the weights are tilted so that this mean stands
/// right below the point: then turning normals and the masters' uneven places do not change the height, which only the
/// work of the forces may. One-sided neighbourhoods at a rim are tilted by less.
double Contact::height_above(const ContactLink& link, const ContactLink::Candidate& candidate, Touch& touch) {
  const ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  const Vec3 y = a.y[candidate.point], n = touch.n;
  const Vec3 across = std::abs(n[2]) < 0.9 ? Vec3{-n[1], n[0], 0} : Vec3{0, -n[2], n[1]};
  const Vec3 e = (1 / norm(across)) * across, f = dimension_ == 3 ? cross(n, e) : Vec3{0, 0, 0};
  const double R = reach(a, b);
  double me = 0, mf = 0, ee = 0.05 * touch.weight * R * R, ff = ee, ef = 0;
  const auto each = [&](auto&& act) {
    for (std::uint32_t k = candidate.begin; k < candidate.end; ++k) {
      double& w = weights_[k - candidate.begin];
      if (w == 0) continue;
      const Vec3 d = b.y[link.masters[k]] - y;
      act(w, dot(d, e), dot(d, f), d);
    }
  };
  each([&](double w, double te, double tf, const Vec3&) {
    me += w * te, mf += w * tf;
    ee += w * te * te, ff += w * tf * tf, ef += w * te * tf;
  });
  const double D = ee * ff - ef * ef;
  const double be = (mf * ef - me * ff) / D, bf = (me * ef - mf * ee) / D;
  double height = 0;
  touch.weight = 0;
  each([&](double& w, double te, double tf, const Vec3& d) {
    w *= std::max(0.0, 1 + be * te + bf * tf);
    touch.weight += w;
    height -= w * dot(d, n);
  });
  return height / touch.weight;
}

void Contact::press(ContactLink& link, const ContactLink::Candidate& candidate, const Touch& touch) {
  ContactBody &a = bodies_[link.slave], &b = bodies_[link.master];
  const std::uint32_t i = candidate.point;
  const double k = touch.stiffness;
  Vec3 force = k * touch.depth * touch.n;
  stored_ += 0.5 * k * touch.depth * touch.depth;
  const double mu = friction_of(link, i, touch.nearest);
  if (mu > 0) force = force - rub(link.stretch[i], link.touching[i], slid_over(link, candidate, touch), touch, mu);
  link.touching[i] = 1;
  a.force[i] = a.force[i] + force;
  stiffen(link, candidate, touch);
  for (std::uint32_t j = candidate.begin; j < candidate.end; ++j) {
    const double share = weights_[j - candidate.begin] / touch.weight;
    if (share == 0) continue;
    const std::uint32_t q = link.masters[j];
    b.force[q] = b.force[q] - share * force;
  }
  net_[a.body] = net_[a.body] + force;
  net_[b.body] = net_[b.body] - force;
}

/// The tangential spring after the surfaces have slid over each other by `slid`: what it pulls back with.
Vec3 Contact::rub(Vec3& stretch, bool touched, const Vec3& slid, const Touch& touch, double mu) {
  const auto tangential = [&](const Vec3& a) { return a - dot(a, touch.n) * touch.n; };
  const Vec3 before = tangential(stretch), trial = touched ? before + tangential(slid) : Vec3{0, 0, 0};
  const double length = norm(trial), most = mu * touch.depth;
  stretch = length > most ? (most / length) * trial : trial;
  // Work on the spring less what it stores.
  friction_ += 0.5 * touch.stiffness * dot(before + stretch, trial - stretch);
  stored_ += 0.5 * touch.stiffness * dot(stretch, stretch);
  return touch.stiffness * stretch;
}

double Contact::friction_of(const ContactLink& link, std::uint32_t point, std::uint32_t master) const {
  if (link.friction) return *link.friction;
  const std::size_t a = bodies_[link.slave].material[point], b = bodies_[link.master].material[master];
  return material_friction_[a * model_.materials.size() + b];
}

void Contact::push(double dt) {
  elapsed_ += dt;
  last_step_ = dt;
  longest_step_ = std::max(longest_step_, dt);
  for (std::size_t b = 0; b < net_.size(); ++b) impulse_[b] = impulse_[b] + dt * net_[b];
  pushed_.clear();
  pushes_.clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const ContactBody& body = bodies_[b];
    if (!body.pressed) continue;
    if (body.total) {
      total_->push_contact(total_index_[b], body.surface, body.active.data(), body.active.size(), body.force);
      continue;
    }
    for (std::uint32_t i : body.active) {
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
  for (const ContactBody& body : bodies_) {
    if (!body.pressed) continue;
    double stiffness = 0, mobility = 0;
    for (std::uint32_t i : body.active) {
      if (body.stiffness[i] == 0) continue;
      stiffness = std::max(stiffness, body.stiffness[i]);
      mobility = std::max(mobility, body.mobility[i]);
    }
    const double square = stiffness * mobility;
    second = std::max(second, std::min(most, square));
    most = std::max(most, square);
  }
  if (model_.contact.self_contact) second = most;
  return most > 0 ? courant * 2 / std::sqrt(most + second) : INFINITY;
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

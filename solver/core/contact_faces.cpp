// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact with faces of the domain.
#include <algorithm>

#include "solver/core/contact_touch.hpp"

namespace scarp {

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
      force = force - rub(face.stretch[i], face.touching[i], body.moved[i], n, stiffness, face.friction, depth);
    face.touching[i] = 1;
    body.force[i] = body.force[i] + force;
    net_[body.body] = net_[body.body] + force;
  }
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TotalLagrangian where contact meets the surfaces of its bodies.
#include "solver/core/contact_points.hpp"
#include "solver/core/step_total.hpp"

namespace scarp {
namespace {

auto displacement(const TotalBody& body) {
  return [&body](std::uint32_t i) { return body.displacement[i]; };
}

}  // namespace

void TotalLagrangian::prepare_contact(std::size_t index, ContactSurface& surface) {
  if (nodal_[index]) return nodal_[index]->prepare_contact(surface);
  bodies_[index].displacement.assign(bodies_[index].grid.nodes.size(), Vec3{0, 0, 0});
}

void TotalLagrangian::locate_contact(std::size_t index, const ContactSurface& surface, const std::uint32_t* points,
                                     std::size_t count, std::vector<Vec3>& y, std::vector<Vec3>* n) const {
  if (nodal_[index]) return nodal_[index]->locate_contact(surface, points, count, y, n);
  locate_points(surface, points, count, displacement(bodies_[index]), y, n);
}

void TotalLagrangian::anchor_contact(std::size_t index, const ContactSurface& surface,
                                     std::vector<Vec3>& anchor) const {
  if (nodal_[index]) return nodal_[index]->anchor_contact(surface, anchor);
  anchor_points(surface, displacement(bodies_[index]), anchor);
}

double TotalLagrangian::contact_shift(std::size_t index, const ContactSurface& surface,
                                      const std::vector<Vec3>& anchor) const {
  if (nodal_[index]) return nodal_[index]->contact_shift(surface, anchor);
  return shift_of_points(surface, displacement(bodies_[index]), anchor);
}

void TotalLagrangian::push_contact(std::size_t index, const ContactSurface& surface, const std::uint32_t* points,
                                   std::size_t count, const std::vector<Vec3>& force) {
  if (nodal_[index]) return nodal_[index]->push_contact(surface, points, count, force);
  TotalBody& body = bodies_[index];
  const auto corners = static_cast<std::size_t>(surface.corners);
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint32_t i = points[j];
    for (std::size_t k = 0; k < corners; ++k) {
      Vec3& sum = body.slots[surface.cell[i] * corners + k];
      sum = sum + surface.weights[i * corners + k] * force[i];
    }
  }
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NodalBody where contact meets its surface.
#include "solver/core/contact_points.hpp"
#include "solver/core/nodal_body.hpp"

namespace scarp {
namespace {

auto displacement(const kernels::NodeArrays& nodes) {
  return [&nodes](std::uint32_t i) { return Vec3{nodes.U[0][i], nodes.U[1][i], nodes.U[2][i]}; };
}

}  // namespace

void NodalBody::prepare_contact(ContactSurface& surface) const {
  for (auto* nodes : {&surface.nodes, &surface.distinct})
    for (std::uint32_t& node : *nodes) node = layout_.node_of[node];
}

void NodalBody::locate_contact(const ContactSurface& surface, const std::uint32_t* points, std::size_t count,
                               std::vector<Vec3>& y, std::vector<Vec3>* n) const {
  locate_points(surface, points, count, displacement(nodes_), y, n);
}

void NodalBody::anchor_contact(const ContactSurface& surface, std::vector<Vec3>& anchor) const {
  anchor_points(surface, displacement(nodes_), anchor);
}

double NodalBody::contact_shift(const ContactSurface& surface, const std::vector<Vec3>& anchor) const {
  return shift_of_points(surface, displacement(nodes_), anchor);
}

void NodalBody::push_contact(const ContactSurface& surface, const std::uint32_t* points, std::size_t count,
                             const std::vector<Vec3>& force) {
  const auto corners = static_cast<std::size_t>(surface.corners);
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint32_t i = points[j];
    const Vec3& f = force[i];
    if (f == Vec3{0, 0, 0}) continue;
    for (std::size_t k = i * corners; k < (i + 1) * corners; ++k)
      for (int c = 0; c < layout_.dimension; ++c) nodes_.sum[c][surface.nodes[k]] += surface.weights[k] * f[c];
  }
}

}  // namespace scarp

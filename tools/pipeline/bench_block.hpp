// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <utility>

#include "solver/model/model.hpp"

namespace scarp {

/// Adds a body of the model's first material, 1900 kg/m3, to a domain whose cells are of one metre: points half a metre
/// apart along each axis, x fastest.
/// @param points    along each axis; 1 along z in plane strain
/// @param place     place(i, j, k), m
/// @param velocity  velocity(X), m/s
template <class Place, class Velocity>
void add_block(Model& model, std::string name, Formulation formulation, const std::array<int, 3>& points, Place&& place,
               Velocity&& velocity) {
  const int dimension = model.domain.dimension;
  const double V0 = dimension == 3 ? 0.125 : 0.25, density = 1900;
  Particles& P = model.particles;
  Body body;
  body.name = std::move(name);
  body.formulation = formulation;
  body.begin = P.size();
  resize_particles(P, body.begin + static_cast<std::size_t>(points[0]) * points[1] * points[2]);
  std::size_t p = body.begin;
  for (int k = 0; k < points[2]; ++k)
    for (int j = 0; j < points[1]; ++j)
      for (int i = 0; i < points[0]; ++i, ++p) {
        const Vec3 X = place(i, j, k);
        P.id[p] = static_cast<std::int64_t>(p);
        P.body[p] = static_cast<std::int32_t>(model.bodies.size());
        P.reference_position[p] = P.position[p] = X;
        P.reference_volume[p] = V0;
        P.mass[p] = density * V0;
        P.velocity[p] = velocity(X);
      }
  body.end = p;
  body.lattice = {{0, 0, 0}, 1, {}};
  for (int a = 0; a < dimension; ++a)
    body.lattice.cells[a] = static_cast<std::int32_t>(model.domain.max[a] - model.domain.min[a]);
  model.bodies.push_back(std::move(body));
}

}  // namespace scarp

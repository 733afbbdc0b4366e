// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rigid bodies for tests of the solver.
#pragma once

#include <string>

#include "tests/support/lattice_seed.hpp"

namespace scarp::test {

/// A rigid body of the particles in `box`, whose boundary is the box; in plane strain a rectangle.
inline void seed_rigid_box(Model& model, const std::string& name, const Box3& box, const RigidOptions& options,
                           const Vec3& velocity) {
  const auto inside = [&](const Vec3& X) {
    for (int a = 0; a < model.domain.dimension; ++a)
      if (X[a] < box.min[a] || X[a] > box.max[a]) return false;
    return true;
  };
  // At least one layer of particles, however thin the box is.
  int n = 2;
  for (int a = 0; a < model.domain.dimension; ++a)
    while (model.domain.cell / n > 0.5 * (box.max[a] - box.min[a])) ++n;
  seed_body(model, name, LinearElastic{{2500, 1e9, 0.2}}, n, inside, [&](const Vec3&) { return velocity; });
  Body& body = model.bodies.back();
  body.formulation = Formulation::rigid;
  body.rigid = options;
  const Vec3 &low = box.min, &high = box.max;
  body.boundary = model.domain.dimension == 3
                      ? box_mesh(box)
                      : prism_mesh({{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}}, 1);
}

}  // namespace scarp::test

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models for tests of the solver, seeded on a lattice without the discretize stage.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "solver/materials/law.hpp"
#include "solver/model/model.hpp"

namespace scarp::test {

/// A domain from `min` to `max`, whole cells apart; 2D where max[2] == min[2].
inline Model empty_model(const Vec3& min, const Vec3& max, double cell, std::array<Condition, 6> faces = {}) {
  Model model;
  model.domain = {max[2] == min[2] ? 2 : 3, cell, min, max, {}};
  std::copy(faces.begin(), faces.end(), model.domain.faces.begin());
  return model;
}

/// Fills the part of the domain where `inside(X)` with n points per axis and cell; the lattice spans the domain.
inline void seed_body(Model& model, const std::string& name, const Material& material, int n,
                      const std::function<bool(const Vec3& X)>& inside,
                      const std::function<Vec3(const Vec3& X)>& velocity = {}) {
  const Domain& domain = model.domain;
  Body body;
  body.name = name;
  body.lattice.origin = domain.min;
  body.lattice.cell = domain.cell;
  for (int a = 0; a < domain.dimension; ++a)
    body.lattice.cells[a] = static_cast<std::int32_t>(std::lround((domain.max[a] - domain.min[a]) / domain.cell));
  body.begin = model.particles.size();
  const auto& cells = body.lattice.cells;
  const double spacing = domain.cell / n;
  const double volume = std::pow(spacing, domain.dimension);
  const auto index = static_cast<std::int32_t>(model.bodies.size());
  std::vector<Vec3> points;
  for (int k = 0; k < (domain.dimension == 3 ? cells[2] * n : 1); ++k)
    for (int j = 0; j < cells[1] * n; ++j)
      for (int i = 0; i < cells[0] * n; ++i) {
        const Vec3 X{domain.min[0] + (i + 0.5) * spacing, domain.min[1] + (j + 0.5) * spacing,
                     domain.dimension == 3 ? domain.min[2] + (k + 0.5) * spacing : 0};
        if (inside(X)) points.push_back(X);
      }
  Particles& particles = model.particles;
  resize_particles(particles, body.begin + points.size());
  for (std::size_t p = body.begin; p < particles.size(); ++p) {
    const Vec3& X = points[p - body.begin];
    particles.id[p] = static_cast<std::int64_t>(p);
    particles.body[p] = index;
    particles.material[p] = static_cast<std::int32_t>(model.materials.size());
    particles.mass[p] = density_of(material) * volume;
    particles.reference_volume[p] = volume;
    particles.stress[p] = rest_stress(material);
    particles.reference_position[p] = particles.position[p] = X;
    if (velocity) particles.velocity[p] = velocity(X);
  }
  body.end = particles.size();
  model.materials.push_back({name, material});
  model.bodies.push_back(body);
}

inline bool everywhere(const Vec3&) { return true; }

/// The particle whose reference position is nearest to X.
inline std::size_t nearest(const Particles& particles, const Vec3& X) {
  std::size_t best = 0;
  for (std::size_t p = 1; p < particles.size(); ++p)
    if (norm(particles.reference_position[p] - X) < norm(particles.reference_position[best] - X)) best = p;
  return best;
}

/// Where the material point X is now, carried from the nearest particle by its F.
inline Vec3 carried(const Particles& particles, const Vec3& X) {
  const std::size_t p = nearest(particles, X);
  const Mat3& F = particles.deformation_gradient[p];
  const Vec3 d = X - particles.reference_position[p];
  const Vec3& x = particles.position[p];
  return {x[0] + F[0] * d[0] + F[1] * d[1] + F[2] * d[2], x[1] + F[3] * d[0] + F[4] * d[1] + F[5] * d[2],
          x[2] + F[6] * d[0] + F[7] * d[1] + F[8] * d[2]};
}

}  // namespace scarp::test

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/step_limit.hpp"

#include <cmath>

#include "solver/core/current_wave_speed.hpp"
#include "solver/core/history.hpp"
#include "solver/core/moving_reference.hpp"

namespace scarp {
namespace {

/// c^2 of particle p as it stands, (m/s)^2, by bound(law, motion, history).
template <class F>
double wave_speed_squared(const Particles& particles, std::size_t p, const PreparedLaw& prepared, F&& bound) {
  const Mat3& gradient = particles.deformation_gradient[p];
  const Motion motion = make_motion(gradient, gradient);
  return std::visit(
      [&](const auto& law) { return bound(law, motion, load_history<std::decay_t<decltype(law)>>(particles, p)); },
      prepared);
}

void name_particle(StepLimit& limit, const Particles& particles, std::size_t p) {
  limit.body = particles.body[p];
  limit.material = particles.material[p];
  limit.particle = particles.id[p];
  limit.position = particles.position[p];
}

}  // namespace

void look_at_cell(StepLimit& limit, double& most, const Particles& particles, const std::vector<PreparedLaw>& laws,
                  std::size_t begin, std::size_t end, const TotalBody* body) {
  double mass = 0, stiffness = 0, stiffest = -1;
  std::size_t place = begin;
  for (std::size_t p = begin; p < end; ++p) {
    const Mat3* base = body ? base_of(*body, p) : nullptr;
    const double c2 = wave_speed_squared(particles, p, laws[particles.material[p]],
                                         [&](const auto& law, const Motion& motion, const PointHistory& history) {
                                           return grid_wave_speed_squared(law, motion, history, base);
                                         });
    mass += particles.mass[p];
    stiffness += particles.mass[p] * c2;
    if (!(c2 > stiffest)) continue;
    stiffest = c2;
    place = p;
  }
  if (!(stiffness / mass > most)) return;
  most = stiffness / mass;
  limit.wave_speed = std::sqrt(most);
  name_particle(limit, particles, place);
}

StepLimit find_step_limit(const Particles& particles, const TotalBody& body) {
  StepLimit limit;
  double most = -1;
  for (std::size_t cell = 0; cell + 1 < body.grid.cell_begin.size(); ++cell)
    look_at_cell(limit, most, particles, body.laws, body.grid.cell_begin[cell], body.grid.cell_begin[cell + 1], &body);
  return limit;
}

StepLimit find_step_limit(const Particles& particles, const UpdatedGrid& grid, const std::vector<PreparedLaw>& laws) {
  StepLimit limit;
  double most = -1, fastest = -1;
  std::size_t stiffest_at = 0, fastest_at = 0;
  for (const std::uint32_t p : grid.particles) {
    const double c2 = wave_speed_squared(particles, p, laws[particles.material[p]],
                                         [](const auto& law, const Motion& motion, const PointHistory& history) {
                                           return current_wave_speed_squared(law, motion, history);
                                         });
    const double speed = norm(particles.velocity[p]);
    if (c2 > most) {
      most = c2;
      stiffest_at = p;
    }
    if (speed > fastest) {
      fastest = speed;
      fastest_at = p;
    }
  }
  if (most < 0 || fastest < 0) return limit;  // nothing finite to name
  limit.wave_speed = std::sqrt(most);
  limit.particle_speed = fastest;
  name_particle(limit, particles, fastest > limit.wave_speed ? fastest_at : stiffest_at);
  return limit;
}

}  // namespace scarp

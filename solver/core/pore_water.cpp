// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/pore_water.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/core/step_options.hpp"
#include "solver/materials/law.hpp"
#include "solver/materials/tensor.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

double raster_level(const Heightfield& field, double x, double y) {
  const double right = field.x0 + (field.columns - 1) * field.cell, top = field.y0 + (field.rows - 1) * field.cell;
  return height_at(field, std::clamp(x, field.x0, right), std::clamp(y, field.y0, top));
}

double line_level(const std::vector<Vec2>& line, double x) {
  const auto next = std::upper_bound(line.begin(), line.end(), x, [](double at, const Vec2& p) { return at < p[0]; });
  if (next == line.begin()) return line.front()[1];
  if (next == line.end()) return line.back()[1];
  const Vec2 &a = *(next - 1), &b = *next;
  return a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
}

/// Slope of the table along an axis in plan, over a particle's edge.
double slope(const WaterTable& water, const Vec3& x, int axis, double edge) {
  Vec3 before = x, after = x;
  before[axis] -= 0.5 * edge;
  after[axis] += 0.5 * edge;
  const double rise = water_level(water, after) - water_level(water, before);
  return std::isfinite(rise) ? rise / edge : 0;
}

double edge_of(double volume, int dimension) { return dimension == 2 ? std::sqrt(volume) : std::cbrt(volume); }

}  // namespace

double water_level(const WaterTable& water, const Vec3& x) {
  return water.surface.columns > 0 ? raster_level(water.surface, x[0], x[1]) : line_level(water.line, x[0]);
}

double pore_pressure(const WaterTable& water, const Vec3& x, int dimension) {
  const double depth = water_level(water, x) - x[dimension - 1];
  return depth > 0 ? water.unit_weight * depth : 0;  // none where there is no level either
}

double submerged_share(const WaterTable& water, const Vec3& x, double edge, int dimension) {
  const double share = (water_level(water, x) - x[dimension - 1]) / edge + 0.5;
  return share > 0 ? std::min(share, 1.0) : 0;
}

Vec3 water_force(const WaterTable& water, const Particles& particles, std::size_t p, int dimension) {
  const Vec3& x = particles.position[p];
  const double volume = determinant(particles.deformation_gradient[p]) * particles.reference_volume[p];
  const double edge = edge_of(volume, dimension), share = submerged_share(water, x, edge, dimension);
  if (share == 0) return {0, 0, 0};
  Vec3 force{0, 0, 0};
  force[dimension - 1] = 1;
  for (int a = 0; a < dimension - 1; ++a) force[a] = -slope(water, x, a, edge);
  return (share * volume * water.unit_weight) * force;
}

void set_saturated_masses(Model& model) {
  if (!model.water) return;
  Particles& particles = model.particles;
  const std::vector<Vec3>& position = current_positions(particles);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double volume = particles.reference_volume[p];
    const double share =
        submerged_share(*model.water, position[p], edge_of(volume, model.domain.dimension), model.domain.dimension);
    const auto density = [&](const auto& m) {
      if constexpr (requires { m.saturated_density; })
        return m.density + share * (m.saturated_density.value_or(m.density) - m.density);
      return m.density;
    };
    particles.mass[p] = volume * std::visit(density, model.materials[particles.material[p]].law);
  }
}

double vertical_gravity(const SolverOptions& options, int dimension, const char* who) {
  const Vec3 gravity = gravity_of(options, dimension);
  const double down = -gravity[dimension - 1];
  if (!(down > 0) || std::abs(norm(gravity) - down) > 1e-12 * down)
    throw Error("solve", std::string(who) + " needs gravity straight down; it is",
                "(" + shortest(gravity[0]) + ", " + shortest(gravity[1]) + ", " + shortest(gravity[2]) + ") m/s2",
                dimension == 2 ? "[0, -g]" : "[0, 0, -g]");
  return down;
}

void check_water(const Model& model, const SolverOptions& options) {
  if (!model.water) return;
  const WaterTable& water = *model.water;
  vertical_gravity(options, model.domain.dimension, "a water table");
  if (!(water.unit_weight > 0) || !std::isfinite(water.unit_weight))
    throw Error("solve", "unit weight of the water", shortest(water.unit_weight) + " N/m3", "above 0");
  if (water.surface.columns == 0 && water.line.empty())
    throw Error("solve", "the water table", "nothing", "an elevation, a line or a surface");
  for (std::size_t i = 1; i < water.line.size(); ++i)
    if (!(water.line[i - 1][0] < water.line[i][0]))
      throw Error("solve", "line of the water table", shortest(water.line[i][0]) + " m", "x that rises");
  const Particles& particles = model.particles;
  for (const Vec3& x : current_positions(particles))
    if (!std::isfinite(water_level(water, x)))
      throw Error("solve", "the water table has no value over a particle at",
                  "(" + shortest(x[0]) + ", " + shortest(x[1]) + ", " + shortest(x[2]) + ") m, local",
                  "a surface over all bodies");
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/estimate.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/check_model.hpp"
#include "solver/core/current_wave_speed.hpp"
#include "solver/core/grid_contact.hpp"
#include "solver/core/history.hpp"
#include "solver/core/output_clock.hpp"
#include "solver/core/reference_grid.hpp"
#include "solver/core/updated_conditions.hpp"
#include "solver/materials/law.hpp"

namespace scarp {
namespace {

double bytes_per_particle(const Particles& particles) {
  double bytes = sizeof(Vec3);  // ReferenceGrid::xi
  for_each_field(particles, [&](const char*, const char*, const auto& values, const auto&) {
    bytes += sizeof(typename std::decay_t<decltype(values)>::value_type);
  });
  return bytes;
}

/// The arrays of ReferenceGrid and TotalBody.
double grid_bytes(const GridCounts& counts, int corners) {
  const double per_slot = 2 * sizeof(std::uint32_t) + sizeof(Vec3);
  const double per_cell = sizeof(LatticeIndex) + sizeof(std::size_t) + corners * per_slot;
  const double per_node = sizeof(LatticeIndex) + sizeof(std::uint32_t) + 1 + 2 * sizeof(double) + 2 * sizeof(Vec3);
  return counts.cells * per_cell + counts.nodes * per_node;
}

std::vector<PreparedLaw> prepare_all(const Model& model, double cell) {
  std::vector<PreparedLaw> laws;
  for (const NamedMaterial& material : model.materials) laws.push_back(prepare(material.law, cell));
  return laws;
}

double fastest_wave_per_cell(const Model& model, const Body& body) {
  const std::vector<PreparedLaw> laws = prepare_all(model, body.lattice.cell);
  double c2 = 0;
  for (std::size_t p = body.begin; p < body.end; ++p) {
    const Mat3& F = model.particles.deformation_gradient[p];
    std::visit(
        [&](const auto& law) {
          const PointHistory history = load_history<std::decay_t<decltype(law)>>(model.particles, p);
          c2 = std::max(c2, law.wave_speed_squared(make_motion(F, F), history));
        },
        laws[model.particles.material[p]]);
  }
  return std::sqrt(c2) / body.lattice.cell;
}

/// (c + |v|) / cell in the current configuration.
double fastest_signal_per_cell(const Model& model, const UpdatedGrid& grid) {
  const std::vector<PreparedLaw> laws = prepare_all(model, grid.cell);
  double c2 = 0, speed = 0;
  for (std::uint32_t p : grid.particles) {
    const Mat3& F = model.particles.deformation_gradient[p];
    std::visit(
        [&](const auto& law) {
          const PointHistory history = load_history<std::decay_t<decltype(law)>>(model.particles, p);
          c2 = std::max(c2, current_wave_speed_squared(law, make_motion(F, F), history));
        },
        laws[model.particles.material[p]]);
    speed = std::max(speed, norm(model.particles.velocity[p]));
  }
  return (std::sqrt(c2) + speed) / grid.cell;
}

}  // namespace

RunEstimate estimate(const Model& model, const SolverOptions& options, const OutputOptions& output) {
  check_model(model);
  check_options(options, model.domain.dimension);
  check_options(output);
  check_formulations(model, options);
  check_contact(model, options);
  find_particle_forces(model);  // refuses loads
  RunEstimate result;
  const double count = static_cast<double>(model.particles.size());
  result.memory_bytes = count * bytes_per_particle(model.particles);
  double fastest = 0;
  for (const Body& body : model.bodies) {
    if (body.formulation != Formulation::total_lagrangian) continue;
    if (options.anti_locking == AntiLocking::f_bar)
      result.memory_bytes += static_cast<double>(body.end - body.begin) * sizeof(Mat3);  // TotalBody::since
    if (options.reference_update)
      result.memory_bytes += static_cast<double>(body.end - body.begin) * sizeof(Mat3);  // TotalBody::base
    if (options.transfer == Transfer::apic)
      result.memory_bytes += static_cast<double>(body.end - body.begin) * sizeof(Mat3);  // TotalBody::affine
    result.memory_bytes += grid_bytes(count_grid(model, body), 1 << body.lattice.dimension());
    fastest = std::max(fastest, fastest_wave_per_cell(model, body));
  }
  if (has_formulation(model, Formulation::updated_lagrangian)) {
    UpdatedGrid grid = make_updated_grid(model, options.shape, 1);
    if (options.anti_locking == AntiLocking::f_bar) average_volumes(grid);
    if (options.transfer == Transfer::apic) grid.affine.resize(model.particles.size());
    const UpdatedConditions conditions(model, grid, options.damping);  // refuses loads
    result.memory_bytes += memory_bytes(grid);
    if (grid.fields.size() > 1) result.memory_bytes += GridContact(model, grid).memory_bytes();  // refuses pairs
    fastest = std::max(fastest, fastest_signal_per_cell(model, grid));
  }
  result.time_step = options.courant / fastest;
  // Between two due times the steps are cut to a whole number.
  const double interval = std::min(
      {frame_interval(output, options.end_time), history_interval(output, options.end_time), options.end_time});
  result.steps = std::ceil(options.end_time / interval) * std::ceil(interval / result.time_step);
  result.particle_steps = result.steps * count;
  return result;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/estimate.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/check_model.hpp"
#include "solver/core/current_wave_speed.hpp"
#include "solver/core/grid_contact.hpp"
#include "solver/core/history.hpp"
#include "solver/core/law_kernels.hpp"
#include "solver/core/output_clock.hpp"
#include "solver/core/reference_grid.hpp"
#include "solver/core/updated_conditions.hpp"
#include "solver/materials/law.hpp"
#include "solver/model/particle_states.hpp"

namespace scarp {
namespace {

double bytes_of_constants() {
  double bytes = 0;
  for_each_constant([&](const char*, const char*, auto, const auto& initial) { bytes += sizeof(initial); });
  return bytes;
}

double bytes_of_state() {
  double bytes = 0;
  for_each_of_state([&](const char*, const char*, auto, const auto& initial) { bytes += sizeof(initial); });
  return bytes;
}

/// Whether nothing keeps the model's particles from having no state while a run goes on; see run.hpp.
bool stays_nodal(const Model& model, const SolverOptions& options) {
  const auto kernels = kernels_of(model);
  return options.back_end == BackEnd::nodal && !options.reference_update && options.transfer == Transfer::flip &&
         !options.relax && !options.k0 && !model.water && !has_formulation(model, Formulation::updated_lagrangian) &&
         !has_formulation(model, Formulation::rigid) &&
         std::all_of(kernels.begin(), kernels.end(), [](const auto& kernel) { return kernel.has_value(); });
}

/// The layout and the arrays of NodalBody.
double nodal_bytes(const Model& model, const GridCounts& counts, std::size_t particles) {
  const double fields = 16 * sizeof(double) + sizeof(std::uint32_t), slot = sizeof(std::uint32_t);
  int history = 0;
  for (const auto& kernel : kernels_of(model))
    history = std::max(history, kernels::history_fields(kernel->kind, model.domain.dimension));
  const double per_cell = 2 * sizeof(double) + (sizeof(kernels::Segment) + 12.0) / kernels::kSegment;
  return counts.nodes * fields + counts.cells * per_cell +
         static_cast<double>(particles) * (slot + history * sizeof(double));
}

/// The arrays of ReferenceGrid and TotalBody.
double grid_bytes(const GridCounts& counts, int corners, std::size_t particles) {
  const double per_slot = 2 * sizeof(std::uint32_t) + sizeof(Vec3);
  const double per_cell = sizeof(LatticeIndex) + sizeof(std::size_t) + corners * per_slot;
  const double per_node = sizeof(LatticeIndex) + sizeof(std::uint32_t) + 1 + 2 * sizeof(double) + 2 * sizeof(Vec3);
  return counts.cells * per_cell + counts.nodes * per_node + static_cast<double>(particles * sizeof(Vec3));  // xi
}

std::vector<PreparedLaw> prepare_all(const Model& model, double cell) {
  std::vector<PreparedLaw> laws;
  for (const NamedMaterial& material : model.materials) laws.push_back(prepare(material.law, cell));
  return laws;
}

double fastest_wave_per_cell(const Model& model, const Body& body) {
  const std::vector<PreparedLaw> laws = prepare_all(model, body.lattice.cell);
  const std::int32_t index = model.particles.body[body.begin];
  double c2 = 0;
  states_of(model.particles).each_block([&](const Particles& block) {
    for (std::size_t p = 0; p < block.size(); ++p) {
      if (block.body[p] != index) continue;
      const Mat3& F = block.deformation_gradient[p];
      std::visit(
          [&](const auto& law) {
            const PointHistory history = load_history<std::decay_t<decltype(law)>>(block, p);
            c2 = std::max(c2, law.wave_speed_squared(make_motion(F, F), history));
          },
          laws[block.material[p]]);
    }
  });
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
  check_rigid(model);
  find_particle_forces(model);  // refuses loads
  RunEstimate result;
  const double count = static_cast<double>(model.particles.size());
  const bool nodal = stays_nodal(model, options);
  result.memory_bytes = count * (bytes_of_constants() + (nodal ? 0 : bytes_of_state()));
  double fastest = 0;
  for (const Body& body : model.bodies) {
    if (body.formulation != Formulation::total_lagrangian) continue;
    fastest = std::max(fastest, fastest_wave_per_cell(model, body));
    const std::size_t particles = body.end - body.begin;
    const GridCounts counts = count_grid(model, body);
    if (nodal) {
      result.memory_bytes += nodal_bytes(model, counts, particles);
      continue;
    }
    if (options.anti_locking == AntiLocking::f_bar)
      result.memory_bytes += static_cast<double>(particles * sizeof(Mat3));  // TotalBody::since
    if (options.reference_update)
      result.memory_bytes += static_cast<double>(particles * sizeof(Mat3));  // TotalBody::base
    if (options.transfer == Transfer::apic)
      result.memory_bytes += static_cast<double>(particles * sizeof(Mat3));  // TotalBody::affine
    result.memory_bytes += grid_bytes(counts, 1 << body.lattice.dimension(), particles);
  }
  if (has_formulation(model, Formulation::updated_lagrangian)) {
    Model whole = model;
    complete_state(whole.particles);
    UpdatedGrid grid = make_updated_grid(whole, options.shape, 1);
    if (options.anti_locking == AntiLocking::f_bar) average_volumes(grid);
    if (options.transfer == Transfer::apic) grid.affine.resize(model.particles.size());
    const UpdatedConditions conditions(whole, grid, options.damping);  // refuses loads
    result.memory_bytes += memory_bytes(grid);
    if (grid.fields.size() > 1) result.memory_bytes += GridContact(whole, grid).memory_bytes();  // refuses pairs
    fastest = std::max(fastest, fastest_signal_per_cell(whole, grid));
  }
  // Between two due times the steps are cut to a whole number.
  const double interval = std::min(
      {frame_interval(output, options.end_time), history_interval(output, options.end_time), options.end_time});
  result.time_step = fastest > 0 ? options.courant / fastest : interval;
  result.steps = std::ceil(options.end_time / interval) * std::ceil(interval / result.time_step);
  result.particle_steps = result.steps * static_cast<double>(deforming_particles(model));
  return result;
}

}  // namespace scarp

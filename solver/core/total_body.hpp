// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/core/node_conditions.hpp"
#include "solver/core/reference_grid.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/materials/law.hpp"

namespace scarp {

/// A run of cells that one thread sweeps at a time. The list is fixed by the model alone.
struct CellTask {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::int32_t material = -1;  ///< of all its particles, or -1: some cell is mixed, look at each particle
  // What the last stress sweep found here:
  double largest_wave_speed_squared = 0;  ///< see StressOutcome
  std::int64_t bad_particle = -1;         ///< index of the first whose state is no longer valid, or -1
};

/// The state that a total-Lagrangian body has beside its particles. Everything is allocated before the first
/// step, and anew where the reference configuration moves.
struct TotalBody {
  std::size_t begin = 0;  ///< range in Model::particles
  std::size_t end = 0;
  ReferenceGrid grid;
  std::vector<CellTask> tasks;
  std::vector<PreparedLaw> laws;       ///< of Model::materials, for the size of this body's cells
  std::vector<std::uint8_t> held;      ///< per node, see held_axes
  std::vector<std::uint8_t> held_now;  ///< the same, and where faces hold the node since the last step
  NodeConditions conditions;
  std::vector<Vec3> node_positions;           ///< in the reference configuration, m
  std::vector<double> inverse_mass;           ///< 1 / m_I
  std::vector<Vec3> velocity;                 ///< v_I, of the momentum mapped last
  std::vector<Vec3> velocity_updated;         ///< v~_I
  std::vector<Vec3> displacement;             ///< per node: sum of dt v_I; with contact, else empty
  std::vector<Vec3> slots;                    ///< per cell and corner: momentum, then force
  std::vector<Vec3> water_slots;              ///< per cell and corner; empty without water
  std::vector<Mat3> affine;                   ///< C_p of apic.hpp, per particle; empty with another transfer
  std::vector<Vec3> filtered, term;           ///< v*_I of xpic.hpp and the term of it found last; empty likewise
  std::vector<std::uint8_t> kept;             ///< axes of xpic.hpp's conditions
  std::vector<Mat3> since;                    ///< per particle F as the nodes move it, with average_volumes; else empty
  const kernels::Kernels* kernels = nullptr;  ///< for sweeps over packs of particles; none: one by one, their oracle
  std::vector<std::optional<kernels::LawParameters>> law_parameters;  ///< of Model::materials, with kernels
  std::vector<Mat3> base;  ///< per particle F0, see moving_reference.hpp; empty before the first move
};

/// @param model  with particles sorted by cell
TotalBody make_total_body(const Model& model, const Body& body);
/// Without what only a body needs whose particles carry their state: their places, the nodes' velocities, the slots.
TotalBody make_bare_body(const Model& model, const Body& body);
void make_room_for_sweeps(TotalBody& total, const Model& model, const Body& body);
/// Lets its sweeps run on kernels, for what has any, where `widest` are some.
void use_kernels(TotalBody& total, const Model& model, const kernels::Kernels& widest);
/// On a grid of one's own.
TotalBody make_total_body(const Model& model, const Body& body, ReferenceGrid grid);

}  // namespace scarp

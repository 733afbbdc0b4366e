// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/core/contact_surface.hpp"
#include "solver/core/nodal_layout.hpp"
#include "solver/core/node_step.hpp"
#include "solver/core/stress.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/model/reports.hpp"

namespace scarp {

/// What a step asks of a body.
struct NodalStep {
  double time = 0;
  double dt = 0;
  Vec3 gravity{0, 0, 0};
  Vec3 missing_gravity{0, 0, 0};  ///< gravity less the steady one that counts as potential energy
  double flip = 1;
  bool find_speed = true;  ///< whether the outcome needs the wave speed; else it keeps the last one
};

/// A total-Lagrangian body in nodal form (solver/kernels/nodal.hpp): the particles are not touched by a step, and their
/// state is a function of the nodes', evaluated when someone asks. Exactly the method of the particle-state form
/// (transfer.hpp, stress.hpp), which is its oracle.
///
/// Nodes that something holds, drives or rubs are advanced one by one, through TotalBody::conditions; all others by the
/// kernels.
class NodalBody {
 public:
  /// Why this body cannot be in nodal form, or nothing if it can: a law without kernel, or a state at the start that is
  /// no function of nodes at rest.
  static std::optional<std::string> obstacle(const Model& model, const TotalBody& body, bool average);

  /// Takes what a body has per node of the nodes that something holds, drives or rubs, and forgets it of the others.
  /// @param body     made bare, with its loads set; must outlive this object
  /// @param average  F-bar, see averaged_stress.hpp
  NodalBody(const Model& model, TotalBody& body, bool average, const kernels::Kernels& kernels);

  /// Takes room for the fields of nodes and the histories, at first; by then a caller who needs the body's grid no more
  /// has forgotten it. Starts, or starts anew, from the velocities of `particles` and their reference positions: what W
  /// and A have gathered is forgotten, U and the history stay.
  void restart(const Particles& particles, int threads);

  /// Adds b_p per mass to the forces of the next step. Serial.
  /// @param acceleration  b_p, per particle of the model
  void add_body_force(const Particles& particles, const std::vector<Vec3>& acceleration);
  /// sum of m_p b_p . (x_p - X_p) for the b_p added last, J: what the step adds to it is their work. As displacements
  /// are those of the nodes, it is a sum over nodes.
  double body_force_times_displacement() const;

  /// See the calls of TotalLagrangian.
  void prepare_contact(ContactSurface& surface) const;
  void locate_contact(const ContactSurface& surface, const std::uint32_t* points, std::size_t count,
                      std::vector<Vec3>& y, std::vector<Vec3>* n) const;
  void anchor_contact(const ContactSurface& surface, std::vector<Vec3>& anchor) const;
  double contact_shift(const ContactSurface& surface, const std::vector<Vec3>& anchor) const;
  void push_contact(const ContactSurface& surface, const std::uint32_t* points, std::size_t count,
                    const std::vector<Vec3>& force);

  /// A whole step; what the nodes' conditions took and gave.
  NodeWork step(const NodalStep& step, int threads);
  /// Of the state after it.
  const StressOutcome& outcome() const { return outcome_; }

  /// Position, velocity, F, stress and history of the body's particles.
  void write(Particles& particles, int threads) const;
  /// The same of those among [begin, end) of the model's particles, which `block` holds.
  void write(Particles& block, std::size_t begin, std::size_t end, int threads) const;
  /// sum of m_I v_I^2 / 2, J.
  double kinetic_energy_of_nodes(int threads) const;
  /// Energies, momenta, and sum m (x - X) into the sample's centre; no particle is touched for it.
  /// @param about  point of the angular momentum, m
  HistorySample measure(const Vec3& gravity, const Vec3& about, int threads) const;
  /// The stiffest cell when speeds were last looked for, as it is now.
  StepLimit step_limit() const;

 private:
  void reserve_fields();
  void choose_special_nodes();
  Vec3 node_position(std::size_t node) const;
  void map_start_momentum(const Particles& particles);
  struct NodeSums {
    double of_change = 0, of_start = 0;
    Vec3 momentum{0, 0, 0}, angular{0, 0, 0}, displaced{0, 0, 0};
  };
  void add_motion(NodeSums& sums, std::size_t node, const Vec3& p, double mass, const Vec3& about) const;
  NodeSums measure_nodes(const Vec3& about, int threads) const;
  void fill_history();
  NodeWork advance_forces(const NodalStep& step, int threads);
  void sweep_momentum(int threads);
  void find_velocities(double dt, int threads);
  kernels::StressSweep stress_sweep_of(double* history, bool find_speed) const;
  void sweep_stress(bool find_speed, int threads);
  void add_shared_rows(int threads);
  double start_share() const { return moves_ ? share_ : 0; }
  std::int64_t find_bad_particle(std::size_t segment) const;
  /// Adds sum_p phi_Ip value(p), serially.
  void scatter(double* const (&field)[3], const std::function<Vec3(std::size_t)>& value) const;
  template <int D, class F>
  void scatter_segments(double* const (&field)[3], F&& value) const;
  void write_segment(Particles& block, std::size_t begin, std::size_t end, std::size_t segment) const;

  const Model& model_;
  TotalBody& body_;
  const kernels::Kernels& kernels_;
  const bool average_;  ///< F-bar, see averaged_stress.hpp
  NodalLayout layout_;
  std::vector<std::uint32_t> shared_groups_;  ///< begins in NodalLayout::shared
  std::vector<kernels::LawParameters> laws_;
  AlignedArray memory_;
  AlignedArray start_momentum_;  ///< P0, where any particle has a velocity at the start
  AlignedArray per_mass_;
  kernels::NodeArrays nodes_{};
  double* P0_[3] = {};
  AlignedArray history_;
  std::vector<std::uint32_t> special_;  ///< nodes that the kernels leave alone; to the conditions 0, 1, 2, ...
  std::vector<double> special_mass_;    ///< m_I of each
  std::vector<Vec3> special_momentum_;  ///< what has been mapped to each, before anything holds it
  AlignedArray body_force_[3];          ///< per node, N: sum of phi_Ip m_p b_p; empty without
  std::vector<Vec3> start_velocity_;    ///< per particle of the body; one where all are alike
  double start_square_ = 0;             ///< sum of m v(0)^2
  bool moves_ = false;                  ///< whether any particle had a velocity at the start
  double share_ = 1;                    ///< product of all FLIP shares
  StressOutcome outcome_;
  std::size_t stiffest_ = 0;  ///< segment, when speeds were last looked for
  std::vector<kernels::StressResult> slab_results_;
  std::vector<kernels::ForceResult> chunk_results_;
};

}  // namespace scarp

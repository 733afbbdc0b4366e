// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "solver/core/node_conditions.hpp"
#include "solver/core/updated_grid.hpp"

namespace scarp {

/// Faces, loads and damping on the grid of the updated-Lagrangian bodies, whose occupied nodes come and go: faces and
/// imposed motions belong to places in space, forces on particles go with them.
class UpdatedConditions {
 public:
  /// @throws Error ("solve"), see find_particle_forces, and where a motion is imposed on no node of the grid.
  /// @param rigid  bodies that carry nodes, or none; outlive this object
  UpdatedConditions(const Model& model, UpdatedGrid& grid, double damping, RigidBodies* rigid = nullptr);

  /// Finds the nodes of faces and imposed motions anew where other nodes are occupied than before, those of rigid
  /// bodies also where these have moved. What is imposed takes its axes over from `grid.held`.
  void follow(UpdatedGrid& grid);

  /// Sets mapped velocities to what the last step imposed, to zero where a start at rest holds faces still.
  /// Axes along which nodes do not move as their mass would have it, after act.
  void find_kept_axes(UpdatedGrid& grid) const {
    grid.kept = grid.held_now;
    conditions_.loads.add_imposed_axes(grid.kept);
    conditions_.rigid.add_axes(grid.kept);
  }
  void hold(UpdatedGrid& grid) const {
    conditions_.faces.hold(grid.velocity);
    conditions_.loads.hold(grid.velocity);
  }
  /// The same of velocities mapped after the step. (Those mapped before it are not rigid bodies' business: the change
  /// from them to theirs is what particles that come to be carried feel.)
  void hold_again(UpdatedGrid& grid) const {
    hold(grid);
    conditions_.rigid.hold(grid.velocity);
  }

  /// See act_on_nodes; `grid.velocity_updated` comes with internal forces, gravity and held axes done.
  /// @param ramp  how much of gravity holds, and so of the water's pressure
  NodeWork act(UpdatedGrid& grid, double time, double dt, const Vec3& missing_gravity, double ramp, int threads);

  /// A start at rest is sought, with this damping; then ended, while the particles still stand where they found it.
  void begin_relaxing(double damping);
  void rest(UpdatedGrid& grid);

 private:
  void find_faces(const UpdatedGrid& grid);
  void find_particle_forces_at(double time);
  void map_forces(UpdatedGrid& grid, double ramp, int threads);

  const Model& model_;
  NodeConditions conditions_;
  double damping_;
  bool acting_faces_;                  ///< some face has friction or dashpots
  std::uint64_t followed_ = 0;         ///< UpdatedGrid::placings
  std::vector<Vec2> material_speeds_;  ///< c_p and c_s; empty where no face is absorbing
  std::map<std::tuple<std::size_t, std::size_t, int>, Vec3> supports_;  ///< by field, node of the lattice and side, N
  std::vector<ParticleForces> loads_;
  RigidBodies* rigid_;
  std::vector<Vec3> places_;                ///< of the nodes, where there are rigid bodies
  std::vector<std::size_t> lattice_nodes_;  ///< and which of the lattice they are
  std::vector<Vec3> particle_force_;        ///< per particle of the model, N; empty where none is loaded
};

}  // namespace scarp

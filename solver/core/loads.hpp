// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/core/node_step.hpp"
#include "solver/model/model.hpp"

namespace scarp {

/// Rows (time, factor): linear between rows, constant beyond the first and the last; 1 without rows.
double factor_at(const std::vector<Vec2>& table, double time);

/// What a load gives to particles: forces at factor 1, N.
struct ParticleForces {
  std::vector<Vec2> table;
  std::vector<std::uint32_t> particles;  ///< index into Model::particles, ascending
  std::vector<Vec3> forces;
};

/// Tractions and forces of Model::loads. A surface particle takes traction * V0^((D-1)/D), the face of the cube (2D:
/// the side of the square) of its volume: exact for a flat face along the lattice that is one particle deep in the
/// region. A force is shared in proportion to mass.
/// @throws Error ("solve") where a load is none of the three kinds, or its region holds no particle to act on.
std::vector<ParticleForces> find_particle_forces(const Model& model);

/// The loads on the nodes of one grid.
class NodeLoads {
 public:
  /// Nodes in the region of a velocity have it imposed.
  /// @param positions  of the nodes, m, in the reference configuration
  /// @param held       per node the axes held for good: a velocity takes its axes over
  /// @return whether any node is in the region of a velocity of that load, per load
  std::vector<bool> impose_velocities(const Model& model, const std::vector<Vec3>& positions,
                                      std::vector<std::uint8_t>& held);
  /// Forces at factor 1, per node, N. Along held axes they are not counted.
  void add_forces(const std::vector<Vec2>& table, const std::vector<Vec3>& node_forces,
                  const std::vector<std::uint8_t>& held);

  bool empty() const { return forces_.empty() && velocities_.empty(); }
  /// While true, forces are those at t = 0 and imposed velocities are zero.
  void hold_still(bool still) { still_ = still; }
  void push(const NodeStep& step) const;
  /// Work of push, once `after` is final, J.
  double work_of_push(const NodeStep& step) const;
  /// Sets `after`; the work that it takes, J.
  double drive(const NodeStep& step) const;
  /// Sets mapped velocities to those imposed at `time`.
  void hold(std::vector<Vec3>& velocity, double time) const;

 private:
  struct Forces {
    std::vector<Vec2> table;
    std::vector<std::uint32_t> nodes;
    std::vector<Vec3> forces;
  };
  struct Velocity {
    std::vector<Vec2> table;
    Vec3 velocity{0, 0, 0};
    std::uint8_t axes = 0;  ///< bits
    std::vector<std::uint32_t> nodes;
  };
  /// Of the middle of the step.
  double force_factor(const Forces& load, const NodeStep& step) const {
    return factor_at(load.table, still_ ? 0 : step.time + 0.5 * step.dt);
  }
  Vec3 velocity_at(const Velocity& imposed, double time) const {
    return (still_ ? 0 : factor_at(imposed.table, time)) * imposed.velocity;
  }

  bool still_ = false;
  std::vector<Forces> forces_;
  std::vector<Velocity> velocities_;
};

}  // namespace scarp

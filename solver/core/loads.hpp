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
/// Its integral from time 0 on, s.
double integral_of_factor(const std::vector<Vec2>& table, double time);
/// @throws Error ("solve") where a row is not finite or times do not rise.
void check_table(const std::vector<Vec2>& table, const std::string& of);

/// Whether the reference position X of particle p, or a node there, is in the region. Particles stand on a face of the
/// domain where it is the border of their share of the volume.
bool particle_in(const LoadRegion& region, const Model& model, std::size_t p);
/// @param body  whose node it is; -1: nobody's own
bool node_in(const LoadRegion& region, const Model& model, const Vec3& x, std::int32_t body);

/// What a load gives to particles: forces at factor 1, N.
struct ParticleForces {
  std::vector<Vec2> table;
  std::vector<std::uint32_t> particles;  ///< index into Model::particles, ascending
  std::vector<Vec3> forces;
};

/// Tractions and forces of Model::loads. A surface particle takes traction * V0^((D-1)/D), the face of the cube (2D:
/// the side of the square) of its volume: exact for a flat face along the lattice that is one particle deep in the
/// region. A force is shared in proportion to mass.
/// @throws Error ("solve") where a load is none of the four kinds, or its region holds no particle to act on.
std::vector<ParticleForces> find_particle_forces(const Model& model);

/// The loads on the nodes of one grid.
class NodeLoads {
 public:
  /// Nodes in the region of a velocity or displacement have it imposed. Again, where the nodes are others now.
  /// @param positions  of the nodes, m, in the reference configuration
  /// @param body       whose nodes they are; -1: nobody's own
  /// @param held       per node the axes held for good: what is imposed takes its axes over
  /// @return whether any node is in the region of what a load imposes, per load
  std::vector<bool> impose(const Model& model, const std::vector<Vec3>& positions, std::int32_t body,
                           std::vector<std::uint8_t>& held);
  /// Forces at factor 1, per node, N. Along held axes they are not counted.
  void add_forces(const std::vector<Vec2>& table, const std::vector<Vec3>& node_forces,
                  const std::vector<std::uint8_t>& held);
  /// Forces of the step to come, N, one per node, for whoever finds them anew in each step; none along held axes.
  /// Empty: none.
  std::vector<Vec3> present;

  /// Sets the entries of its nodes.
  void mark(std::vector<bool>& touched) const {
    for (const Forces& load : forces_)
      for (std::uint32_t i : load.nodes) touched[i] = true;
    for (const Imposed& imposed : imposed_)
      for (std::uint32_t i : imposed.nodes) touched[i] = true;
  }

  /// Gives them new numbers: place[node].
  void renumber(const std::vector<std::uint32_t>& place) {
    for (Forces& load : forces_)
      for (std::uint32_t& i : load.nodes) i = place[i];
    for (Imposed& imposed : imposed_)
      for (std::uint32_t& i : imposed.nodes) i = place[i];
  }

  bool empty() const { return forces_.empty() && imposed_.empty() && present.empty(); }
  /// While true, forces in time are those at t = 0 and what is imposed stands still.
  void hold_still(bool still);
  /// The time at which forces count in a step: its middle.
  double time_of_forces(double time, double dt) const { return still_ ? 0 : time + 0.5 * dt; }

  /// Finds what is imposed during the step: the velocity at its end, or the mean one that meets the displacement there.
  void begin(const NodeStep& step);
  void push(const NodeStep& step) const;
  /// Work of push, once `after` is final, J.
  double work_of_push(const NodeStep& step) const;
  /// Sets `after`; the work that it takes, J.
  double drive(const NodeStep& step) const;
  /// Adds the axes that it imposes, bit 0 for x, to those of the nodes.
  void add_imposed_axes(std::vector<std::uint8_t>& axes) const;
  /// Sets mapped velocities to what the last step imposed; before the first step does nothing.
  void hold(std::vector<Vec3>& velocity) const;

 private:
  struct Forces {
    std::vector<Vec2> table;
    std::vector<std::uint32_t> nodes;
    std::vector<Vec3> forces;
  };
  struct Imposed {
    std::vector<Vec2> table;
    Vec3 amount{0, 0, 0};  ///< at factor 1: m/s, or m
    bool displacement = false;
    std::uint8_t axes = 0;  ///< bits
    std::vector<std::uint32_t> nodes;
    Vec3 now{0, 0, 0};  ///< of the step begun last, m/s
  };
  template <class F>
  void each_force(const NodeStep& step, F&& f) const;
  static void set(Vec3& velocity, const Imposed& imposed) {
    for (int a = 0; a < 3; ++a)
      if (imposed.axes >> a & 1) velocity[a] = imposed.now[a];
  }

  bool still_ = false, begun_ = false;
  std::vector<Forces> forces_;
  std::vector<Imposed> imposed_;  ///< in the order of the loads that impose something
};

}  // namespace scarp

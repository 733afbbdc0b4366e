// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/core/node_step.hpp"
#include "solver/model/domain.hpp"

namespace scarp {

/// The domain's faces with friction and dashpots, for the nodes of one grid. (What holds nodes for good stands in
/// held_axes.) Knows nothing of bodies or formulations.
///
/// Friction. A node presses where its velocity points out of the domain. It is then stopped along the normal, and
/// the normal impulse p allows a tangential one of mu p: where that is enough the node sticks, else it slides. Nodes
/// are never pulled: they leave freely. Where nodes are carried by the material (total Lagrangian) the gap that opens
/// is kept, and the face acts again once it has closed.
///
/// Absorbing. Dashpots rho c_p A along the normal and rho c_s A across it (Lysmer and Kuhlemeyer 1969), A the area of
/// the face that belongs to the node. A node's mass is that of a part d of a cell below this area, m_I = rho A d h, so
/// that the dashpots are rates r = c / (d h) per mass, whatever the grid is filled with. They are taken at the end of
/// the step: v~ <- v~ / (1 + dt r), which is stable for any step. A dashpot bears no load at rest: see hold_still.
///
/// A wave of velocity v_in that comes through an absorbing face pushes its nodes with 2 rho c A v_in (Joyner and Chen
/// 1975), so that a free surface above moves with 2 v_in and what it sends back leaves.
class NodeFaces {
 public:
  NodeFaces() = default;

  /// @param positions    of the nodes, m; a node on or outside a face (within 1e-6 cell) belongs to it
  /// @param held         per node the axes that are held at zero for good, as of held_axes
  /// @param wave_speeds  per node c_p and c_s, m/s; empty will do where no face is absorbing
  /// @param carried      whether nodes move with the material
  /// @param mass_depth   d of the shape functions, in cells
  /// @throws Error ("solve") where a coefficient of friction is not 0 or above.
  NodeFaces(const Domain& domain, double cell, const std::vector<Vec3>& positions,
            const std::vector<std::uint8_t>& held, const std::vector<Vec2>& wave_speeds, bool carried,
            double mass_depth = 0.5);

  /// Sets the entries of its nodes.
  void mark(std::vector<bool>& touched) const {
    for (const FaceNode& face : nodes_) touched[face.node] = true;
  }

  /// Gives its nodes new numbers: place[node].
  void renumber(const std::vector<std::uint32_t>& place) {
    for (FaceNode& face : nodes_) face.node = place[face.node];
  }

  /// Whether no node has friction or dashpots.
  bool empty() const { return nodes_.empty(); }

  /// Lets the faces act on `step.after`. `held_now` (count entries) becomes, for the nodes of these faces, the axes
  /// along which they are at rest on the face: along these the next mapped velocity is zero too.
  NodeWork act(const NodeStep& step, std::vector<std::uint8_t>& held_now);

  /// Adds the loads that hold_still has left to `step.after`: forces like others, before all else.
  void push(const NodeStep& step) const;
  /// Work of push, once `after` is final, J.
  double work_of_push(const NodeStep& step) const;

  /// While true, absorbing faces hold their nodes like `fixed`, as long as a start at rest is sought. When set back
  /// to false the force that this took last stays as a load, so that what was at rest stays so.
  void hold_still(bool still) { still_ = still; }

  /// Zero mapped velocities where faces hold still.
  void hold(std::vector<Vec3>& velocity) const {
    if (!still_) return;
    for (const FaceNode& face : nodes_)
      if (face.absorbing) velocity[face.node] = {0, 0, 0};
  }

  /// v_in of the wave that comes through an absorbing face during the next steps, m/s; each axis on its own.
  /// @param side  in the order of Domain::faces
  void send_in(int side, const Vec3& velocity) { incoming_[side] = velocity; }

  /// What `other`, the same faces of other nodes, was told: to hold still, and of waves.
  void take_over(const NodeFaces& other) {
    still_ = other.still_;
    incoming_ = other.incoming_;
  }

  /// f(node, side, load) of absorbing faces: what hold_still has left, N, to be kept where nodes are numbered anew.
  template <class F>
  void each_support(F&& f) {
    for (FaceNode& face : nodes_)
      if (face.absorbing) f(face.node, face.side(), face.support);
  }

 private:
  struct FaceNode {
    std::uint32_t node = 0;
    std::uint8_t axis = 0;
    std::uint8_t held = 0;
    double inward = 1;  ///< along the axis: 1 on a lower face, -1 on an upper one
    bool absorbing = false;
    double friction = 0;
    Vec3 rate{0, 0, 0};     ///< of the dashpots, 1/s
    double gap = 0;         ///< m
    Vec3 support{0, 0, 0};  ///< N; none along held axes
    int side() const { return 2 * axis + (inward < 0 ? 1 : 0); }
  };
  double rub(FaceNode& face, const NodeStep& step, std::uint8_t& held_now) const;
  void absorb(FaceNode& face, const NodeStep& step, std::uint8_t& held_now, NodeWork& work) const;

  std::vector<FaceNode> nodes_;
  std::array<Vec3, 6> incoming_{};
  bool carried_ = false;
  bool still_ = false;
};

}  // namespace scarp

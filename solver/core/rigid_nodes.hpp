// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/core/node_step.hpp"
#include "solver/core/rigid_bodies.hpp"

namespace scarp {

/// Nodes of one grid that rigid bodies carry: they are given the body's velocity (Dirichlet's condition; rigid
/// particles in MPM) or, by a surface that is not rough, are kept from going into it and slide over it after Coulomb
/// (Bardenhagen, Brackbill, Sulsky 2000, with a body of infinite mass).
///
/// On a grid that stands in space these are the nodes inside a body and those within half a cell of it. Of the two ends
/// of an edge that crosses its surface one is always among them, so that a body thinner than a cell lets nothing
/// through; and where its surface lies between nodes it acts, on the mean, where it is. A node inside such a thin body
/// does not know from which side material comes: along the normal it moves with the body, both ways.
///
/// Work. The body's impulse on a node times its own velocity is what those give who move it: `external`. What the
/// node's energy does not get of it is lost by impact and friction.
class RigidNodes {
 public:
  bool empty() const { return nodes_.empty(); }
  /// Sets the entries of its nodes.
  void mark(std::vector<bool>& touched) const {
    for (const Node& node : nodes_) touched[node.node] = true;
  }

  /// Of a grid in space, with the bodies as they stand now.
  /// @param keys  which node of the lattice each place is, 0 and up: what bodies that are fixed do to it is found once
  ///              and kept. Empty: nothing is kept.
  void find(RigidBodies& bodies, const std::vector<Vec3>& places, double cell,
            const std::vector<std::size_t>& keys = {});
  /// Of a body's own grid: the nodes that lie in body `rigid` at the start, for good.
  /// @return how many
  std::size_t grip(RigidBodies& bodies, std::size_t rigid, const std::vector<Vec3>& places, double cell);

  /// Gives its nodes other numbers: place[i] for i.
  void renumber(const std::vector<std::uint32_t>& place) {
    for (Node& node : nodes_) node.node = place[node.node];
  }

  /// Finds how the bodies, which have taken the step already, move in it.
  void begin(const NodeStep& step);
  /// Lets them act on `step.after`; may be called again where something else has acted since.
  NodeWork act(const NodeStep& step);
  /// Sets velocities mapped after the step to what act has found; before it does nothing.
  void hold(std::vector<Vec3>& velocity) const;
  /// Adds the axes along which nodes had no will of their own.
  void add_axes(std::vector<std::uint8_t>& axes) const;

 private:
  struct Node {
    std::uint32_t node = 0;
    std::uint32_t rigid = 0;
    Vec3 x{0, 0, 0};  ///< m; of a gripped node in the reference configuration
    Vec3 n{0, 0, 0};  ///< out of the body
    bool gripped = false, thin = false;
    RigidSurface surface;
    Vec3 before{0, 0, 0}, after{0, 0, 0};  ///< velocity of the body there at both ends of the step, m/s
    bool pressed = false, stuck = false;   ///< in the step
  };
  /// Entries that are kept for a node of the lattice: a range in kept_.
  struct Kept {
    std::uint32_t begin = 0, end = 0;
    bool known = false;
  };
  static void rub(Node& node, Vec3& velocity);
  void find_at(std::uint32_t i, std::uint32_t rigid, const Vec3& x, double cell, std::vector<Node>& nodes) const;

  RigidBodies* bodies_ = nullptr;
  std::vector<Node> nodes_;
  std::vector<Kept> kept_at_;  ///< per node of the lattice
  std::vector<Node> kept_;     ///< of fixed bodies
};

}  // namespace scarp

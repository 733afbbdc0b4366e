// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/core/loads.hpp"
#include "solver/core/node_faces.hpp"
#include "solver/core/rigid_nodes.hpp"

namespace scarp {

/// What acts on the nodes of one grid beside internal forces, gravity and the axes held for good.
struct NodeConditions {
  NodeFaces faces;
  NodeLoads loads;
  RigidNodes rigid;
  double damping = 0;  ///< Cundall's local factor, 0 to 1
};

/// Cundall's local damping: the out-of-balance force f of a node is changed, component by component, by
/// -factor |f| sign(v), which slows what moves and leaves what rests. Bodies in free flight are slowed too.
/// The energy lost, J.
double damp_nodes(const NodeStep& step, double factor, int threads);

/// All conditions, in order: forces, damping, faces; imposed velocities and rigid bodies first and last. `step.after`
/// comes with internal forces, gravity and held axes done. The velocities mapped next are the business of
/// NodeLoads::hold and RigidNodes::hold.
/// @param held_now         see NodeFaces::act
/// @param missing_gravity  gravity of this step less the steady one that counts as potential energy, m/s2
NodeWork act_on_nodes(NodeConditions& conditions, const NodeStep& step, std::vector<std::uint8_t>& held_now,
                      const Vec3& missing_gravity, int threads);

}  // namespace scarp

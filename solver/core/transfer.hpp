// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sweeps between particles and grid, equations of method.md 1.1. Cell sweeps fill TotalBody::slots, node
// sweeps add them up; each call is one parallel loop and allocates nothing.
#pragma once

#include "solver/core/total_body.hpp"
#include "solver/core/velocity_update.hpp"

namespace scarp {

/// (1) Slots <- sum_p phi_Ip m_p v_p.
void map_momentum(const Particles& particles, TotalBody& body, int threads);

/// (1), (2), (5) v_I = (m v)_I / m_I from the slots, zero along held axes.
void find_node_velocities(TotalBody& body, int threads);

/// (2) v~_I = v_I + dt (f_I / m_I + gravity) from the slots, zero along held axes.
/// Gravity needs no map: sum_p phi_Ip m_p g = m_I g.
void advance_nodes(TotalBody& body, const Vec3& gravity, double dt, int threads);

/// (3) v_p after `update`, x_p <- x_p + dt sum phi v~_I whatever the transfer; and of the new v_p (1), (5): slots <-
/// sum_p phi_Ip m_p v_p. The weights never change, so the second map of this step is also the first of the next.
void advance_particles(Particles& particles, TotalBody& body, VelocityUpdate update, double dt, int threads);

/// What the kernels see of particles and grid.
kernels::CellSweep cell_sweep(Particles& particles, TotalBody& body, VelocityUpdate update, double dt);

}  // namespace scarp

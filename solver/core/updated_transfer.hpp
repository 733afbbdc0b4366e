// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sweeps between particles and the grid of updated-Lagrangian bodies, equations of method.md 1.1 with
// phi_Ip = phi_I(x_p) at the beginning of the step. Particle sweeps fill the tiles of blocks, which are
// added to UpdatedGrid::sums.
#pragma once

#include "solver/core/updated_grid.hpp"
#include "solver/core/velocity_update.hpp"

namespace scarp {

/// (1) UpdatedGrid::sums <- sum_p of phi_Ip m_p, phi_Ip m_p v_p and - V_p sigma_p grad phi_Ip.
void map_to_nodes(Particles& particles, UpdatedGrid& grid, int threads);

/// (1) The sums' forces only, for stresses that have changed since.
void map_forces(const Particles& particles, UpdatedGrid& grid, int threads);

/// (1) Adds sum_p of phi_Ip f_p to the sums' forces.
/// @param force  per particle of the model, N
void add_particle_forces(UpdatedGrid& grid, const std::vector<Vec3>& force, int threads);

/// (1), (2), (5) m_I and v_I = (m v)_I / m_I from the sums, zero along held axes.
void find_node_velocities(UpdatedGrid& grid, int threads);

/// (2) v~_I = v_I + dt (f_I / m_I + gravity) from the sums, zero along held axes. No force is left out however small
/// m_I is: times phi_Ip it is bounded, and the particles get all of the momentum.
void advance_nodes(UpdatedGrid& grid, const Vec3& gravity, double dt, int threads);

/// (3) v_p after `update`, x_p <- x_p + dt sum phi v~_I whatever the transfer, and the sums' momenta <- sum phi_Ip m_p
/// v_p of the new v_p, with the weights of the old x_p.
/// @return the largest |v_p|, m/s
double advance_particles(Particles& particles, UpdatedGrid& grid, VelocityUpdate update, double dt, int threads);

/// (5) in the USL order: v_I <- v~_I for the velocity gradient, but at nodes lighter than UpdatedGrid::light_mass,
/// where f_I / m_I without a weight means nothing.
void take_updated_velocities(UpdatedGrid& grid, int threads);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stress sweep of total-Lagrangian bodies whose particles see the mean volume ratio of their cell (F-bar), against
// volumetric locking: a cell of linear functions has 2^D corners to meet one condition of constant volume per particle.
//
//   F_p     = as the nodes move it, compatible with them
//   J_c     = sum_p V0 det F_p / sum_p V0                        the cell's mean
//   F-bar_p = (J_c / det F_p)^(1/D) F_p                          what the law sees; 2D: of the components in the plane
//   force   = - sum_p V0 [J_c (sigma_p - s_p I) + det F_p s_c I] F_p^-T grad0 phi_Ip
//
// with s_p the mean of sigma_p's D normal components and s_c = sum_p V0 s_p / sum_p V0. This is the derivative of
// sum_p V0 W(F-bar_p) (mean dilatation: Nagtegaal, Parks, Rice 1974; Simo, Taylor, Pister 1985), so that the work of
// the forces is the energy and the plastic work that the laws count, for any law; de Souza Neto, Peric, Dutko, Owen
// 1996 take the same F-bar without the averaged s_c, and their forces are no derivative. Forces of a cell sum to
// nothing: momentum is conserved. Where J is uniform in a cell nothing changes.
#pragma once

#include "solver/core/stress.hpp"

namespace scarp {

/// From now on the body's laws see F-bar. Before the first sweep.
void average_volumes(TotalBody& body, const Particles& particles);

/// update_stress of bodies that keep TotalBody::since; particles hold F-bar.
StressOutcome update_averaged_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws,
                                     double dt, int threads);

/// map_stress of such bodies.
StressOutcome map_averaged_stress(Particles& particles, TotalBody& body, const std::vector<PreparedLaw>& laws,
                                  int threads);

}  // namespace scarp

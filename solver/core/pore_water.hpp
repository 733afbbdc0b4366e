// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/model.hpp"
#include "solver/model/solver_options.hpp"

namespace scarp {

/// Pore pressure as a given field, u = gamma_w (h(x) - z) below the table h and none above it (no suction). It belongs
/// to space: a particle has that of where it is now. Laws see the effective stress, and the momentum balance is that of
/// the total stress sigma' - u I: each volume of ground under water gets the force - grad u = gamma_w (- grad h, 1)
/// beside the weight of its grains and its water. Where the table stands above the ground the free water presses on its
/// surface with u; that traction is in this force, since by the divergence theorem both leave - grad u alone. Elsewhere
/// the table must not cut a dry surface: u there would need a traction that nothing gives.
///
/// Weights: below the table of the start a particle has its material's saturated density, above it the density; it
/// keeps its mass, as water that drains or enters takes longer than a slide.

/// Elevation of the table at x, m; NaN where a raster has no value. Beyond its ends it goes on level.
double water_level(const WaterTable& water, const Vec3& x);

/// u at x, Pa.
double pore_pressure(const WaterTable& water, const Vec3& x, int dimension);

/// Share of a particle at x, a cube of this edge, that is under water.
double submerged_share(const WaterTable& water, const Vec3& x, double edge, int dimension);

/// - grad u over the particle's current volume below the table, N.
Vec3 water_force(const WaterTable& water, const Particles& particles, std::size_t p, int dimension);

/// Gives particles the mass that they have below and above the table, where they stand. Does nothing without water.
void set_saturated_masses(Model& model);

/// @throws Error ("solve") where gravity does not point straight down, which depths need.
double vertical_gravity(const SolverOptions& options, int dimension, const char* who);

/// @throws Error ("solve") where the table has no value at a particle, or is not what it should be.
void check_water(const Model& model, const SolverOptions& options);

}  // namespace scarp

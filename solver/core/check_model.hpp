// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/model.hpp"
#include "solver/model/solver_options.hpp"

namespace scarp {

/// A model may come from a file: checks all that the solver relies on, so that no sweep has to.
/// @throws Error ("solve", "materials") naming body, particle and value.
void check_model(const Model& model);

/// @throws Error ("solve") where an option is outside what the schema states.
void check_options(const SolverOptions& options, int dimension);
void check_options(const OutputOptions& options);

/// @throws Error ("solve") where a total-Lagrangian body meets an update order or a shape that only updated-Lagrangian
///         bodies have, and where reference_update meets what cannot move with the grid.
void check_formulations(const Model& model, const SolverOptions& options);

/// @throws Error ("solve") where Model::contact names what is not there, or cannot be had with the bodies or options.
void check_contact(const Model& model, const SolverOptions& options);
/// @throws Error ("solve") where a rigid body has nothing that it could meet, or grips what is not there.
void check_rigid(const Model& model);
/// Whether rigid bodies carry nodes of the updated-Lagrangian bodies' grid.
bool rigid_bodies_carry(const Model& model);

bool has_formulation(const Model& model, Formulation formulation);
/// How many particles are not of rigid bodies.
std::size_t deforming_particles(const Model& model);

}  // namespace scarp

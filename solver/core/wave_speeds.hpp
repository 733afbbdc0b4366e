// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/core/reference_grid.hpp"

namespace scarp {

bool has_absorbing_face(const Domain& domain);

/// Per material, at rest: speed of compression waves c_p and of shear waves c_s, m/s; of a fluid, c_s = 0.
std::vector<Vec2> material_wave_speeds(const Model& model);

/// The same of particle p, whose mass may be that of saturated ground.
Vec2 wave_speeds_of(const Model& model, const std::vector<Vec2>& of_materials, std::size_t p);

/// The same at the nodes of a body's reference grid, weighted by phi_Ip m_p.
/// @param begin  the body's first particle
std::vector<Vec2> node_wave_speeds(const Model& model, const ReferenceGrid& grid, std::size_t begin);

}  // namespace scarp

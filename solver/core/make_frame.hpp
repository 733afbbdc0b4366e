// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/model/frame.hpp"
#include "solver/model/model.hpp"
#include "solver/model/output_field.hpp"

namespace scarp {

/// The model's particles as a frame: positions in double, and always id (int64), body, material (int32), surface
/// and colour (uint8; r, g, b) and volume (float, current, m3; plane strain: m3/m). The fields asked for are floats:
/// stress in the order xx, yy, zz, xy, yz, xz (Pa, tension positive), deformation_gradient row-major, volume_ratio J,
/// density in the current configuration, pore_pressure positive where there is a water table, whose stresses are
/// effective, von_mises_stress sqrt(3/2 s:s) with s the deviator. A field asked for twice comes once.
/// @param absolute  positions, displacements and velocities with the motion of a rigidly shaken base, see
/// Model::shaking
Frame make_frame(const Model& model, const std::vector<OutputField>& fields, double time, std::int64_t step,
                 bool absolute = false);
/// The same of a block of them.
Frame make_frame(const Model& model, const Particles& block, const std::vector<OutputField>& fields, double time,
                 std::int64_t step, bool absolute = false);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/frame.hpp"
#include "solver/model/point_cloud.hpp"

namespace scarp {

/// The part of a simulated body that a scanner could see: the particles whose uint8 field "surface" is 1, where they
/// are in this frame (local, m), in the frame's order. A body is a volume of points; held against a scan as a
/// whole, it would be off by its own depth. With a float field "displacement", its magnitude is the scalar
/// "displacement", m.
/// @throws Error when the frame lacks the field "surface", no particle has it, or a field does not fit the
/// particles.
PointCloud free_surface(const Frame& frame);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretize/solid.hpp"

namespace scarp {

/// The solid's surface for Body::boundary. Balls are faceted, within 0.2 % of `spacing` of their surface; other solids
/// are exact. None for terrain.
/// @param spacing  of the material points, m
TriangleMesh boundary_of(const Solid& solid, int dimension, double spacing);

}  // namespace scarp

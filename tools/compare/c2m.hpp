// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/compare_options.hpp"
#include "solver/model/mesh.hpp"
#include "tools/compare/comparison.hpp"

namespace scarp {

/// Cloud-to-mesh distance: of each simulated point to the nearest point of the observed triangles, positive on the side
/// to which their normals point (for the sign at edges and vertices see TriangleTree), and its split (dx, dy, dz) =
/// observed - simulated. All four are NaN beyond `max_distance`. "beyond_border" is 1 where the nearest point is on the
/// border of an open mesh, so that the point may have no counterpart.
/// @throws Error for an empty cloud, a position that is not finite, a max_distance that is not above zero; as
///   TriangleTree
Comparison compare_c2m(PointCloud simulated, const TriangleMesh& observed, const CompareOptions& options, int threads);

}  // namespace scarp

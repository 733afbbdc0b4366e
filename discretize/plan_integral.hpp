// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "discretize/plan_polygon.hpp"
#include "discretize/plane_geometry_cgal.hpp"
#include "solver/model/math.hpp"

namespace scarp {

/// What a TIN holds, over its plan or over the part of it inside an outline.
struct PlanIntegral {
  double area = 0;    ///< m2, in plan
  double volume = 0;  ///< m3, between the TIN and the floor or the other TIN
  Box3 bounds;        ///< of the surface there, or of both
};

/// Exact integrals of a TIN over an outline (the whole TIN without one). With a floor, only the part of the surface
/// above that elevation counts, and the volume is that between them; without one the volume is zero.
///
/// Each triangle is clipped at z = floor; triangles that the outline crosses are summed as signed trapezoids below
/// the outline's edges (the plane form of Green's theorem), which holds for any simple polygon.
PlanIntegral integrate_tin(const Tin& tin, const std::optional<PlanPolygon>& outline, std::optional<double> floor,
                           int threads);

/// The same between two TINs: of what lies over the base, under the top and inside the outline. Each pair of triangles
/// is clipped to what they share in plan and where the top one is above.
PlanIntegral integrate_between(const Tin& top, const Tin& base, const std::optional<PlanPolygon>& outline, int threads);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "discretize/columns.hpp"
#include "discretize/plan_polygon.hpp"
#include "solver/model/body_options.hpp"

namespace scarp {

/// Exact shapes. Boxes and polygons own their lower faces and not their upper ones, so that bodies that share a face
/// share no point; a ball owns what is nearer to its centre than the radius.
struct BoxSolid {
  double volume = 0;  ///< m3 (2D: m2)
  Box3 bounds;
};
struct BallSolid {
  Vec3 centre{};
  double radius = 0;
  double volume = 0;
  Box3 bounds;
};
struct PolygonSolid {
  PlanPolygon polygon;
  double volume = 0;  ///< m2
  Box3 bounds;
};

/// @throws Error ("discretize") naming the body where a shape has no size or is not for this dimension.
BoxSolid close_box(const BoxVolume& options, int dimension, const std::string& body);
BallSolid close_disk(const DiskVolume& options, int dimension, const std::string& body);
BallSolid close_sphere(const SphereVolume& options, int dimension, const std::string& body);
PolygonSolid close_polygon(const PolygonVolume& options, int dimension, const std::string& body);

/// Refuses a volume that exists in the other dimension only.
void need_dimension(int dimension, int needed, const char* volume, const std::string& body);

Columns fill(const BoxSolid& solid, const SubLattice& grid, int threads);
Columns fill(const BallSolid& solid, const SubLattice& grid, int threads);
Columns fill(const PolygonSolid& solid, const SubLattice& grid, int threads);

}  // namespace scarp

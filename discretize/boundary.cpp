// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretize/boundary.hpp"

namespace scarp {
namespace {

struct BoundaryOf {
  int dimension;
  double spacing;

  TriangleMesh operator()(const TerrainSolid&) const { return {}; }
  TriangleMesh operator()(const MeshSolid& solid) const { return solid.mesh; }
  TriangleMesh operator()(const BoxSolid& solid) const {
    const Vec3 &low = solid.bounds.min, &high = solid.bounds.max;
    return dimension == 3
               ? box_mesh(solid.bounds)
               : prism_mesh({{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}}, spacing);
  }
  TriangleMesh operator()(const BallSolid& solid) const {
    const double sagitta = 0.002 * spacing;
    return dimension == 3
               ? sphere_mesh(solid.centre, solid.radius, sagitta)
               : prism_mesh(circle_outline({solid.centre[0], solid.centre[1]}, solid.radius, sagitta), spacing);
  }
  TriangleMesh operator()(const PolygonSolid& solid) const { return prism_mesh(solid.polygon.corners(), spacing); }
};

}  // namespace

TriangleMesh boundary_of(const Solid& solid, int dimension, double spacing) {
  return std::visit(BoundaryOf{dimension, spacing}, solid);
}

}  // namespace scarp

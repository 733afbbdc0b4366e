// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solver/model/dod_options.hpp"
#include "solver/model/frame.hpp"
#include "solver/model/point_cloud.hpp"
#include "tools/compare/raster_grid.hpp"

namespace scarp {

/// The part of simulated bodies that a scanner could see. A body is a volume of points; held against a scan as a
/// whole, it would be off by its own depth.
struct FreeSurface {
  /// Points on the surface (local, m), in the order of the particles below them, with unit normals out of the body and
  /// the scalars "uncertainty" (m) and, of a frame with a float field "displacement", its magnitude "displacement" (m).
  /// Without volumes: the particles' centres, without normals and uncertainty.
  PointCloud cloud;
  double spacing = 0;         ///< spacing_of the frame, m; 0 without volumes
  std::size_t alone = 0;      ///< particles without enough material around them to have a surface; not in the cloud
  bool plane_strain = false;  ///< all particles in one plane
  std::string words;          ///< how the surface was found, for a report
  std::vector<std::string> warnings;
};

/// The free surface of the material points of a frame.
///
/// Looked at are particles that were marked as surface when the body was made (uint8 field "surface"), and those that
/// are topmost in plan in this frame, so that what a slide lays bare counts. Their normal is that of a plane through
/// their neighbours among these. Along it a column (SurfaceColumns) says where the surface is; who is deeper than a
/// spacing and a quarter below it is buried. Through the places found within 3 spacings a quadric is laid by least
/// squares; the surface point is where the column meets it, less what the kernel adds to a curved surface. Its
/// uncertainty is the larger of the root mean square of the places about the quadric and spacing / sqrt(12), the
/// standard deviation of a height that is only known to be within one layer.
///
/// A frame without the field "volume" gives the centres of the marked particles, half a spacing below the surface, and
/// a warning that says so. The same bits for any number of threads.
/// @throws Error when the frame lacks the field "surface", no particle is on the surface, or a field does not fit the
/// particles.
FreeSurface free_surface(const Frame& frame, int threads);

/// The surface as heights on a grid: in and around each cell's middle the mean of the tangent planes of the surface
/// points within 1.5 spacings in plan, weighted by a smooth kernel, of the uppermost sheet; cells larger than a spacing
/// take the mean (median, lowest, highest as the policy says; the height at the middle for a triangulation) of places
/// a spacing apart. No data farther than 1.25 spacings from any surface point.
struct SurfaceRaster {
  Heightfield field;
  std::vector<double> sigma;  ///< per cell, m: mean uncertainty of the points
};
/// @throws Error for a surface without normals, or in plane strain
SurfaceRaster surface_raster(const FreeSurface& surface, const RasterGrid& grid, CellPolicy policy, int threads);

}  // namespace scarp

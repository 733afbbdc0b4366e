// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From clouds, rasters and frames to two surfaces on the same cells.
#pragma once

#include <filesystem>
#include <optional>
#include <variant>

#include "solver/model/frame.hpp"
#include "solver/model/point_cloud.hpp"
#include "solver/model/scan_options.hpp"
#include "tools/compare/surface_comparison.hpp"

namespace scarp {

/// What a surface can come from.
using SurfaceSource = std::variant<PointCloud, Heightfield, Frame>;

/// Reads a frame (.hdf), a raster or a cloud. @throws Error for a file that is none, not in projected metres, or a
/// raster in another height unit than metres.
SurfaceSource read_surface_source(const std::filesystem::path& path, HeightUnit height_unit);

const SiteFrame& site_of(const SurfaceSource& source);

struct SurfaceSources {
  SurfaceSource simulated, observed;
  std::optional<SurfaceSource> before;       ///< ground before, or terrain
  std::optional<SurfaceSource> stable_mask;  ///< a raster
};

/// Brings everything to one origin and one grid: that of the observed raster, or of the simulated one where the
/// observed is none, or one of options.dod.cell; restricted to where both are. Rasters are resampled, points put into
/// cells by the policy, frames give their free surface. Positions in `options` (site coordinates) become local to the
/// pair. The same bits for any number of threads.
/// @throws Error where no cell is known or the two do not overlap
SurfacePair make_surface_pair(SurfaceSources sources, CompareOptions& options, int threads);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "solver/model/heightfield.hpp"
#include "solver/model/mesh.hpp"
#include "solver/model/model.hpp"
#include "solver/model/point_cloud.hpp"
#include "solver/model/scenario.hpp"

namespace scarp {

/// Everything in local coordinates (m minus site.origin), the scenario's positions too.
struct DiscretizeInput {
  const Scenario& scenario;
  const std::map<std::string, PointCloud>& scans;      ///< by the scan's name, cleaned
  const std::map<std::string, TriangleMesh>& meshes;   ///< by InputFile::path
  const std::map<std::string, Heightfield>& surfaces;  ///< by InputFile::path
  SiteFrame site;
  int threads = 1;
};

/// Turns the scenario's bodies into material points.
///
/// A body's points stand at the centres of sub-cells, n in each direction of a lattice cell (points_per_cell = n^2 in
/// 2D, n^3 in 3D), wherever that centre lies inside the volume: no bias in volume, unlike filling every cell that the
/// surface touches. Each has V0 = cell volume / points_per_cell and the mass that the density of its own material
/// gives. Points are ordered by cell (x fastest, then y, then z), within a cell by place (x fastest); `id` is the
/// place in that order over all bodies. The result has the same bits for any number of threads.
/// @throws Error ("discretize") for whatever of it the user must mend: a volume that does not close, a body outside a
/// given domain or without a single point, more than 2e9 points.
Model discretize(const DiscretizeInput& input);

}  // namespace scarp

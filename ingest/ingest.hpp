// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/point_cloud.hpp"
#include "solver/model/reports.hpp"
#include "solver/model/scan_options.hpp"

namespace scarp {

struct IngestResult {
  PointCloud cloud;  ///< local metres, finite, not empty
  IngestReport report;
};

/// From what a reader or the virtual scanner gave to a clean local cloud: drops points that are not finite, makes the
/// heights metres, subtracts `origin` (whole metres), and applies `options.clean` in its order.
///
/// `options` is local already: its crop boxes are relative to `origin`. The CRS of the result is that of the heights
/// in metres (see heights_to_metres). The same for any number of threads.
/// @throws Error when the cloud is empty, or becomes so: the message says at which step; and as
/// require_projected_metres, heights_to_metres, localize and the filters do.
IngestResult ingest(PointCloud raw, const ScanOptions& options, const Vec3& origin, int threads);

}  // namespace scarp

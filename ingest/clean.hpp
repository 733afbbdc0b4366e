// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/point_cloud.hpp"
#include "solver/model/reports.hpp"
#include "solver/model/scan_options.hpp"

namespace scarp {

/// Applies one cleaning step to a local cloud whose points are all finite. Points are dropped, never moved; those
/// kept stay in order and keep all attributes. A crop keeps its faces. The result may be empty. The same for any
/// number of threads.
/// @throws Error as the filter's own header says.
CleanReport clean(PointCloud& cloud, const CleanFilter& filter, int threads);

}  // namespace scarp

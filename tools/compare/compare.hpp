// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>

#include "solver/model/compare_options.hpp"
#include "solver/model/mesh.hpp"
#include "tools/compare/comparison.hpp"

namespace scarp {

/// One side of a comparison, as it was read.
using ComparedSide = std::variant<PointCloud, Heightfield, TriangleMesh>;

/// Holds `simulated` against `observed` by the method of the options. Differences are observed - simulated. The same
/// bits for any number of threads.
/// @param cores where m3c2 measures; nullptr: at the simulated points
/// @throws Error ("compare") where the method cannot take what a side is, or as the methods say.
Comparison compare(ComparedSide simulated, const ComparedSide& observed, const PointCloud* cores,
                   const CompareOptions& options, int threads);

}  // namespace scarp

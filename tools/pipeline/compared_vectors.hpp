// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the two sides of a comparison, and what its options name, to what displacement vectors are made of.
#pragma once

#include <variant>

#include "solver/model/scan_options.hpp"
#include "tools/compare/displacement.hpp"

namespace scarp {

/// A frame is a simulation; a cloud is the survey before, of which the second side is what it became. A second side
/// with fields dx, dy, dz is targets that bring their vectors. options.displacement.targets is read.
DisplacementSources vector_sources(std::variant<PointCloud, Frame> first, PointCloud second,
                                   std::optional<PointCloud> before, const CompareOptions& options,
                                   HeightUnit height_unit);

/// Heights under the vectors for a picture, in the frame of `site`: of the survey before, or of no data around the
/// places.
Heightfield ground_of(const DisplacementSources& sources, const PointCloud& places);

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "tools/compare/surface_comparison.hpp"

namespace scarp {

/// STEM_vectors.png and STEM_histogram.png of displacement vectors, over `ground`.
std::vector<std::filesystem::path> write_vector_pictures(const std::filesystem::path& stem, const Comparison& result,
                                                         const Heightfield& ground);

/// Draws what a comparison found next to its numbers: STEM_difference.png and STEM_histogram.png; with footprints
/// STEM_footprint.png; with a section STEM_section.png. Distances of points are drawn as a map too, each cell the mean
/// of those in it.
/// @param ground heights for the shading of rasters, on their cells; may be nullptr
/// @returns the files
std::vector<std::filesystem::path> write_pictures(const std::filesystem::path& stem, const Comparison& result,
                                                  const Heightfield* ground, const Section* section);

}  // namespace scarp

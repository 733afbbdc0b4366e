// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Displacement vectors: measured at targets, or found between two surveys; and those of a simulation at the same
// places.
#pragma once

#include <optional>
#include <vector>

#include "solver/model/compare_options.hpp"
#include "solver/model/frame.hpp"
#include "tools/compare/comparison.hpp"

namespace scarp {

/// What vectors are made of. Needed: surveys before and after, or targets that bring theirs.
struct DisplacementSources {
  std::optional<PointCloud> before, after;
  std::optional<PointCloud> targets;  ///< places before the motion; scalars "dx", "dy", "dz" are measured vectors
  std::optional<Frame> simulated;     ///< with the field "displacement"
};

/// Displacement at places before the motion, of the material points of a frame: their reference positions are where
/// they are less their displacement. A linear function of the place through the 20 nearest by least squares, so that
/// bodies that shift, turn or strain evenly come out exactly, on the surface half a spacing above the points too. NaN
/// where none of them is within two spacings.
/// @throws Error without a float field "displacement" of three components
std::vector<Vec3> simulated_displacements(const Frame& frame, const std::vector<Vec3>& places, int threads);

/// The comparison. Its cloud has the places before the motion, in the frame of the surveys (or targets), with
/// "distance" (the length of observed - simulated, or of the observed vector where nothing is simulated), "dx", "dy",
/// "dz", "sigma_x", "sigma_y", "sigma_z", "length"; with a frame "simulated_dx", ..., "difference_dx", ...; of blocks
/// "rotation", "residual", "overlap", "points", "flags". Where a vector is not known it is NaN.
/// @throws Error for sources that do not suffice or a block that is not above 0
Comparison compare_displacement(const DisplacementSources& sources, const CompareOptions& options, int threads);

}  // namespace scarp

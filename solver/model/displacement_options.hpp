// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solver/model/schema.hpp"

namespace scarp {

/// How displacement vectors are found between two surveys, and held against those of a simulation.
struct DisplacementOptions {
  double block = 0;
  std::optional<InputFile> targets;
  int minimum_points = 30;
  double least_overlap = 0.5;
  double largest_residual = 0;
  double largest_sigma = 0;

  template <class V>
  void describe(V&& v) {
    v("block", block,
      Spec{.text = "edge of the square blocks in plan whose motion is found, or diameter of the patch around a target; "
                   "needed unless the targets bring their displacements",
           .unit = "m",
           .at_least = 0});
    v("targets", targets,
      Spec{.text = "points before the motion at which vectors are asked for, in place of blocks; with the columns dx, "
                   "dy, dz (and sigma_x, sigma_y, sigma_z) measured ones"});
    v("minimum_points", minimum_points, Spec{.text = "of a block", .at_least = 7, .at_most = 1e6});
    v("least_overlap", least_overlap,
      Spec{.text = "share of a block's points that must have a counterpart within max_distance once it is moved",
           .above = 0,
           .at_most = 1});
    v("largest_residual", largest_residual,
      Spec{.text = "root mean square distance of a moved block from the surface after, above which it has not moved as "
                   "a rigid body; 0: a tenth of max_distance",
           .unit = "m",
           .at_least = 0});
    v("largest_sigma", largest_sigma,
      Spec{.text =
               "standard deviation of a vector in its worst direction, above which the ground is too smooth to tell "
               "how a block moved; 0: a tenth of max_distance",
           .unit = "m",
           .at_least = 0});
  }
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is known of the errors of a survey: of a scanner's measurements, and of how two surveys were aligned.
#pragma once

#include <optional>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

struct ScannerOptions {
  std::vector<Vec3> positions;
  double sigma_range = 0;
  double range_scale = 0;
  double sigma_azimuth = 0;
  double sigma_elevation = 0;

  template <class V>
  void describe(V&& v) {
    v("positions", positions,
      Spec{.text =
               "where the scanner stood; of several the cloud's field \"scan_position\" says, counted from 1, which "
               "one saw a point",
           .unit = "m",
           .role = Role::position});
    v("sigma_range", sigma_range, Spec{.text = "standard deviation of a measured range", .unit = "m", .at_least = 0});
    v("range_scale", range_scale,
      Spec{.text = "share of the range that is added to it, in squares (1e-6 for 1 ppm)", .at_least = 0, .below = 1});
    v("sigma_azimuth", sigma_azimuth,
      Spec{.text = "standard deviation of a horizontal angle", .unit = "deg", .at_least = 0, .at_most = 90});
    v("sigma_elevation", sigma_elevation,
      Spec{.text = "standard deviation of a vertical angle", .unit = "deg", .at_least = 0, .at_most = 90});
  }
};

/// Of the transformation x' = A (x - centre) + t + centre that brought the observed cloud onto the simulated one. The
/// cloud has been moved already: A is near 1 and t near 0.
struct AlignmentOptions {
  double sigma_translation = 0;
  double sigma_rotation = 0;
  std::vector<double> covariance;
  std::optional<Vec3> centre;

  template <class V>
  void describe(V&& v) {
    v("sigma_translation", sigma_translation,
      Spec{.text = "standard deviation of the observed cloud's place along each axis", .unit = "m", .at_least = 0});
    v("sigma_rotation", sigma_rotation,
      Spec{.text = "standard deviation of its rotation about each axis through the centre",
           .unit = "deg",
           .at_least = 0,
           .at_most = 90});
    v("covariance", covariance,
      Spec{.text = "in place of these: 12 x 12 numbers, row by row, of a11 a12 a13 a21 ... a33 tx ty tz in x' = A (x - "
                   "centre) + t + centre"});
    v("centre", centre,
      Spec{.text = "point about which it was rotated; default: the middle of the observed cloud's box",
           .unit = "m",
           .role = Role::position});
  }
};

}  // namespace scarp

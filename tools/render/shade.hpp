// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "tools/render/camera.hpp"
#include "tools/render/splat.hpp"

namespace scarp {

/// How bright each pixel of a smoothed layer is: about 0.9 on level ground, whatever the view, so that its colours are
/// those of the key; more where it turns to the light from the upper left of the viewer, less where it turns away,
/// where surfaces stand above it (eye-dome lighting at several distances), and along the silhouette. `stroke` is the
/// width of a fine line, pixels.
std::vector<float> shade(const Layer& layer, const ViewAxes& axes, double stroke, int threads);

struct ContourOptions {
  double interval = 0;   ///< m
  double elevation = 0;  ///< of a pixel at (0, 0) of the layer with depth 0, m
  double per_row = 0;    ///< change of elevation per pixel downwards, m
  double per_depth = 0;  ///< change of elevation per pixel towards the viewer, m
  double stroke = 1;     ///< width of a line, pixels; every fifth is twice as wide
};

/// Darkens `brightness` along the elevation contours of the smoothed depth.
void draw_contours(const Layer& layer, const ContourOptions& options, std::vector<float>& brightness, int threads);

}  // namespace scarp

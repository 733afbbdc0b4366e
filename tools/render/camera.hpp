// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/math.hpp"
#include "solver/model/render_options.hpp"
#include "tools/render/canvas.hpp"

namespace scarp {

/// Directions of the picture in the world: unit vectors to the right, up, and from the scene to the camera.
struct ViewAxes {
  Vec3 right{1, 0, 0}, up{0, 1, 0}, towards{0, 0, 1};

  /// World to view coordinates, m.
  Vec3 operator()(const Vec3& p) const { return {dot(right, p), dot(up, p), dot(towards, p)}; }
};

/// Axes of a view; plane strain (dimension 2) always has x to the right and y up.
ViewAxes view_axes(const CameraOptions& options, int dimension);

/// Orthographic: the same scale everywhere, so that the scale bar holds.
struct Camera {
  ViewAxes axes;
  Vec3 centre{0, 0, 0};  ///< view coordinates shown at (x, y), m
  double x = 0, y = 0;   ///< pixels
  double scale = 1;      ///< pixels per metre

  /// Pixel position x, y (whole numbers are corners of pixels), and height towards the camera in pixels.
  Vec3 project(const Vec3& p) const {
    const Vec3 v = axes(p) - centre;
    return {x + scale * v[0], y - scale * v[1], scale * v[2]};
  }
};

/// Centres `view` (a box of view coordinates, grown by `margin` metres) in `plot` and scales it to fit; a zoom above 1
/// magnifies about the centre.
Camera fit_camera(const ViewAxes& axes, const Box3& view, double margin, const PixelRect& plot, double zoom);

}  // namespace scarp

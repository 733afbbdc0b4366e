// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scarp {

ViewAxes view_axes(const CameraOptions& options, int dimension) {
  if (dimension == 2) return {};
  double azimuth = options.azimuth, elevation = options.elevation;
  if (options.view == View::top) azimuth = 180, elevation = 90;
  if (options.view == View::front) azimuth = 180, elevation = 0;
  if (options.view == View::side) azimuth = 90, elevation = 0;
  const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
  const Vec3 right{-std::cos(a), std::sin(a), 0};
  const Vec3 towards{std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
  return {right, cross(towards, right), towards};
}

Camera fit_camera(const ViewAxes& axes, const Box3& view, double margin, const PixelRect& plot, double zoom) {
  Camera camera{axes, {0, 0, 0}, plot.left + 0.5 * plot.width, plot.top + 0.5 * plot.height, 1};
  if (view.empty()) return camera;
  camera.centre = 0.5 * (view.min + view.max);
  const Vec3 size = view.max - view.min;
  camera.scale = zoom * std::min(plot.width / (size[0] + 2 * margin), plot.height / (size[1] + 2 * margin));
  return camera;
}

}  // namespace scarp

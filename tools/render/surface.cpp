// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "tools/render/splat.hpp"

namespace scarp {
namespace {

/// Where the planes are fitted to: points of a disc, with weights that fall towards its rim, so that none enters or
/// leaves the fit with a jerk.
struct Tap {
  int dx, dy;
  float weight;
  float tolerance;  ///< 1 / distance from the plane at which a point loses three quarters of its weight
};

/// The tolerance is `loose` pixels, and `steep` more per pixel of distance.
std::vector<Tap> make_taps(double radius, double loose, double steep) {
  const double stride = std::max(1.0, radius / 3);
  const int reach = static_cast<int>(radius / stride);
  std::vector<Tap> taps;
  for (int j = -reach; j <= reach; ++j)
    for (int i = -reach; i <= reach; ++i) {
      const double distance = stride * std::hypot(i, j), t = distance / (radius + 0.5 * stride);
      if (t < 1)
        taps.push_back({static_cast<int>(std::lround(i * stride)), static_cast<int>(std::lround(j * stride)),
                        static_cast<float>((1 - t * t) * (1 - t * t)),
                        static_cast<float>(1 / (loose + steep * distance))});
    }
  return taps;
}

/// Weighted normal equations of a plane f(x, y); x, y relative to the pixel.
struct PlaneFit {
  float w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  std::array<float, 3> f{};  ///< sums of 1, x, y times the function

  void add(float weight, float px, float py, float pf) {
    w += weight;
    x += weight * px;
    y += weight * py;
    xx += weight * px * px;
    xy += weight * px * py;
    yy += weight * py * py;
    f[0] += weight * pf;
    f[1] += weight * pf * px;
    f[2] += weight * pf * py;
  }

  /// Constant, slope along x, slope along y. A little stiffness (pixels²) keeps the slopes of few points in bounds.
  std::array<float, 3> solve() const {
    constexpr float stiffness = 0.05f;
    const float mx = x / w, my = y / w, mean = f[0] / w;
    const float a = xx / w - mx * mx + stiffness, b = xy / w - mx * my, c = yy / w - my * my + stiffness;
    const float p = f[1] / w - mx * mean, q = f[2] / w - my * mean, determinant = a * c - b * b;
    const float sx = (c * p - b * q) / determinant, sy = (a * q - b * p) / determinant;
    return {mean - sx * mx - sy * my, sx, sy};
  }
};

/// One round: a point counts less the further it lies from the plane that the last round found.
void fit_planes(const Layer& from, Layer& to, const std::vector<Tap>& taps, bool values, int threads) {
  for_each_seen(from, threads, [&](int x, int y) {
    const std::size_t here = from.index(x, y);
    const float z = from.depth[here], sx = from.slope_x[here], sy = from.slope_y[here];
    // A pixel without a value lends none and gets none.
    const float v = values ? from.value[here] : NAN;
    const bool with_value = !std::isnan(v);
    PlaneFit of_depth, of_value;
    for (const Tap& tap : taps) {
      if (!from.seen(x + tap.dx, y + tap.dy)) continue;
      const std::size_t there = from.index(x + tap.dx, y + tap.dy);
      // Relative to the pixel's own numbers: single precision loses nothing then.
      const float px = static_cast<float>(tap.dx), py = static_cast<float>(tap.dy), pz = from.depth[there] - z;
      const float t = (pz - sx * px - sy * py) * tap.tolerance, likeness = 1 + t * t;
      const float weight = tap.weight / (likeness * likeness);
      of_depth.add(weight, px, py, pz);
      if (!with_value || std::isnan(from.value[there])) continue;
      if (from.body.empty() || from.body[there] == from.body[here]) of_value.add(weight, px, py, from.value[there] - v);
    }
    const auto depth = of_depth.solve();
    to.depth[here] = z + depth[0];
    to.slope_x[here] = depth[1];
    to.slope_y[here] = depth[2];
    if (values) to.value[here] = with_value ? v + of_value.solve()[0] : NAN;
  });
}

}  // namespace

void smooth_surface(Layer& layer, double spacing, int threads) {
  layer.slope_x.assign(layer.depth.size(), 0);
  layer.slope_y.assign(layer.depth.size(), 0);
  Layer other = layer;
  const double radius = std::max(4.0, 3 * spacing);
  // Small planes first, so that the widely spaced points of the large ones meet a smooth surface. As long as no slope
  // is known, any may be met. The last round takes its slopes from the one before, which saw as far.
  std::vector<double> radii{std::max(1.5, radius / 3), radius, radius};
  while (radii.front() > 4.5) radii.insert(radii.begin(), radii.front() / 3);
  // The gaps between the points of large planes leave a faint grid.
  if (radius > 6) radii.push_back(radius / 3);
  for (std::size_t round = 0; round < radii.size(); ++round) {
    const double steep = round == 0 ? 2.5 : 0.4;
    // Values are smoothed over one spacing only: wider planes would cut their peaks.
    const bool values = !layer.value.empty() && round + (radius > 6 ? 3 : 2) < radii.size();
    fit_planes(layer, other, make_taps(radii[round], 1 + 2 * spacing, steep), values, threads);
    if (!values) std::swap(layer.value, other.value);
    std::swap(layer, other);
  }
}

}  // namespace scarp

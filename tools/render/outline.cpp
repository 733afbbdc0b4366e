// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/model/parallel.hpp"
#include "tools/render/splat.hpp"

namespace scarp {
namespace {

/// Mean over 2 radius + 1 neighbours along a line of `count` values that stand `stride` apart; 0 beyond its ends.
void box_line(const float* from, float* to, int count, std::size_t stride, int radius) {
  const float share = 1.0f / static_cast<float>(2 * radius + 1);
  // The values are multiples of a power of two at first, then close to it: the running sum does not drift visibly.
  double sum = 0;
  for (int i = 0; i < std::min(radius, count); ++i) sum += from[static_cast<std::size_t>(i) * stride];
  for (int i = 0; i < count; ++i) {
    if (i + radius < count) sum += from[static_cast<std::size_t>(i + radius) * stride];
    to[static_cast<std::size_t>(i) * stride] = static_cast<float>(sum) * share;
    if (i - radius >= 0) sum -= from[static_cast<std::size_t>(i - radius) * stride];
  }
}

/// Three box filters along both axes: close to a Gaussian.
void blur(std::vector<float>& image, int width, int height, int radius, int threads) {
  std::vector<float> other(image.size());
  for (int pass = 0; pass < 3; ++pass) {
    parallel_for(static_cast<std::size_t>(height), threads,
                 [&](std::size_t y) { box_line(&image[y * width], &other[y * width], width, 1, radius); });
    parallel_for(static_cast<std::size_t>(width), threads, [&](std::size_t x) {
      box_line(&other[x], &image[x], height, static_cast<std::size_t>(width), radius);
    });
  }
}

}  // namespace

void smooth_outline(Layer& layer, double spacing, int threads) {
  // Three boxes of radius r have a variance of r (r + 1).
  const double wanted = 0.5 * spacing;
  const int radius = static_cast<int>(std::lround(0.5 * (std::sqrt(1 + 4 * wanted * wanted) - 1)));
  if (radius < 1) return;
  const double deviation = std::sqrt(radius * (radius + 1.0));
  std::vector<float> blurred = layer.cover;
  blur(blurred, layer.width, layer.height, radius, threads);
  // Across a straight edge the blurred cover falls by this much per pixel; above a half it lies inside of the edge.
  const double per_pixel = 1 / (deviation * std::sqrt(2 * std::numbers::pi));
  constexpr double cut = 0.6;
  parallel_for(static_cast<std::size_t>(layer.height), threads, [&](std::size_t row) {
    for (int x = 0; x < layer.width; ++x) {
      const std::size_t i = layer.index(x, static_cast<int>(row));
      const float smooth = static_cast<float>(std::clamp(0.5 + (blurred[i] - cut) / per_pixel, 0.0, 1.0));
      layer.cover[i] = layer.depth[i] > -INFINITY ? std::max(smooth, layer.core[i]) : 0.0f;
    }
  });
}

}  // namespace scarp

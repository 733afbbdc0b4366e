// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/shade.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scarp {
namespace {

float depth_at(const Layer& layer, int x, int y) { return layer.depth[layer.index(x, y)]; }

/// The light comes from the upper left; in view coordinates: right, up, towards the viewer.
constexpr float kLight[3] = {-0.62f, 0.50f, 0.605f};

/// Cosine between the light and the surface z(x, y), whose normal is (-dz/dx, -dz/dy, 1); y of the picture points down.
float facing(float slope_x, float slope_y) {
  const float along = -slope_x * kLight[0] + slope_y * kLight[1] + kLight[2];
  return along / std::sqrt(slope_x * slope_x + slope_y * slope_y + 1);
}

/// Brightness by how much more a surface faces the light than level ground does: steep about 0, so that gentle relief
/// shows, and levelling off on both sides, so that colours stay readable on walls.
float brightness_of(float more) {
  return more < 0 ? 0.58f + 0.34f * std::exp(2.6f * more) : 0.92f + 0.18f * (1 - std::exp(-5.0f * more));
}

/// How far the surroundings at one distance stand above the pixel: pairs of opposite neighbours, so that a slope counts
/// nothing. Of order 1 at the foot of a wall. What stands far in front (`rise` well above `reach`) is another body and
/// shades nothing here: its outline would stand around it as a halo.
float hollow(const Layer& layer, int x, int y, int distance, float reach) {
  const int diagonal = static_cast<int>(std::lround(distance * 0.7071));
  const std::array<std::array<int, 2>, 4> offsets{
      {{distance, 0}, {0, distance}, {diagonal, diagonal}, {diagonal, -diagonal}}};
  const float own = depth_at(layer, x, y);
  float sum = 0;
  for (const auto& [i, j] : offsets) {
    if (!layer.seen(x + i, y + j) || !layer.seen(x - i, y - j)) continue;
    const float rise =
        (0.5f * (depth_at(layer, x + i, y + j) + depth_at(layer, x - i, y - j)) - own) / static_cast<float>(distance);
    if (rise > 0) sum += rise / (rise + 0.6f) / (1 + (rise / reach) * (rise / reach));
  }
  return sum / 4;
}

bool on_silhouette(const Layer& layer, int x, int y) {
  const auto inside = [&](int i, int j) { return layer.seen(i, j) && layer.cover[layer.index(i, j)] > 0.5f; };
  return !inside(x - 1, y) || !inside(x + 1, y) || !inside(x, y - 1) || !inside(x, y + 1);
}

}  // namespace

std::vector<float> shade(const Layer& layer, const ViewAxes& axes, double stroke, int threads) {
  std::vector<float> brightness(layer.depth.size(), 1);
  const auto pixels = [&](double strokes, int least) {
    return std::max(least, static_cast<int>(std::lround(strokes * stroke)));
  };
  const std::array<int, 4> distances{pixels(1.5, 1), pixels(4, 2), pixels(12, 3), pixels(36, 4)};
  constexpr std::array<float, 4> strengths{0.5f, 0.4f, 0.4f, 0.4f};
  // The nearest distance draws the edge of whatever is in front.
  constexpr std::array<float, 4> reaches{1e3f, 3.0f, 1.5f, 1.0f};
  const float level = static_cast<float>(axes.up[2] * kLight[1] + axes.towards[2] * kLight[2]);
  for_each_seen(layer, threads, [&](int x, int y) {
    const std::size_t i = layer.index(x, y);
    float dark = 0;
    for (std::size_t k = 0; k < distances.size(); ++k)
      dark += strengths[k] * hollow(layer, x, y, distances[k], reaches[k]);
    const float light = brightness_of(facing(layer.slope_x[i], layer.slope_y[i]) - level) * std::exp(-dark);
    brightness[i] = on_silhouette(layer, x, y) ? 0.7f * light : light;
  });
  return brightness;
}

void draw_contours(const Layer& layer, const ContourOptions& options, std::vector<float>& brightness, int threads) {
  const auto level = [&](int x, int y) {
    return (options.elevation + options.per_row * y + options.per_depth * depth_at(layer, x, y)) / options.interval;
  };
  for_each_seen(layer, threads, [&](int x, int y) {
    if (on_silhouette(layer, x, y)) return;
    const std::size_t i = layer.index(x, y);
    const double own = level(x, y), nearest = std::round(own);
    const double per_pixel =
        std::hypot(options.per_depth * layer.slope_x[i], options.per_row + options.per_depth * layer.slope_y[i]) /
        options.interval;
    // Closer than a few pixels, lines would merge into a stain.
    if (!(per_pixel > 0) || per_pixel > 0.3) return;
    const double width = options.stroke * (std::fmod(std::abs(nearest), 5) == 0 ? 1.8 : 0.9);
    const double cover = std::clamp(width / 2 + 0.5 - std::abs(own - nearest) / per_pixel, 0.0, 1.0);
    brightness[i] *= static_cast<float>(1 - 0.55 * cover);
  });
}

}  // namespace scarp

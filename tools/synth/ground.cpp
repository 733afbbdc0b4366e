// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/synth/ground.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/parallel.hpp"

namespace scarp {

Ground::Ground(const Terrain& terrain, const Vec2& size, int threads) : terrain_(terrain), size_(size) {
  constexpr double most_cells = 16e6;  // 128 MB
  raster_.cell =
      std::max({terrain.detail(), std::sqrt(size[0] * size[1] / most_cells), std::max(size[0], size[1]) / most_cells});
  raster_.columns = static_cast<int>(std::ceil(size[0] / raster_.cell)) + 2;
  raster_.rows = static_cast<int>(std::ceil(size[1] / raster_.cell)) + 2;
  raster_.z.resize(static_cast<std::size_t>(raster_.columns) * static_cast<std::size_t>(raster_.rows));
  parallel_for(static_cast<std::size_t>(raster_.rows), threads, [&](std::size_t row) {
    for (int column = 0; column < raster_.columns; ++column)
      raster_.at(column, static_cast<int>(row)) =
          terrain_.height(column * raster_.cell, static_cast<double>(row) * raster_.cell);
  });

  const auto [low, high] = std::minmax_element(raster_.z.begin(), raster_.z.end());
  lowest_ = *low;
  highest_ = *high;
  double along_x = 0, along_y = 0;
  for (int j = 0; j < raster_.rows; ++j)
    for (int i = 0; i < raster_.columns; ++i) {
      if (i > 0) along_x = std::max(along_x, std::abs(raster_.at(i, j) - raster_.at(i - 1, j)));
      if (j > 0) along_y = std::max(along_y, std::abs(raster_.at(i, j) - raster_.at(i, j - 1)));
    }
  steepest_ = std::sqrt(along_x * along_x + along_y * along_y) / raster_.cell;
}

Vec3 Ground::normal(double x, double y) const {
  const int i = std::clamp(static_cast<int>(x / raster_.cell), 0, raster_.columns - 2);
  const int j = std::clamp(static_cast<int>(y / raster_.cell), 0, raster_.rows - 2);
  const double z00 = raster_.at(i, j), z10 = raster_.at(i + 1, j);
  const double z01 = raster_.at(i, j + 1), z11 = raster_.at(i + 1, j + 1);
  const Vec3 n{(z00 + z01 - z10 - z11) / (2 * raster_.cell), (z00 + z10 - z01 - z11) / (2 * raster_.cell), 1};
  return (1 / norm(n)) * n;
}

std::optional<Ground::Span> Ground::span(const Ray& ray) const {
  Span span{0, INFINITY};
  for (int a = 0; a < 2; ++a) {
    const double o = ray.origin[a], d = ray.direction[a];
    if (d == 0) {
      if (o < 0 || o > size_[a]) return std::nullopt;
      continue;
    }
    const double first = (d > 0 ? -o : size_[a] - o) / d, last = (d > 0 ? size_[a] - o : -o) / d;
    span.begin = std::max(span.begin, first);
    span.end = std::min(span.end, last);
  }
  // Beyond these heights there is nothing to meet; a plumb line ends here too.
  if (ray.direction[2] < 0) span.end = std::min(span.end, (lowest_ - 100 - ray.origin[2]) / ray.direction[2]);
  if (ray.direction[2] > 0) span.end = std::min(span.end, (highest_ + 100 - ray.origin[2]) / ray.direction[2]);
  if (!(span.begin < span.end)) return std::nullopt;
  return span;
}

double Ground::raster_gap(const Ray& ray, double range, double lift) const {
  const Vec3 p = ray.at(range);
  // Rounding can put the end of the span a hair outside the raster's hull.
  return p[2] - lift - height_at(raster_, std::max(p[0], 0.0), std::max(p[1], 0.0));
}

double Ground::exact_gap(const Ray& ray, double range, double lift) const {
  const Vec3 p = ray.at(range);
  return p[2] - lift - terrain_.height(p[0], p[1]);
}

std::optional<Ground::Crossing> Ground::next_crossing(const Ray& ray, double from, double lift) const {
  const auto limits = span(ray);
  if (!limits) return std::nullopt;
  const double plan = std::hypot(ray.direction[0], ray.direction[1]);
  const double closing = steepest_ * plan + std::abs(ray.direction[2]);  // how fast the gap can shrink at most
  const double shortest_step = raster_.cell / 2;

  double t = std::max(from, limits->begin), gap = raster_gap(ray, t, lift);
  while (t < limits->end) {
    if (gap > 0 && ray.direction[2] >= steepest_ * plan) return std::nullopt;  // it climbs faster than any slope
    const double next = std::min(t + std::max(shortest_step, std::abs(gap) / closing), limits->end);
    const double next_gap = raster_gap(ray, next, lift);
    if ((gap < 0) != (next_gap < 0))
      if (const auto range = refine(ray, t, next, lift, *limits)) return Crossing{*range, next};
    t = next;
    gap = next_gap;
  }
  return std::nullopt;
}

/// The crossing of the exact ground near one of the raster, by regula falsi in the Illinois form (Dowell and
/// Jarratt 1971); nothing if the exact ground is only grazed.
std::optional<double> Ground::refine(const Ray& ray, double a, double b, double lift, const Span& limits) const {
  constexpr double tolerance = 1e-9;  // m
  double fa = exact_gap(ray, a, lift), fb = exact_gap(ray, b, lift);
  for (int widened = 0; (fa < 0) == (fb < 0); ++widened) {
    if (widened == 4) return std::nullopt;
    const double more = raster_.cell / 2;
    a = std::max(a - more, limits.begin);
    b = std::min(b + more, limits.end);
    fa = exact_gap(ray, a, lift);
    fb = exact_gap(ray, b, lift);
  }
  if (std::abs(fa) < tolerance) return a;
  for (int i = 0; i < 100 && std::abs(fb) >= tolerance; ++i) {
    const double c = (fa * b - fb * a) / (fa - fb);
    const double fc = exact_gap(ray, c, lift);
    if ((fc < 0) != (fb < 0)) {
      a = b;
      fa = fb;
    } else {
      fa /= 2;
    }
    b = c;
    fb = fc;
  }
  return b;
}

std::optional<double> Ground::first_hit(const Ray& ray, double lift) const {
  const auto limits = span(ray);
  if (!limits || exact_gap(ray, limits->begin, lift) < 0) return std::nullopt;
  const auto crossing = next_crossing(ray, limits->begin, lift);
  if (!crossing) return std::nullopt;
  return crossing->range;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solver/model/heightfield.hpp"
#include "tools/synth/terrain.hpp"

namespace scarp {

struct Ray {
  Vec3 origin;
  Vec3 direction;  ///< unit vector

  Vec3 at(double range) const { return origin + range * direction; }
};

/// The terrain within [0, size], prepared for rays: a raster finds the cell of a crossing, the exact function its
/// place. What lies outside is empty space.
class Ground {
 public:
  Ground(const Terrain& terrain, const Vec2& size, int threads);

  const Terrain& terrain() const { return terrain_; }
  double lowest() const { return lowest_; }
  double highest() const { return highest_; }
  /// Upward unit normal at the resolution of the raster.
  Vec3 normal(double x, double y) const;

  /// A place where the ray goes through the ground.
  struct Crossing {
    double range;   ///< m; there |z - ground - lift| < 1e-8 m
    double resume;  ///< from where to look for the next
  };
  /// The first crossing beyond `from` with the ground raised by `lift`, in either sense.
  std::optional<Crossing> next_crossing(const Ray& ray, double from, double lift = 0) const;

  /// The range at which the ray meets the raised ground from above; nothing if it misses it, starts below it, or
  /// comes to the extent from the side below it.
  std::optional<double> first_hit(const Ray& ray, double lift = 0) const;

 private:
  struct Span {
    double begin, end;
  };
  /// The ranges at which the ray is above or below the extent.
  std::optional<Span> span(const Ray& ray) const;
  std::optional<double> refine(const Ray& ray, double a, double b, double lift, const Span& limits) const;
  double raster_gap(const Ray& ray, double range, double lift) const;
  double exact_gap(const Ray& ray, double range, double lift) const;

  Terrain terrain_;
  Vec2 size_;
  Heightfield raster_;
  double lowest_, highest_;
  double steepest_;  ///< bound of the raster's gradient
};

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "solver/model/parallel.hpp"
#include "tools/render/colour_field.hpp"
#include "tools/render/colour_map.hpp"

namespace scarp {

/// A particle on the picture: pixels of the layer, y down, z towards the viewer.
struct Splat {
  float x, y, z;
};

/// What is seen of the particles, per pixel, before light falls on it.
struct Layer {
  int width = 0, height = 0;
  std::vector<float> cover;        ///< 0: background, 1: fully covered by discs of the drawn radius
  std::vector<float> core;         ///< the same by the inner 0.6 of the discs
  std::vector<float> depth;        ///< height towards the viewer, pixels; -infinity where there is nothing to be seen
  std::vector<float> value;        ///< blended scalars: the value seen; NaN where it is unknown. Empty otherwise
  std::vector<std::int32_t> body;  ///< whose value it is; empty where all may be blended
  std::vector<Rgb> colour;         ///< everything else: the mean colour of what is seen. Empty for blended scalars
  std::vector<float> slope_x, slope_y;  ///< change of depth per pixel to the right and down, once smoothed

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
  bool seen(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && depth[index(x, y)] > -INFINITY;
  }
};

/// f(x, y) for every pixel that shows something, rows in parallel.
template <class F>
void for_each_seen(const Layer& layer, int threads, F&& f) {
  parallel_for(static_cast<std::size_t>(layer.height), threads, [&](std::size_t row) {
    for (int x = 0; x < layer.width; ++x)
      if (layer.seen(x, static_cast<int>(row))) f(x, static_cast<int>(row));
  });
}

/// Draws paraboloids of the given radius (pixels) into a z-buffer of four samples per pixel. The nearest wins; of
/// equally near ones the first. With `blend`, depth and value (or scan colour) are then averaged over the splats that
/// form the visible surface, so that a regular lattice reads as a surface; classes, and values of two bodies, are never
/// mixed. Without it each particle shows its own colour, up to the middle between it and its neighbours. Depth and
/// colour reach an eighth of the radius beyond what is covered, so that the outline can be smoothed.
/// @throws Error ("render") if so many particles lie on each other that they cannot be the material's.
Layer draw_splats(const std::vector<Splat>& splats, float radius, int width, int height, const ColourField& field,
                  const ColourScale& scale, bool blend, int threads);

/// Fits a plane to the depth around each pixel, over about two spacings (pixels) and without crossing edges, and the
/// same to the value: gives smooth depth, value and slopes. Up to an edge, a plane stays a plane; values
/// are not smoothed across the bounds of bodies.
void smooth_surface(Layer& layer, double spacing, int threads);

/// Irons out the scallops that the discs leave along the outline: the cover is blurred over half a spacing (pixels) and
/// cut where it stands for half a spacing from the outermost centres. A lone particle stays: cores are always covered.
void smooth_outline(Layer& layer, double spacing, int threads);

}  // namespace scarp

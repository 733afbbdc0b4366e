// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/render/splat.hpp"

namespace scarp {

inline constexpr int kTile = 32;    ///< pixels along a side of a tile
inline constexpr int kSamples = 2;  ///< samples along a side of a pixel

/// Which splats touch which tile of the picture.
struct Bins {
  int columns = 0, rows = 0;
  std::vector<std::size_t> begin;        ///< per tile, one more at the end: its place in `particles`
  std::vector<std::uint32_t> particles;  ///< per tile, by falling z but for `depth_step`
  float depth_step = 0;                  ///< no later entry of a tile is higher than z of an earlier one plus this
};

/// Sorts splats of that radius (pixels) into tiles; those outside of the picture fall away.
/// @throws Error ("render") if so many splats lie on each other that the lists would exceed any real cloud's.
Bins bin_splats(const std::vector<Splat>& splats, float radius, int width, int height);

/// A step that visits 0 .. count-1 in an order that spreads neighbours.
std::size_t coprime_stride(std::size_t count);

}  // namespace scarp

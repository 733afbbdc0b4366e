// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "solver/model/math.hpp"
#include "solver/model/render_options.hpp"

namespace scarp {

using Rgb = std::array<float, 3>;  ///< 0 to 255

/// What has no value: NaN, a point that no scan coloured.
inline constexpr Rgb kNoValue{176, 176, 176};
/// The ground that stays below the threshold.
inline constexpr Rgb kGround{203, 200, 195};

/// 256 colours from the lowest to the highest value.
std::array<Rgb8, 256> colour_table(ColourMap map);

/// Distinct colours for materials and bodies; they repeat after the last one.
Rgb class_colour(int index);

/// Values to colours. Pure arithmetic: one scale serves the points, the colour bar and the tests.
struct ColourScale {
  double low = 0, high = 1;         ///< low < high
  int bands = 0;                    ///< 0: continuous
  std::optional<double> threshold;  ///< below it the ground shows
  double fade = 0;                  ///< from the low end over this share of the range the ground fades into the map
  std::array<Rgb8, 256> table{};

  /// Colour of a value; beyond the ends that of the end, NaN and infinities grey.
  Rgb operator()(double value) const;
};

}  // namespace scarp

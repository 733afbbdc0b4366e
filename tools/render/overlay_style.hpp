// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the overlays have in common.
#pragma once

#include <cmath>
#include <string>

#include "tools/render/canvas.hpp"

namespace scarp {

inline constexpr Rgb8 kInk{34, 38, 43};
inline constexpr Rgb8 kFaint{110, 116, 122};
inline constexpr Rgb8 kPaper{255, 255, 255};

inline int pixels(double v) { return static_cast<int>(std::lround(v)); }

/// Half a number is worse than none.
inline void draw_if_fits(Canvas& canvas, const std::string& text, Point2 at, double font, double right,
                         const Rgb8& colour) {
  if (at.x + canvas.text_width(text, font) <= right) canvas.text(text, at, font, colour);
}

}  // namespace scarp

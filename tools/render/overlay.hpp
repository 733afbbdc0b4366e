// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "tools/render/camera.hpp"
#include "tools/render/canvas.hpp"
#include "tools/render/colour_key.hpp"

namespace scarp {

/// Where things stand. The scene has the plot to itself; texts, key and scale bar have the margins.
struct Layout {
  double font = 16;  ///< em of a plain text, pixels
  PixelRect plot;
  PixelRect column;  ///< right of the plot: the key to the colours and the axes
};

/// Divides the picture; the column is as wide as its texts need, at most two fifths of the picture.
Layout arrange(Canvas& canvas, const RenderOptions& options, const ColourKey& key, int dimension);

/// Plane strain: shrinks the plot to the scene and moves it, with the column, to the middle.
void tighten(Layout& layout, double width, double height);

/// A length of 1, 2 or 5 times a power of ten metres that is at most `most` pixels long.
struct ScaleBar {
  double metres = 0, pixels = 0;
  std::string label;
};
ScaleBar choose_scale_bar(double pixels_per_metre, double most);

/// "t = 12.50 s", with as many decimals as tell the frames of the scene apart, in ms or µs for short events.
std::string time_text(double time, const Scene& scene);

/// The smallest and largest finite value of one frame, SI.
struct FrameRange {
  double low = 0, high = 0;
  bool any = false;
};

void draw_header(Canvas& canvas, const Layout& layout, const std::string& title, const std::string& time, int width);
void draw_colour_key(Canvas& canvas, const Layout& layout, const ColourKey& key, const FrameRange& frame);
/// A box of a colour at height y of the column, with a text.
void draw_swatch(Canvas& canvas, const Layout& layout, double y, const Rgb8& colour, const std::string& text);
/// Scale bar at the lower left, remarks at the lower right.
void draw_footer(Canvas& canvas, const Layout& layout, const ScaleBar& bar, const std::string& remarks, int height);
/// The world's axes as seen, at the foot of the column; E, N and z where the site is georeferenced.
void draw_triad(Canvas& canvas, const Layout& layout, const ViewAxes& axes, bool georeferenced);
/// Plane strain: a box around the plot with metres of the site along x and y.
void draw_axes_box(Canvas& canvas, const Layout& layout, const Camera& camera, const Vec3& origin,
                   const std::string& remarks);

}  // namespace scarp

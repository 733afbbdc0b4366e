// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "tools/render/overlay.hpp"
#include "tools/render/overlay_style.hpp"

namespace scarp {

ScaleBar choose_scale_bar(double pixels_per_metre, double most) {
  ScaleBar bar;
  const double longest = most / pixels_per_metre;
  bar.metres = nice_step(longest);
  // The next shorter of 1, 2, 5, 10.
  if (bar.metres > longest * (1 + 1e-9)) bar.metres = nice_step(bar.metres * 0.39);
  bar.pixels = bar.metres * pixels_per_metre;
  const DisplayUnit unit = display_unit("m", bar.metres);
  bar.label = format_number(bar.metres * unit.factor, 0) + " " + unit.symbol;
  return bar;
}

void draw_footer(Canvas& canvas, const Layout& layout, const ScaleBar& bar, const std::string& remarks, int height) {
  const double f = layout.font, left = layout.plot.left, baseline = height - 0.95 * f;
  canvas.text("0", {left, baseline}, f, kInk);
  const int thick = std::max(3, pixels(0.42 * f)), stroke = std::max(1, pixels(f / 18));
  const int x = pixels(left + f), y = pixels(baseline - 0.37 * f - thick / 2.0), length = pixels(bar.pixels);
  canvas.fill(PixelRect{x, y, length, thick}, kInk);
  for (int k = 1; k < 4; k += 2) {
    const int from = x + length * k / 4 + (k == 1 ? 0 : 0), to = x + length * (k + 1) / 4 - (k == 3 ? stroke : 0);
    canvas.fill(PixelRect{from, y + stroke, to - from, thick - 2 * stroke}, kPaper);
  }
  const double label_left = x + length + 0.5 * f;
  draw_if_fits(canvas, bar.label, {label_left, baseline}, f, layout.column.right() - 0.2 * f, kInk);
  const double room = layout.plot.right() - label_left - canvas.text_width(bar.label, f) - f;
  canvas.text(shorten(canvas, remarks, f, room), {double(layout.plot.right()), baseline}, f, kFaint, Align::right);
}

void draw_triad(Canvas& canvas, const Layout& layout, const ViewAxes& axes, bool georeferenced) {
  const double f = layout.font, length = 1.9 * f;
  // Centres the three arrows as a whole, so that none leaves the corner.
  Point2 low{0, 0}, high{0, 0};
  std::array<Point2, 3> tip;
  for (int a = 0; a < 3; ++a) {
    tip[a] = {axes.right[a] * length, -axes.up[a] * length};
    low = {std::min(low.x, tip[a].x), std::min(low.y, tip[a].y)};
    high = {std::max(high.x, tip[a].x), std::max(high.y, tip[a].y)};
  }
  const Point2 middle{layout.column.left + 3.2 * f, layout.column.bottom() - 1.4 * f};
  const Point2 origin{middle.x - (low.x + high.x) / 2, middle.y - (low.y + high.y) / 2};
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return axes.towards[a] < axes.towards[b]; });
  const char* const names[2][3] = {{"x", "y", "z"}, {"E", "N", "z"}};
  for (int a : order) {
    const double seen = std::hypot(tip[a].x, tip[a].y);
    if (seen < 0.15 * length) continue;
    const Point2 d{tip[a].x / seen, tip[a].y / seen}, end{origin.x + tip[a].x, origin.y + tip[a].y};
    const bool north = a == 1;
    const Rgb8& colour = north ? kInk : kFaint;
    const double head = std::min(0.55 * f, 0.6 * seen), half = 0.24 * f;
    const Point2 neck{end.x - d.x * head, end.y - d.y * head};
    canvas.line(origin, neck, std::max(1.2, f / 10), colour);
    canvas.fill({end, {neck.x - d.y * half, neck.y + d.x * half}, {neck.x + d.y * half, neck.y - d.x * half}}, colour);
    canvas.text(names[georeferenced][a], {end.x + d.x * 0.65 * f, end.y + d.y * 0.65 * f + 0.36 * f}, f, colour,
                Align::centre, georeferenced && north);
  }
}

void draw_axes_box(Canvas& canvas, const Layout& layout, const Camera& camera, const Vec3& origin,
                   const std::string& remarks) {
  const double f = layout.font;
  const PixelRect& plot = layout.plot;
  const int stroke = std::max(1, pixels(f / 18)), tick = pixels(0.35 * f);
  canvas.outline(plot, stroke, kInk);
  const double left = (plot.left - camera.x) / camera.scale + camera.centre[0] + origin[0];
  const double right = (plot.right() - camera.x) / camera.scale + camera.centre[0] + origin[0];
  const double top = (camera.y - plot.top) / camera.scale + camera.centre[1] + origin[1];
  const double bottom = (camera.y - plot.bottom()) / camera.scale + camera.centre[1] + origin[1];
  // One step for both axes, wide enough for the labels of x.
  const double step = nice_step(4.5 * f / camera.scale);
  const Ticks along_x = nice_ticks(left, right, step), along_y = nice_ticks(bottom, top, step);
  const double base = plot.bottom() + stroke + tick + 1.05 * f;
  for (double v : along_x.values) {
    const double x = plot.left + (v - left) * camera.scale;
    canvas.fill(PixelRect{pixels(x - stroke / 2.0), plot.bottom() + stroke, stroke, tick}, kInk);
    canvas.text(format_number(v, along_x.decimals), {x, base}, f, kInk, Align::centre);
  }
  for (double v : along_y.values) {
    const double y = plot.top + (top - v) * camera.scale;
    canvas.fill(PixelRect{plot.left - stroke - tick, pixels(y - stroke / 2.0), tick, stroke}, kInk);
    canvas.text(format_number(v, along_y.decimals), {plot.left - 0.65 * f, y + 0.36 * f}, f, kInk, Align::right);
  }
  canvas.text("x (m)", {plot.left + plot.width / 2.0, base + 1.35 * f}, f, kInk, Align::centre);
  canvas.text("y (m)", {plot.left - 0.65 * f, plot.top - 0.6 * f}, f, kInk, Align::right);
  canvas.text(shorten(canvas, remarks, f, plot.width / 2.0 - 3 * f), {double(plot.right()), base + 1.35 * f}, f, kFaint,
              Align::right);
}

}  // namespace scarp

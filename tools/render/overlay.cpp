// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scarp {
namespace {

constexpr Rgb8 kInk{34, 38, 43};
constexpr Rgb8 kFaint{110, 116, 122};
constexpr Rgb8 kPaper{255, 255, 255};

int pixels(double v) { return static_cast<int>(std::lround(v)); }

double key_bar_width(double font) { return std::max(6.0, 1.15 * font); }

std::vector<std::string> key_title(Canvas& canvas, const ColourKey& key, double font, double width) {
  return wrap(canvas, key.label + key.unit_text(), font, width);
}

double widest(Canvas& canvas, const std::vector<std::string>& texts, double font) {
  double width = 0;
  for (const std::string& text : texts) width = std::max(width, canvas.text_width(text, font));
  return width;
}

std::vector<std::string> tick_texts(const Ticks& ticks) {
  std::vector<std::string> texts;
  for (double v : ticks.values) texts.push_back(format_number(v, ticks.decimals));
  return texts;
}

/// "max 8.31 m"; the unit as on the bar.
std::string extreme_text(const char* word, double value, const ColourKey& key) {
  const std::string unit = key.unit.symbol.empty() ? "" : " " + key.unit.symbol;
  return std::string(word) + " " + format_three_digits(value * key.unit.factor) + unit;
}

double column_width(Canvas& canvas, const ColourKey& key, double font, double most) {
  if (key.kind == ColourKind::scan) return 7 * font;
  double width = widest(canvas, key_title(canvas, key, font, 8.5 * font), font);
  if (key.kind == ColourKind::scalar) {
    width = std::max(width, key_bar_width(font) + 0.7 * font + widest(canvas, tick_texts(key.ticks), font));
    // The extremes change from frame to frame, the layout must not.
    width = std::max(width, canvas.text_width(extreme_text("max", -1.23e-3 / key.unit.factor, key), font));
  } else {
    width = std::max(width, 1.7 * font + widest(canvas, key.class_names, font));
  }
  return std::min(width + 1.8 * font, most);
}

}  // namespace

Layout arrange(Canvas& canvas, const RenderOptions& options, const ColourKey& key, int dimension) {
  Layout layout;
  const double w = options.width, h = options.height;
  layout.font = std::min(std::max(std::round(0.0255 * std::min(h, 0.7 * w)), 11.0), std::max(4.0, h / 12));
  const double f = layout.font;
  const int column = pixels(column_width(canvas, key, f, w / 3));
  const int left = pixels(dimension == 2 ? 4.6 * f : 0.9 * f), top = pixels((dimension == 2 ? 4.0 : 2.9) * f);
  const int bottom = pixels(dimension == 2 ? 3.6 * f : 2.7 * f);
  layout.plot = {left, top, std::max(1, options.width - column - left), std::max(1, options.height - top - bottom)};
  layout.column = {options.width - column, top, column, layout.plot.height};
  return layout;
}

void tighten(Layout& layout, double width, double height) {
  const int w = std::clamp(pixels(width), 1, layout.plot.width), h = std::clamp(pixels(height), 1, layout.plot.height);
  layout.plot.left += (layout.plot.width - w) / 2;
  layout.plot.top += (layout.plot.height - h) / 2;
  layout.plot.width = w;
  layout.plot.height = h;
  layout.column.left = layout.plot.right();
  // The key begins beside the top of the plot, as far as it has room below.
  const int bottom = layout.column.bottom(), lowest = bottom - pixels(27 * layout.font);
  layout.column.top = std::max(layout.column.top, std::min(layout.plot.top, lowest));
  layout.column.height = bottom - layout.column.top;
}

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

std::string time_text(double time, const Scene& scene) {
  const DisplayUnit unit = display_unit("s", scene.last_time);
  int decimals = 2;
  if (scene.shortest_interval > 0) {
    // Enough digits to write the interval to one per cent, if it is a round number fewer.
    const double step = scene.shortest_interval * unit.factor;
    decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(step) + 1e-9)), 0, 6);
    const auto round_with = [&](int d) {
      const double scaled = step * std::pow(10.0, d);
      return std::abs(scaled - std::round(scaled)) < 0.01 * scaled;
    };
    while (decimals > 0 && round_with(decimals - 1)) --decimals;
  }
  return "t = " + format_number(time * unit.factor, decimals) + " " + unit.symbol;
}

void draw_header(Canvas& canvas, const Layout& layout, const std::string& title, const std::string& time, int width) {
  const double f = layout.font, baseline = 1.9 * f, left = 0.9 * f, right = width - 0.9 * f;
  const double time_width = canvas.text_width(time, 1.1 * f);
  canvas.text(time, {right, baseline}, 1.1 * f, kInk, Align::right);
  const double room = right - time_width - 1.5 * f - left;
  double size = 1.3 * f;
  while (size > f && canvas.text_width(title, size, true) > room) size -= 1;
  canvas.text(shorten(canvas, title, size, room, true), {left, baseline}, size, kInk, Align::left, true);
}

namespace {

/// A triangle at an end of the bar: there are values beyond it.
void draw_arrow(Canvas& canvas, double x, double y, double width, double height, const Rgb8& colour) {
  canvas.fill({{x, y}, {x + width, y}, {x + width / 2, y - height}}, colour);
  canvas.line({x, y}, {x + width / 2, y - height}, 1, kInk);
  canvas.line({x + width, y}, {x + width / 2, y - height}, 1, kInk);
}

Rgb8 rounded(const Rgb& c) {
  return {static_cast<std::uint8_t>(std::lround(c[0])), static_cast<std::uint8_t>(std::lround(c[1])),
          static_cast<std::uint8_t>(std::lround(c[2]))};
}

void draw_bar(Canvas& canvas, const ColourKey& key, const PixelRect& bar, double font) {
  const ColourScale& s = key.scale;
  for (int row = 0; row < bar.height; ++row) {
    const double t = 1 - (row + 0.5) / bar.height;
    canvas.fill(PixelRect{bar.left, bar.top + row, bar.width, 1}, rounded(s(s.low + t * (s.high - s.low))));
  }
  const int stroke = std::max(1, pixels(font / 18));
  canvas.outline(bar, stroke, kInk);
  const double head = 0.8 * bar.width;
  if (key.above) draw_arrow(canvas, bar.left, bar.top - stroke, bar.width, head, rounded(s(s.high)));
  if (key.below) draw_arrow(canvas, bar.left, bar.bottom() + stroke, bar.width, -head, rounded(s(s.low)));
  for (double v : key.ticks.values) {
    const double t = (v / key.unit.factor - s.low) / (s.high - s.low);
    const double y = bar.bottom() - t * bar.height;
    const int top = std::clamp(pixels(y - stroke / 2.0), bar.top, bar.bottom() - stroke);
    canvas.fill(PixelRect{bar.right() + stroke, top, pixels(0.3 * font), stroke}, kInk);
    canvas.text(format_number(v, key.ticks.decimals), {bar.right() + 0.6 * font, y + 0.36 * font}, font, kInk);
  }
}

void draw_swatch(Canvas& canvas, const Layout& layout, double y, const Rgb8& colour, const std::string& text) {
  const double f = layout.font, x = layout.column.left + 0.9 * f;
  const PixelRect box{pixels(x), pixels(y), pixels(1.1 * f), pixels(0.9 * f)};
  canvas.fill(box, colour);
  canvas.outline(box, 1, kInk);
  const double room = layout.column.right() - x - 2.2 * f;
  canvas.text(shorten(canvas, text, f, room), {x + 1.6 * f, y + 0.8 * f}, f, kInk);
}

/// Draws the lines of the title and returns where the next thing may begin.
double draw_key_title(Canvas& canvas, const Layout& layout, const ColourKey& key) {
  const double f = layout.font, x = layout.column.left + 0.9 * f;
  double y = layout.column.top + 0.9 * f;
  for (const std::string& line : key_title(canvas, key, f, std::max(8.5 * f, layout.column.width - 1.8 * f))) {
    canvas.text(shorten(canvas, line, f, layout.column.right() - x), {x, y}, f, kInk);
    y += 1.3 * f;
  }
  return y - 0.3 * f;
}

void draw_class_swatches(Canvas& canvas, const Layout& layout, const ColourKey& key, double y) {
  const double f = layout.font, step = 1.5 * f;
  // The triad has the lowest five lines of the column.
  const int fit = std::max(1, static_cast<int>((layout.column.bottom() - 6.5 * f - y) / step));
  const int count = static_cast<int>(key.classes.size()), shown = count <= fit ? count : fit - 1;
  for (int i = 0; i < shown; ++i, y += step)
    draw_swatch(canvas, layout, y, rounded(class_colour(key.classes[i])), key.class_names[i]);
  if (shown < count)
    canvas.text("and " + std::to_string(count - shown) + " more", {layout.column.left + 0.9 * f, y + 0.8 * f}, f,
                kFaint);
}

}  // namespace

void draw_colour_key(Canvas& canvas, const Layout& layout, const ColourKey& key, const FrameRange& frame) {
  if (key.kind == ColourKind::scan) return;
  const double f = layout.font, x = layout.column.left + 0.9 * f;
  double y = draw_key_title(canvas, layout, key);
  if (key.kind == ColourKind::classes) return draw_class_swatches(canvas, layout, key, y);
  const double head = 0.8 * key_bar_width(f);
  if (key.above) y += head;
  const bool two_sided = key.scale.low < 0;
  const double below = (two_sided ? 2.8 : 1.4) * f + (key.missing ? 1.5 : 0) * f + (key.below ? head : 0) + 0.8 * f;
  const double room = layout.column.bottom() - 6.0 * f - below - y;
  const PixelRect bar{pixels(x), pixels(y), pixels(key_bar_width(f)), std::max(2, pixels(std::min(room, 17 * f)))};
  draw_bar(canvas, key, bar, f);
  y = bar.bottom() + (key.below ? head : 0) + 1.8 * f;
  if (frame.any) canvas.text(extreme_text("max", frame.high, key), {x, y}, f, kFaint);
  if (frame.any && two_sided) canvas.text(extreme_text("min", frame.low, key), {x, y += 1.4 * f}, f, kFaint);
  if (key.missing) draw_swatch(canvas, layout, y + 0.7 * f, rounded(kNoValue), "no value");
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
  canvas.text(bar.label, {label_left, baseline}, f, kInk);
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

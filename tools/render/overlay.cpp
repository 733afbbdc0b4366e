// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/overlay.hpp"

#include <algorithm>
#include <cmath>

#include "tools/render/overlay_style.hpp"

namespace scarp {
namespace {

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
  const int column = pixels(column_width(canvas, key, f, 0.4 * w));
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

void draw_swatch(Canvas& canvas, const Layout& layout, double y, const Rgb8& colour, const std::string& text) {
  const double f = layout.font, x = layout.column.left + 0.9 * f;
  const PixelRect box{pixels(x), pixels(y), pixels(1.1 * f), pixels(0.9 * f)};
  canvas.fill(box, colour);
  canvas.outline(box, 1, kInk);
  const double room = layout.column.right() - x - 1.8 * f;
  canvas.text(shorten(canvas, text, f, room), {x + 1.6 * f, y + 0.8 * f}, f, kInk);
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

void draw_bar(Canvas& canvas, const ColourKey& key, const PixelRect& bar, double font, double right) {
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
    draw_if_fits(canvas, format_number(v, key.ticks.decimals), {bar.right() + 0.6 * font, y + 0.36 * font}, font, right,
                 kInk);
  }
}

/// Draws the lines of the title and returns where the next thing may begin.
double draw_key_title(Canvas& canvas, const Layout& layout, const ColourKey& key) {
  const double f = layout.font, x = layout.column.left + 0.9 * f;
  double y = layout.column.top + 0.9 * f;
  for (const std::string& line : key_title(canvas, key, f, std::max(8.5 * f, layout.column.width - 1.8 * f))) {
    canvas.text(shorten(canvas, line, f, layout.column.right() - 0.2 * f - x), {x, y}, f, kInk);
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
    draw_if_fits(canvas, "and " + std::to_string(count - shown) + " more", {layout.column.left + 0.9 * f, y + 0.8 * f},
                 f, layout.column.right() - 0.2 * f, kFaint);
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
  const double right = layout.column.right() - 0.2 * f;
  const double below = (two_sided ? 2.8 : 1.4) * f + (key.missing ? 1.5 : 0) * f + (key.below ? head : 0) + 0.8 * f;
  const double room = layout.column.bottom() - 6.0 * f - below - y;
  const PixelRect bar{pixels(x), pixels(y), pixels(key_bar_width(f)), std::max(2, pixels(std::min(room, 17 * f)))};
  draw_bar(canvas, key, bar, f, right);
  y = bar.bottom() + (key.below ? head : 0) + 1.8 * f;
  if (frame.any) draw_if_fits(canvas, extreme_text("max", frame.high, key), {x, y}, f, right, kFaint);
  if (frame.any && two_sided)
    draw_if_fits(canvas, extreme_text("min", frame.low, key), {x, y += 1.4 * f}, f, right, kFaint);
  if (key.missing) draw_swatch(canvas, layout, y + 0.7 * f, rounded(kNoValue), "no value");
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/map_picture.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/error.hpp"
#include "tools/render/overlay.hpp"
#include "tools/render/overlay_style.hpp"

namespace scarp {
namespace {

constexpr double kFont = 18;
constexpr int kWidth = 1400, kColumn = 260, kHighest = 900;
constexpr double kQuiet = 208;  ///< grey of ground that did not change
constexpr Rgb8 kClasses[] = {{0, 114, 178}, {230, 159, 0}, {130, 38, 98}};

/// Blue, white, red; as dark at both ends, so that a grey print shows the size of a difference.
std::array<Rgb8, 256> diverging_table() {
  constexpr double nodes[5][3] = {{24, 62, 120}, {104, 156, 204}, {246, 246, 244}, {222, 138, 98}, {132, 28, 38}};
  std::array<Rgb8, 256> table;
  for (int i = 0; i < 256; ++i) {
    const double t = i / 255.0 * 4;
    const int node = std::min(3, static_cast<int>(t));
    for (int c = 0; c < 3; ++c)
      table[i][c] =
          static_cast<std::uint8_t>(std::lround(nodes[node][c] + (t - node) * (nodes[node + 1][c] - nodes[node][c])));
  }
  return table;
}

/// Its part from white to red.
std::array<Rgb8, 256> rising_table() {
  const std::array<Rgb8, 256> both = diverging_table();
  std::array<Rgb8, 256> table;
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = both[128 + i / 2];
  return table;
}

/// Brightness of ground lit from the north-west, 1 on the level.
double hillshade(const Heightfield* ground, int column, int row) {
  if (!ground) return 1;
  const auto slope = [&](int dc, int dr) {
    const int c0 = std::max(0, column - dc), c1 = std::min(ground->columns - 1, column + dc);
    const int r0 = std::max(0, row - dr), r1 = std::min(ground->rows - 1, row + dr);
    const int steps = (c1 - c0) + (r1 - r0);
    return steps > 0 ? (ground->at(c1, r1) - ground->at(c0, r0)) / (steps * ground->cell) : 0.0;
  };
  const double p = slope(1, 0), q = slope(0, 1);
  const double light = (1 + (p - q) * std::sqrt(0.5)) / std::sqrt(1 + p * p + q * q);
  return std::isnan(light) ? 1 : std::clamp(0.5 + 0.5 * light, 0.6, 1.08);
}

Rgb8 lit(const Rgb& colour, double light) {
  Rgb8 pixel;
  for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(std::clamp(colour[c] * light, 0.0, 255.0));
  return pixel;
}

Rgb as_float(const Rgb8& c) { return {float(c[0]), float(c[1]), float(c[2])}; }

/// A picture whose plot fits the cells to scale.
struct Sheet {
  Picture picture;
  Layout layout;
  Camera camera;
  const Heightfield& cells;

  /// `lines` of text at least high, for the key.
  Sheet(const Heightfield& field, double lines) : cells(field) {
    const double wide = field.columns * field.cell, high = field.rows * field.cell, f = kFont;
    const int left = pixels(6.2 * f), top = pixels(4.2 * f), bottom = pixels(6.0 * f);
    const double room = kWidth - kColumn - left;
    camera.scale = std::min(room / wide, kHighest / high);
    const int plot_width = std::max(1, pixels(wide * camera.scale)),
              plot_height = std::max(1, pixels(high * camera.scale));
    const int height = std::max(pixels(lines * f), plot_height) + top + bottom;
    picture = {kWidth, height, std::vector<Rgb8>(static_cast<std::size_t>(kWidth) * height, kPaper)};
    layout.font = f;
    layout.plot = {left + pixels((room - plot_width) / 2), top + (height - top - bottom - plot_height) / 2, plot_width,
                   plot_height};
    layout.column = {layout.plot.right(), top, kWidth - layout.plot.right(), height - top - bottom};
    camera.x = layout.plot.left;
    camera.y = layout.plot.bottom();
    camera.centre = {field.x0 - 0.5 * field.cell, field.y0 - 0.5 * field.cell, 0};
  }

  /// Colours each pixel by colour(column, row, x, y).
  template <class F>
  void paint(F&& colour) {
    const PixelRect& plot = layout.plot;
    for (int y = plot.top; y < plot.bottom(); ++y)
      for (int x = plot.left; x < plot.right(); ++x) {
        const int column =
            std::min(cells.columns - 1, static_cast<int>((x + 0.5 - plot.left) / plot.width * cells.columns));
        const int row =
            std::min(cells.rows - 1, static_cast<int>((plot.bottom() - y - 0.5) / plot.height * cells.rows));
        picture.at(x, y) = colour(column, row, x, y);
      }
  }

  void frame(Canvas& canvas, const std::string& title, const std::string& remarks) {
    draw_header(canvas, layout, title, "", picture.width);
    draw_axes_box(canvas, layout, camera, cells.site.origin, "");
    draw_footer(canvas, layout, choose_scale_bar(camera.scale, 0.25 * layout.plot.width), "", picture.height);
    const double right = picture.width - layout.font;
    const double room = right - layout.plot.left - 0.25 * layout.plot.width - 6 * layout.font;
    double size = layout.font;
    while (size > 0.75 * layout.font && canvas.text_width(remarks, size) > room) size -= 0.05 * layout.font;
    canvas.text(shorten(canvas, remarks, size, room), {right, picture.height - 0.95 * layout.font}, size, kInk,
                Align::right);
    draw_triad(canvas, layout, ViewAxes{}, !cells.site.crs.empty());
  }
};

Rgb8 hatched(double light, int x, int y) {
  const double grey = ((x + y) % 9) < 2 ? kQuiet - 42 : kQuiet;
  return lit({float(grey), float(grey), float(grey)}, light);
}

/// The next of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten.
double rounded_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (double m : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (m * power >= value * (1 - 1e-9)) return m * power;
  return 10 * power;
}

ColourKey key_of(const Heightfield& difference, const std::string& label, FrameRange& range) {
  std::vector<double> sizes;
  for (double d : difference.z) {
    if (std::isnan(d)) continue;
    sizes.push_back(std::abs(d));
    range.low = range.any ? std::min(range.low, d) : d;
    range.high = range.any ? std::max(range.high, d) : d;
    range.any = true;
  }
  if (sizes.empty()) throw Error("render", "a map without data", "0 cells", "at least 1");
  const auto rank = sizes.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), rank, sizes.end());
  const double end = *rank > 0 ? rounded_up(*rank) : 1;
  ColourKey key;
  key.label = label;
  key.unit = display_unit("m", end);
  const bool one_sided = range.low >= 0;
  const double begin = one_sided ? 0 : -end;
  key.scale = {begin, end, 0, std::nullopt, 0, one_sided ? rising_table() : diverging_table()};
  key.ticks = nice_ticks(begin * key.unit.factor, end * key.unit.factor, 9);
  key.below = range.low < begin;
  key.above = range.high > end;
  return key;
}

}  // namespace

Picture draw_difference_map(const DifferenceMap& map) {
  const Heightfield& d = *map.difference;
  FrameRange range;
  const ColourKey key = key_of(d, map.label, range);
  Sheet sheet(d, 34);
  bool quiet = false;
  sheet.paint([&](int column, int row, int x, int y) {
    const double v = d.at(column, row);
    if (std::isnan(v)) return kPaper;
    const double light = hillshade(map.ground, column, row);
    const bool significant = !map.level_of_detection || std::abs(v) > map.level_of_detection->at(column, row);
    quiet |= !significant;
    return significant ? lit(key.scale(v), light) : hatched(light, x, y);
  });
  Canvas canvas(sheet.picture);
  sheet.frame(canvas, map.title, map.remarks);
  draw_colour_key(canvas, sheet.layout, key, range);
  if (quiet) {
    const double f = sheet.layout.font, y = sheet.layout.column.top + 27 * f, x = sheet.layout.column.left + 0.9 * f;
    const PixelRect box{pixels(x), pixels(y), pixels(1.1 * f), pixels(0.9 * f)};
    for (int v = box.top; v < box.bottom(); ++v)
      for (int u = box.left; u < box.right(); ++u) sheet.picture.at(u, v) = hatched(1, u, v);
    canvas.outline(box, 1, kInk);
    canvas.text("not significant", {x + 1.6 * f, y + 0.8 * f}, f, kInk);
  }
  return std::move(sheet.picture);
}

Picture draw_footprint_map(const FootprintMap& map) {
  const Heightfield& cells = *map.cells;
  Sheet sheet(cells, 12);
  sheet.paint([&](int column, int row, int, int) {
    const double v = cells.at(column, row);
    const double light = hillshade(map.ground, column, row);
    if (v >= 1 && v <= 3) return lit(as_float(kClasses[static_cast<int>(v) - 1]), light);
    return lit({235, 234, 230}, light);
  });
  Canvas canvas(sheet.picture);
  sheet.frame(canvas, map.title, map.remarks);
  const double f = sheet.layout.font;
  const std::string names[] = {"both", map.simulated + " only", map.observed + " only"};
  for (int k = 0; k < 3; ++k)
    draw_swatch(canvas, sheet.layout, sheet.layout.column.top + 1.6 * k * f, kClasses[k], names[k]);
  return std::move(sheet.picture);
}

namespace {

constexpr Rgb8 kObservedArrow{24, 62, 120}, kSimulatedArrow{200, 88, 32};

/// An arrow between two pixels, or a dot where it would be shorter than that.
void draw_arrow(Canvas& canvas, Point2 from, Point2 to, const Rgb8& colour) {
  constexpr double kShaft = 2.2, kHead = 9;
  const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (length < kShaft) {
    canvas.fill(PixelRect{pixels(from.x) - 1, pixels(from.y) - 1, 3, 3}, colour);
    return;
  }
  const double ux = dx / length, uy = dy / length, head = std::min(kHead, 0.6 * length), half = 0.42 * head;
  const Point2 neck{to.x - head * ux, to.y - head * uy};
  canvas.line(from, neck, kShaft, colour);
  canvas.fill({to, {neck.x - half * uy, neck.y + half * ux}, {neck.x + half * uy, neck.y - half * ux}}, colour);
}

void draw_cross(Canvas& canvas, Point2 at) {
  constexpr double kArm = 3.5;
  canvas.line({at.x - kArm, at.y - kArm}, {at.x + kArm, at.y + kArm}, 1.6, kFaint);
  canvas.line({at.x - kArm, at.y + kArm}, {at.x + kArm, at.y - kArm}, 1.6, kFaint);
}

bool known(const Vec2& v) { return std::isfinite(v[0]) && std::isfinite(v[1]); }

/// Metres of ground that a metre of displacement is drawn as.
double exaggeration(const VectorMap& map) {
  std::vector<double> sizes;
  for (const auto* vectors : {&map.observed, &map.simulated})
    for (const Vec2& v : *vectors)
      if (known(v)) sizes.push_back(std::hypot(v[0], v[1]));
  if (sizes.empty()) return 1;
  const auto rank = sizes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), rank, sizes.end());
  const Heightfield& ground = *map.ground;
  const double area = ground.columns * ground.cell * ground.rows * ground.cell;
  const double apart = std::sqrt(area / static_cast<double>(std::max<std::size_t>(1, map.at.size())));
  return *rank > 0 ? apart / *rank : 1;
}

}  // namespace

Picture draw_vector_map(const VectorMap& map) {
  if (!map.ground || map.ground->columns < 1) throw Error("render", "a map without ground");
  const Heightfield& ground = *map.ground;
  Sheet sheet(ground, 20);
  sheet.paint([&](int column, int row, int, int) {
    const double light = std::isnan(ground.at(column, row)) ? 1.04 : hillshade(&ground, column, row);
    return lit({226, 225, 221}, light);
  });
  Canvas canvas(sheet.picture);
  const double scale = exaggeration(map);
  const auto pixel = [&](double x, double y) {
    return Point2{sheet.camera.x + (x - sheet.camera.centre[0]) * sheet.camera.scale,
                  sheet.camera.y - (y - sheet.camera.centre[1]) * sheet.camera.scale};
  };
  std::size_t unknown = 0;
  const auto draw = [&](const std::vector<Vec2>& vectors, const Rgb8& colour) {
    for (std::size_t i = 0; i < vectors.size(); ++i)
      if (known(vectors[i]) && known(map.at[i]))
        draw_arrow(canvas, pixel(map.at[i][0], map.at[i][1]),
                   pixel(map.at[i][0] + scale * vectors[i][0], map.at[i][1] + scale * vectors[i][1]), colour);
  };
  for (std::size_t i = 0; i < map.at.size(); ++i)
    if (!known(map.observed[i]) && known(map.at[i])) {
      draw_cross(canvas, pixel(map.at[i][0], map.at[i][1]));
      ++unknown;
    }
  draw(map.simulated, kSimulatedArrow);
  draw(map.observed, kObservedArrow);
  sheet.frame(canvas, map.title, map.remarks);

  const double f = sheet.layout.font, left = sheet.layout.column.left + 0.9 * f;
  double y = sheet.layout.column.top;
  draw_swatch(canvas, sheet.layout, y, kObservedArrow, map.observed_name);
  if (!map.simulated.empty()) draw_swatch(canvas, sheet.layout, y += 1.6 * f, kSimulatedArrow, map.simulated_name);
  // The longest round length that fits the key.
  const double most = sheet.layout.column.width - 3 * f;
  const ScaleBar bar = choose_scale_bar(scale * sheet.camera.scale, most);
  y += 3.4 * f;
  draw_arrow(canvas, {left, y}, {left + bar.pixels, y}, kInk);
  canvas.text(bar.label + " of displacement", {left, y + 1.5 * f}, f, kInk);
  if (unknown > 0) {
    draw_cross(canvas, {left + 0.4 * f, y + 3.2 * f});
    canvas.text("not known", {left + 1.6 * f, y + 3.55 * f}, f, kInk);
  }
  return std::move(sheet.picture);
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/chart_picture.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/error.hpp"
#include "tools/render/overlay_style.hpp"
#include "tools/render/ticks.hpp"

namespace scarp {
namespace {

constexpr double kFont = 18;
constexpr int kWidth = 1400, kHeight = 640;
constexpr Rgb8 kSimulated{200, 88, 32}, kObserved{24, 62, 120}, kBars{104, 156, 204}, kShade{225, 225, 225};

/// A box with an axis on each side, and what maps values onto it.
struct Chart {
  Picture picture{kWidth, kHeight, std::vector<Rgb8>(static_cast<std::size_t>(kWidth) * kHeight, kPaper)};
  Canvas canvas{picture};
  PixelRect plot{pixels(6 * kFont), pixels(4.2 * kFont), kWidth - pixels(8 * kFont), kHeight - pixels(9.6 * kFont)};
  double x0, x1, y0, y1;

  Chart(double left, double right, double bottom, double top) : x0(left), x1(right), y0(bottom), y1(top) {}
  double x(double v) const { return plot.left + (v - x0) / (x1 - x0) * plot.width; }
  double y(double v) const { return plot.bottom() - (v - y0) / (y1 - y0) * plot.height; }

  void axes(const std::string& title, const std::string& x_label, const std::string& y_label) {
    const double f = kFont, base = plot.bottom() + 1.5 * f;
    canvas.outline(plot, 1, kInk);
    for (const Ticks& t : {nice_ticks(x0, x1, 10)})
      for (double v : t.values) {
        canvas.fill(PixelRect{pixels(x(v)), plot.bottom() + 1, 1, pixels(0.35 * f)}, kInk);
        canvas.text(format_number(v, t.decimals), {x(v), base}, f, kInk, Align::centre);
      }
    for (const Ticks& t : {nice_ticks(y0, y1, 7)})
      for (double v : t.values) {
        canvas.fill(PixelRect{plot.left - 1 - pixels(0.35 * f), pixels(y(v)), pixels(0.35 * f), 1}, kInk);
        canvas.text(format_number(v, t.decimals), {plot.left - 0.65 * f, y(v) + 0.36 * f}, f, kInk, Align::right);
      }
    canvas.text(x_label, {plot.left + plot.width / 2.0, base + 1.4 * f}, f, kInk, Align::centre);
    canvas.text(y_label, {double(plot.left), plot.top - 0.6 * f}, f, kInk);
    canvas.text(shorten(canvas, title, 1.3 * f, kWidth - 2 * f, true), {f, 1.9 * f}, 1.3 * f, kInk, Align::left, true);
  }

  /// A line over the box from top to bottom.
  void mark(double v, const Rgb8& colour, double width) {
    if (v >= x0 && v <= x1) canvas.line({x(v), double(plot.top)}, {x(v), double(plot.bottom())}, width, colour);
  }
};

struct Distribution {
  std::vector<double> shares;  ///< %, of each bin
  double begin = 0, end = 0;   ///< of all bins: -end, or 0 where no value is below
  double mean = 0, median = 0, beyond = 0;
};

Distribution distribution_of(std::vector<double> values, int bins) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) throw Error("render", "a histogram without values", "0", "at least 1");
  Distribution d;
  const auto n = static_cast<double>(values.size());
  for (double v : values) d.mean += v / n;
  std::vector<double> sizes;
  for (double v : values) sizes.push_back(std::abs(v));
  std::sort(sizes.begin(), sizes.end());
  std::sort(values.begin(), values.end());
  d.median = values[values.size() / 2];
  d.end = 1.05 * sizes[static_cast<std::size_t>(0.98 * (n - 1))];
  if (!(d.end > 0)) d.end = 1;
  d.begin = values.front() < 0 ? -d.end : 0;
  d.shares.assign(static_cast<std::size_t>(bins), 0);
  for (double v : values) {
    const double bin = (v - d.begin) / (d.end - d.begin) * bins;
    if (bin >= 0 && bin < bins)
      d.shares[static_cast<std::size_t>(bin)] += 100 / n;
    else
      d.beyond += 100 / n;
  }
  return d;
}

void draw_line(Chart& chart, const std::vector<double>& s, const std::vector<double>& z, const Rgb8& colour) {
  for (std::size_t i = 1; i < s.size(); ++i)
    if (std::isfinite(z[i - 1]) && std::isfinite(z[i]))
      chart.canvas.line({chart.x(s[i - 1]), chart.y(z[i - 1])}, {chart.x(s[i]), chart.y(z[i])}, 2.2, colour);
}

}  // namespace

Picture draw_histogram(const HistogramChart& chart) {
  constexpr int kBins = 60;
  const Distribution d = distribution_of(chart.values, kBins);
  const double factor = display_unit("m", d.end).factor, begin = d.begin * factor, end = d.end * factor;
  const std::string unit = display_unit("m", d.end).symbol;
  Chart box(begin, end, 0, 1.08 * *std::max_element(d.shares.begin(), d.shares.end()));
  const double lod = std::min(end, chart.level_of_detection * factor);
  if (lod > 0)
    box.canvas.fill(PixelRect{pixels(box.x(std::max(begin, -lod))), box.plot.top,
                              pixels(box.x(lod) - box.x(std::max(begin, -lod))), box.plot.height},
                    kShade);
  const auto edge = [&](int k) { return pixels(box.x(begin + (end - begin) * k / kBins)); };
  for (int k = 0; k < kBins; ++k) {
    const int left = edge(k), right = edge(k + 1);
    const int top = pixels(box.y(d.shares[static_cast<std::size_t>(k)]));
    box.canvas.fill(PixelRect{left, top, std::max(1, right - left - 1), box.plot.bottom() - top}, kBars);
  }
  box.mark(0, kFaint, 1);
  box.mark(d.mean * factor, kSimulated, 2.2);
  box.mark(d.median * factor, kObserved, 2.2);
  box.axes(chart.title, chart.label + " (" + unit + ")", "share (%)");
  const double f = kFont, line = kHeight - 0.95 * f;
  const std::string mean = "mean " + format_three_digits(d.mean * factor) + " " + unit;
  box.canvas.text(mean, {double(box.plot.left), line}, f, kSimulated, Align::left, true);
  const double next = box.plot.left + box.canvas.text_width(mean, f, true) + 1.5 * f;
  const std::string median = "median " + format_three_digits(d.median * factor) + " " + unit;
  box.canvas.text(median, {next, line}, f, kObserved, Align::left, true);
  std::string rest = format_three_digits(d.beyond) + " % beyond the ends";
  if (lod > 0) rest += "  ·  grey: mean level of detection";
  if (!chart.remarks.empty()) rest += "  ·  " + chart.remarks;
  const double room = box.plot.right() - next - box.canvas.text_width(median, f, true) - 2 * f;
  box.canvas.text(shorten(box.canvas, rest, f, room), {double(box.plot.right()), line}, f, kFaint, Align::right);
  return std::move(box.picture);
}

Picture draw_section(const SectionChart& chart) {
  double low = INFINITY, high = -INFINITY;
  for (const std::vector<double>* z : {&chart.simulated, &chart.observed})
    for (double v : *z)
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(low <= high) || chart.s.size() < 2) throw Error("render", "a section without heights");
  const double margin = std::max(0.06 * (high - low), 0.01);
  Chart box(chart.s.front(), chart.s.back(), low - margin, high + margin);
  draw_line(box, chart.s, chart.observed, kObserved);
  draw_line(box, chart.s, chart.simulated, kSimulated);
  box.axes(chart.title, "distance along the section (m)", "height (m)");
  const double f = kFont, line = kHeight - 0.95 * f;
  const std::string first = shorten(box.canvas, chart.simulated_name, f, 0.3 * box.plot.width, true);
  const std::string second = shorten(box.canvas, chart.observed_name, f, 0.3 * box.plot.width, true);
  box.canvas.text(first, {double(box.plot.left), line}, f, kSimulated, Align::left, true);
  const double next = box.plot.left + box.canvas.text_width(first, f, true) + 1.5 * f;
  box.canvas.text(second, {next, line}, f, kObserved, Align::left, true);
  const double vertical = box.plot.height / (box.y1 - box.y0), along = box.plot.width / (box.x1 - box.x0);
  box.canvas.text("heights exaggerated " + format_three_digits(vertical / along) + " times",
                  {double(box.plot.right()), line}, f, kFaint, Align::right);
  return std::move(box.picture);
}

}  // namespace scarp

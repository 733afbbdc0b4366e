// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/model/error.hpp"
#include "tools/render/canvas.hpp"
#include "tools/render/chart_picture.hpp"
#include "tools/render/map_picture.hpp"

namespace scarp {
namespace {

/// 3 x 1 cells of 10 m.
Heightfield strip(const std::vector<double>& values) { return {3, 1, 10, 5, 5, values, {}}; }

std::size_t count(const Picture& picture, bool (*is)(const Rgb8&)) {
  std::size_t n = 0;
  for (const Rgb8& c : picture.pixels) n += is(c);
  return n;
}

bool red(const Rgb8& c) { return c[0] > 110 && c[1] < 60 && c[2] < 70; }
bool blue(const Rgb8& c) { return c[0] < 60 && c[2] > 100 && c[1] < 100; }

TEST(DifferenceMap, IsRedAboveAndBlueBelow) {
  const Heightfield up = strip({1, NAN, 0.9}), down = strip({-1, NAN, -0.9});
  const Picture above = draw_difference_map({&up, nullptr, nullptr, "t", "d", ""});
  const Picture below = draw_difference_map({&down, nullptr, nullptr, "t", "d", ""});
  // The colour bar has both; a cell is a third of the map.
  EXPECT_GT(count(above, red), 20 * count(above, blue));
  EXPECT_GT(count(below, blue), 20 * count(below, red));
  EXPECT_EQ(above.pixels.size(), static_cast<std::size_t>(above.width) * above.height);
}

TEST(DifferenceMap, HasNoBlueWhereNothingIsBelow) {
  const Heightfield distances = strip({1, 0.1, 0.9}), differences = strip({1, -0.01, 0.9});
  EXPECT_EQ(count(draw_difference_map({&distances, nullptr, nullptr, "t", "d", ""}), blue), 0);
  EXPECT_GT(count(draw_difference_map({&differences, nullptr, nullptr, "t", "d", ""}), blue), 0);
}

TEST(DifferenceMap, HatchesWhatIsWithinItsLevelOfDetection) {
  const Heightfield d = strip({1, 1, 1}), none = strip({0.5, 0.5, 0.5}), all = strip({2, 2, 2});
  const std::size_t seen = count(draw_difference_map({&d, &none, nullptr, "t", "d", ""}), red);
  const std::size_t hidden = count(draw_difference_map({&d, &all, nullptr, "t", "d", ""}), red);
  EXPECT_GT(seen, 20 * hidden);
}

TEST(DifferenceMap, RefusesARasterWithoutData) {
  const Heightfield empty = strip({NAN, NAN, NAN});
  EXPECT_THROW(draw_difference_map({&empty, nullptr, nullptr, "t", "d", ""}), Error);
}

TEST(FootprintMap, HasAColourForEachKindOfCell) {
  const Heightfield cells = strip({1, 2, 3}), nothing = strip({0, 0, 0});
  const Picture map = draw_footprint_map({&cells, nullptr, "t", ""});
  const Picture bare = draw_footprint_map({&nothing, nullptr, "t", ""});
  for (const Rgb8& colour : {Rgb8{0, 114, 178}, Rgb8{230, 159, 0}, Rgb8{130, 38, 98}}) {
    const auto of = [&](const Picture& p) { return std::count(p.pixels.begin(), p.pixels.end(), colour); };
    EXPECT_GT(of(map), 20 * of(bare)) << "a third of the map, against a box of the key";
    EXPECT_GT(of(bare), 0);
  }
}

TEST(Canvas, SaysWhichFontIsMissing) {
  EXPECT_EQ(missing_font(), "");
  EXPECT_EQ(missing_font("/nowhere"), "/nowhere/DejaVuSans.ttf");
}

TEST(Pictures, CallTheSidesByTheirNames) {
  const Heightfield cells = strip({1, 2, 3});
  FootprintMap map{&cells, nullptr, "t", ""};
  const Picture usual = draw_footprint_map(map);
  map.observed = "2012";
  EXPECT_NE(draw_footprint_map(map).pixels, usual.pixels);
  SectionChart chart{{0, 1}, {0, 1}, {0, 2}, "t"};
  const Picture section = draw_section(chart);
  chart.simulated_name = "2004";
  EXPECT_NE(draw_section(chart).pixels, section.pixels);
}

TEST(Histogram, NeedsValues) {
  EXPECT_THROW(draw_histogram({{NAN, NAN}, 0, "t", "d", ""}), Error);
  // All values alike are one bar.
  const Picture one = draw_histogram({{0, 0, 0}, 0, "t", "d", ""}), two = draw_histogram({{-1, 1}, 0, "t", "d", ""});
  EXPECT_EQ(one.width, two.width);
  EXPECT_NE(one.pixels, two.pixels);
}

TEST(Histogram, BeginsAtZeroWhereNothingIsBelow) {
  const auto bars_on_the_left = [](std::vector<double> values) {
    const Picture chart = draw_histogram({std::move(values), 0, "t", "d", ""});
    std::size_t bars = 0;
    for (int y = 0; y < chart.height; ++y)
      for (int x = 0; x < chart.width / 3; ++x) bars += chart.at(x, y) == Rgb8{104, 156, 204};
    return bars;
  };
  EXPECT_GT(bars_on_the_left({0.02, 0.2, 0.3, 1}), 0u);
  EXPECT_EQ(bars_on_the_left({0.02, 0.2, 0.3, 1, -0.02}), 0u);
}

TEST(SectionChart, DrawsBothLines) {
  const Picture both = draw_section({{0, 1, 2}, {5, 6, 5}, {5, 7, NAN}, "t"});
  const Picture one = draw_section({{0, 1, 2}, {5, 6, 5}, {NAN, 7, NAN}, "t"});
  EXPECT_NE(both.pixels, one.pixels);
  EXPECT_THROW(draw_section({{0, 1}, {NAN, NAN}, {NAN, NAN}, "t"}), Error);
}

}  // namespace
}  // namespace scarp

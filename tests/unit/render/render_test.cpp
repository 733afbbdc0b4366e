// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/render.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/model/error.hpp"
#include "tools/render/colour_map.hpp"
#include "tools/render/overlay.hpp"

namespace scarp {
namespace {

/// A slab of 60 x 40 x 4 particles, 0.5 m apart, whose middle has moved.
Frame slab(double time) {
  Frame frame;
  frame.time = time;
  std::vector<float> displacement;
  std::vector<std::int32_t> material;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 60; ++i)
      for (int k = 0; k < 4; ++k) {
        const double x = 0.5 * i, y = 0.5 * j, bump = std::exp(-0.05 * ((x - 15) * (x - 15) + (y - 10) * (y - 10)));
        const float moved = static_cast<float>(2 * time * bump);
        frame.positions.push_back({x + moved, y, 0.4 * x + std::sin(x) - 0.5 * k});
        displacement.insert(displacement.end(), {moved, 0, 0});
        material.push_back(k / 2);
      }
  frame.fields = {{"displacement", "m", 3, displacement}, {"material", "1", 1, material}};
  return frame;
}

RenderContext context_of(int dimension, double spacing) {
  return {"A title", dimension, spacing, {"clay", "sand"}, {}};
}

Scene scene_of(const std::vector<Frame>& frames, const RenderOptions& options) {
  Scene scene;
  for (const Frame& frame : frames) extend_scene(scene, frame, options);
  return scene;
}

RenderOptions small_options() {
  RenderOptions options;
  options.width = 480;
  options.height = 270;
  return options;
}

TEST(Render, GivesTheSameBitsForAnyNumberOfThreads) {
  RenderOptions options = small_options();
  options.contours = 1;
  for (int dimension : {2, 3})
    for (const char* field : {"displacement", "material"}) {
      options.colour.field = field;
      const Frame frame = slab(1);
      const Scene scene = scene_of({slab(0), frame}, options);
      const Picture one = render(frame, scene, options, context_of(dimension, 0.5), 1);
      ASSERT_EQ(one.pixels.size(), 480u * 270u);
      EXPECT_EQ(one.pixels, render(frame, scene, options, context_of(dimension, 0.5), 2).pixels);
      EXPECT_EQ(one.pixels, render(frame, scene, options, context_of(dimension, 0.5), 3).pixels);
    }
}

TEST(Render, FillsTheFrame) {
  const RenderOptions options = small_options();
  const Frame frame = slab(1);
  RenderContext context = context_of(3, 0.5);
  const Picture with = render(frame, scene_of({frame}, options), options, context, 1);
  Frame empty = frame;
  empty.positions.clear();
  for (FrameField& field : empty.fields) std::visit([](auto& v) { v.clear(); }, field.values);
  const Picture without = render(empty, scene_of({frame}, options), options, context, 1);
  int left = 480, right = 0, top = 270, bottom = 0;
  for (int y = 0; y < 270; ++y)
    for (int x = 0; x < 370; ++x)
      if (with.at(x, y) != without.at(x, y)) {
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
      }
  EXPECT_TRUE(right - left > 300 || bottom - top > 190) << left << " " << right << " " << top << " " << bottom;
}

/// Pixels of exactly that colour: their number and mean position.
struct Blob {
  int count = 0;
  double x = 0, y = 0;
};

Blob find_colour(const Picture& picture, const Rgb& colour) {
  Blob blob;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Rgb8& p = picture.at(x, y);
      if (p[0] != colour[0] || p[1] != colour[1] || p[2] != colour[2]) continue;
      ++blob.count;
      blob.x += x + 0.5;
      blob.y += y + 0.5;
    }
  if (blob.count > 0) blob.x /= blob.count, blob.y /= blob.count;
  return blob;
}

/// Particles without a legend entry of their own colour: class indices 4 and 5 far from any legend.
Frame pair_of(const Vec3& a, const Vec3& b) {
  Frame frame;
  frame.positions = {a, b};
  frame.fields = {{"id", "1", 1, std::vector<std::int64_t>{0, 1}},
                  {"colour", "1", 3, std::vector<std::uint8_t>{250, 10, 20, 20, 30, 250}}};
  return frame;
}

TEST(Render, PlaneStrainShowsXToTheRightAndYUp) {
  RenderOptions options = small_options();
  options.colour.field = "colour";
  const Frame frame = pair_of({0, 0, 0}, {30, 10, 0});
  const Picture picture = render(frame, scene_of({frame}, options), options, context_of(2, 2), 1);
  const Blob red = find_colour(picture, {250, 10, 20}), blue = find_colour(picture, {20, 30, 250});
  ASSERT_GT(red.count, 20);
  ASSERT_GT(blue.count, 20);
  EXPECT_LT(red.x, blue.x);
  EXPECT_GT(red.y, blue.y);
  EXPECT_NEAR((blue.x - red.x) / (red.y - blue.y), 3, 0.05);
}

/// Length of the longest horizontal run of ink in the lowest rows: the upper edge of the scale bar.
int longest_ink_run(const Picture& picture) {
  int longest = 0;
  for (int y = picture.height - 40; y < picture.height; ++y)
    for (int x = 0, run = 0; x < picture.width; ++x) {
      run = picture.at(x, y) == Rgb8{34, 38, 43} ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  return longest;
}

TEST(Render, TheScaleBarIsAsLongAsItSays) {
  RenderOptions options = small_options();
  options.colour.field = "colour";
  options.camera.view = View::front;
  const double distance = 37;
  const Frame frame = pair_of({0, 0, 0}, {distance, 0, 0});
  const Scene scene = scene_of({frame}, options);
  const Picture picture = render(frame, scene, options, context_of(3, 4), 1);
  // Centres of the two lit spheres: where the picture is red or blue.
  double x[2] = {0, 0};
  int count[2] = {0, 0};
  for (int y = 40; y < 230; ++y)
    for (int i = 0; i < picture.width; ++i) {
      const Rgb8& p = picture.at(i, y);
      const int which = p[0] > p[2] + 60 ? 0 : p[2] > p[0] + 60 ? 1 : -1;
      if (which >= 0) x[which] += i + 0.5, ++count[which];
    }
  ASSERT_GT(std::min(count[0], count[1]), 20);
  const double pixels_per_metre = (x[1] / count[1] - x[0] / count[0]) / distance;
  EXPECT_NEAR(longest_ink_run(picture) / pixels_per_metre, 10, 0.15);
  const ScaleBar bar = choose_scale_bar(pixels_per_metre, 100);
  EXPECT_EQ(bar.label, "10 m");
  EXPECT_DOUBLE_EQ(bar.pixels, bar.metres * pixels_per_metre);
}

TEST(ScaleBarTest, IsTheLongestRoundLengthThatFits) {
  for (double scale : {1e-3, 0.37, 1.0, 4.9, 5.1, 123.0, 7e4}) {
    const ScaleBar bar = choose_scale_bar(scale, 200);
    EXPECT_LE(bar.pixels, 200.0001) << scale;
    EXPECT_GT(bar.pixels, 200 / 2.6) << scale;
  }
  EXPECT_EQ(choose_scale_bar(1000, 100).label, "10 cm");
  EXPECT_EQ(choose_scale_bar(1e-3, 100).label, "100 km");
}

TEST(Render, WhatHasNoValueIsGreyAndIsInTheKey) {
  RenderOptions options = small_options();
  options.colour.field = "pressure";
  Frame frame;
  std::vector<float> values;
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 40; ++i) {
      frame.positions.push_back({0.5 * i, 0.5 * j, 0});
      values.push_back(i < 20 ? NAN : static_cast<float>(1000 + i));
    }
  frame.fields = {{"pressure", "Pa", 1, values}};
  const Scene scene = scene_of({frame}, options);
  EXPECT_TRUE(scene.missing);
  EXPECT_DOUBLE_EQ(scene.low, 1020);
  EXPECT_DOUBLE_EQ(scene.high, 1039);
  EXPECT_GT(find_colour(render(frame, scene, options, context_of(2, 0.5), 1), kNoValue).count, 5000);
}

TEST(Render, ExaggerationMovesWhatIsDrawn) {
  RenderOptions options = small_options();
  options.exaggeration = 10;
  const Frame frame = slab(1);
  const Scene plain = scene_of({frame}, small_options()), strong = scene_of({frame}, options);
  EXPECT_DOUBLE_EQ(plain.bounds.max[2], strong.bounds.max[2]);
  EXPECT_GT(strong.bounds.max[0], plain.bounds.max[0] + 3);
  Frame without = frame;
  without.fields.erase(without.fields.begin());
  options.colour.field = "material";
  EXPECT_THROW(scene_of({without}, options), Error);
}

TEST(Render, RefusesWhatCannotBeDrawn) {
  const RenderOptions options = small_options();
  const Frame frame = slab(1);
  const Scene scene = scene_of({frame}, options);
  EXPECT_THROW(render(frame, scene, options, context_of(3, 0), 1), Error);
  EXPECT_THROW(render(frame, scene, options, context_of(3, NAN), 1), Error);
  RenderOptions wide = options;
  wide.width = 1 << 20;
  EXPECT_THROW(render(frame, scene, wide, context_of(3, 0.5), 1), Error);
  Frame broken = frame;
  broken.positions[5][1] = NAN;
  EXPECT_THROW(scene_of({broken}, options), Error);
}

/// No text and no bar may touch the border, whatever the size and however long the names.
TEST(Render, KeepsEverythingOffTheBorder) {
  RenderContext context = context_of(3, 0.5);
  context.title =
      "A title that is far too long for one line: the northern flank above the old road, dry season, run 17";
  context.materials = {"colluvium with blocks of gneiss, weathered", "b"};
  const Frame frame = slab(1);
  for (const auto& [dimension, field] : {std::pair{2, "displacement.x"}, {2, "material"}, {3, "displacement"}})
    for (const auto& [width, height] : {std::pair{160, 120}, {640, 360}, {360, 560}}) {
      RenderOptions options;
      options.width = width;
      options.height = height;
      options.colour.field = field;
      options.contours = 2;
      options.exaggeration = 1.5;
      context.dimension = dimension;
      const Picture picture = render(frame, scene_of({slab(0), frame}, options), options, context, 2);
      for (int x = 0; x < width; ++x) {
        ASSERT_EQ(picture.at(x, 0), (Rgb8{255, 255, 255})) << width << " " << field;
        ASSERT_EQ(picture.at(x, height - 1), (Rgb8{255, 255, 255})) << width << " " << field;
      }
      for (int y = 0; y < height; ++y) {
        ASSERT_EQ(picture.at(0, y), (Rgb8{255, 255, 255})) << width << " " << field << " " << dimension;
        ASSERT_EQ(picture.at(width - 1, y), (Rgb8{255, 255, 255})) << width << " " << field << " " << dimension;
      }
    }
}

TEST(Render, DrawsNothingAndOneParticleWithoutFuss) {
  const RenderOptions options = small_options();
  Frame none;
  none.fields = {{"displacement", "m", 3, std::vector<float>{}}};
  for (int dimension : {2, 3}) {
    EXPECT_NO_THROW(render(none, scene_of({none}, options), options, context_of(dimension, 1), 1));
    Frame one;
    one.positions = {{4, 5, 6}};
    one.fields = {{"displacement", "m", 3, std::vector<float>{0, 0, 0}}};
    const Picture picture = render(one, scene_of({one}, options), options, context_of(dimension, 1), 1);
    EXPECT_NE(picture.at(180, 140), (Rgb8{255, 255, 255}));
  }
}

TEST(Render, DeepZoomStaysQuick) {
  RenderOptions options = small_options();
  options.camera.zoom = 1000;
  const Frame frame = slab(1);
  EXPECT_NO_THROW(render(frame, scene_of({frame}, options), options, context_of(3, 0.5), 2));
}

TEST(TimeText, HasAsManyDecimalsAsTheFramesNeed) {
  const auto text = [](double interval, double last, double time) {
    Scene scene;
    scene.shortest_interval = interval;
    scene.last_time = last;
    return time_text(time, scene);
  };
  EXPECT_EQ(text(0.5, 20, 12.5), "t = 12.5 s");
  EXPECT_EQ(text(5, 100, 15), "t = 15 s");
  EXPECT_EQ(text(0.05, 3.5, 0.35), "t = 0.35 s");
  EXPECT_EQ(text(0.0001, 0.02, 0.0105), "t = 10.5 ms");
  EXPECT_EQ(text(0, 0, 0), "t = 0.00 s");
}

}  // namespace
}  // namespace scarp

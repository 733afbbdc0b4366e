// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/splat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "solver/model/error.hpp"
#include "tools/render/camera.hpp"

namespace scarp {
namespace {

ColourField classes(std::vector<std::int32_t> indices) {
  ColourField field;
  field.kind = ColourKind::classes;
  field.classes = std::move(indices);
  return field;
}

ColourField scalars(std::vector<float> values) {
  ColourField field;
  field.values = std::move(values);
  return field;
}

TEST(Camera, LooksFromWhereTheCompassSays) {
  CameraOptions options;
  options.view = View::front;  // from -y: x to the right, z up
  EXPECT_NEAR(view_axes(options, 3).right[0], 1, 1e-12);
  EXPECT_NEAR(view_axes(options, 3).up[2], 1, 1e-12);
  EXPECT_NEAR(view_axes(options, 3).towards[1], -1, 1e-12);
  options.view = View::side;  // from +x: y to the right
  EXPECT_NEAR(view_axes(options, 3).right[1], 1, 1e-12);
  EXPECT_NEAR(view_axes(options, 3).towards[0], 1, 1e-12);
  options.view = View::top;  // x to the right, y up
  EXPECT_NEAR(view_axes(options, 3).right[0], 1, 1e-12);
  EXPECT_NEAR(view_axes(options, 3).up[1], 1, 1e-12);
  options = {};
  options.azimuth = 45;  // from the north-east and above
  options.elevation = 30;
  const ViewAxes oblique = view_axes(options, 3);
  EXPECT_NEAR(oblique.towards[0], std::cos(std::numbers::pi / 6) / std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(oblique.towards[1], oblique.towards[0], 1e-12);
  EXPECT_NEAR(oblique.towards[2], 0.5, 1e-12);
  EXPECT_GT(oblique.up[2], 0);
  EXPECT_NEAR(dot(oblique.right, oblique.up), 0, 1e-12);
  EXPECT_NEAR(view_axes(options, 2).up[1], 1, 1e-12);
}

TEST(Camera, PutsAPointOnTheExpectedPixel) {
  CameraOptions options;
  options.view = View::front;
  const Box3 view{{0, 0, -5}, {40, 10, 5}};  // 40 m x 10 m as seen
  const Camera camera = fit_camera(view_axes(options, 3), view, 0, {100, 50, 400, 300}, 1);
  EXPECT_DOUBLE_EQ(camera.scale, 10);
  const Vec3 corner = camera.project({0, 5, 10});  // upper left of the box; y is depth
  EXPECT_NEAR(corner[0], 100, 1e-9);
  EXPECT_NEAR(corner[1], 150, 1e-9);
  EXPECT_NEAR(corner[2], -50, 1e-9);
  const Vec3 middle = camera.project({20, 0, 5});
  EXPECT_NEAR(middle[0], 300, 1e-9);
  EXPECT_NEAR(middle[1], 200, 1e-9);
}

TEST(Splats, ASingleOneIsADiscAroundItsCentre) {
  const Layer layer = draw_splats({{50.25f, 30.5f, 0}}, 6, 100, 60, classes({0}), {}, false, 1);
  double area = 0, x = 0, y = 0;
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 100; ++i) {
      const double c = layer.cover[layer.index(i, j)];
      area += c;
      x += c * (i + 0.5);
      y += c * (j + 0.5);
    }
  EXPECT_NEAR(area, std::numbers::pi * 36, 2);
  EXPECT_NEAR(x / area, 50.25, 0.1);
  EXPECT_NEAR(y / area, 30.5, 0.1);
}

TEST(Splats, TheNearerOneWinsWhateverTheOrder) {
  for (bool swapped : {false, true}) {
    const std::vector<Splat> splats{{20, 20, swapped ? 9.0f : -9.0f}, {22, 20, swapped ? -9.0f : 9.0f}};
    for (bool blend : {false, true}) {
      const Layer layer = draw_splats(splats, 8, 40, 40, classes({1, 2}), {}, blend, 1);
      EXPECT_EQ(layer.colour[layer.index(21, 20)], class_colour(swapped ? 1 : 2));
    }
  }
}

TEST(Splats, EquallyNearOnesMeetInTheMiddle) {
  const Layer layer = draw_splats({{16, 20, 0}, {26, 20, 0}}, 8, 40, 40, classes({1, 2}), {}, false, 1);
  EXPECT_EQ(layer.colour[layer.index(20, 20)], class_colour(1));
  EXPECT_EQ(layer.colour[layer.index(21, 20)], class_colour(2));
}

/// Tiles, sorting and early ends must not change what a plain z-buffer shows.
TEST(Splats, AgreeWithAPlainDepthBuffer) {
  std::mt19937 random(7);
  std::vector<Splat> splats;
  std::vector<std::int32_t> index;
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random()) / static_cast<float>(std::mt19937::max());
  };
  for (int i = 0; i < 20000; ++i) {
    splats.push_back({uniform(-10, 110), uniform(-10, 80), uniform(-60, 60)});
    index.push_back(i % 12);
  }
  const float radius = 3.3f, wide = radius * 1.125f;
  const Layer layer = draw_splats(splats, radius, 100, 70, classes(index), {}, true, 2);
  int compared = 0;
  for (int y = 1; y < 70; y += 5)
    for (int x = 1; x < 100; x += 3) {
      std::set<std::int32_t> seen;
      for (float sy : {0.25f, 0.75f})
        for (float sx : {0.25f, 0.75f}) {
          float best = -INFINITY;
          std::int32_t winner = -1;
          for (std::size_t i = 0; i < splats.size(); ++i) {
            const float dx = x + sx - splats[i].x, dy = y + sy - splats[i].y,
                        rho2 = (dx * dx + dy * dy) / (wide * wide);
            const float depth = splats[i].z + wide * (1 - rho2);
            if (rho2 <= 1 && depth > best) best = depth, winner = index[i];
          }
          seen.insert(winner);
        }
      if (seen.size() != 1 || *seen.begin() < 0) continue;
      EXPECT_EQ(layer.colour[layer.index(x, y)], class_colour(*seen.begin())) << x << ", " << y;
      ++compared;
    }
  EXPECT_GT(compared, 80);
}

TEST(Splats, HaveNoHolesOnALattice) {
  std::vector<Splat> splats;
  for (int j = 0; j < 30; ++j)
    for (int i = 0; i < 30; ++i) splats.push_back({10 + 3.7f * i, 10 + 3.7f * j, 0.4f * i});
  const Layer layer = draw_splats(splats, 0.85f * 3.7f, 130, 130, scalars(std::vector<float>(900, 1)), {}, true, 1);
  for (int y = 12; y < 115; ++y)
    for (int x = 12; x < 115; ++x) ASSERT_EQ(layer.cover[layer.index(x, y)], 1) << x << ", " << y;
}

TEST(Splats, RefuseACloudThatCollapsedToAPoint) {
  const std::vector<Splat> splats(200000, Splat{500, 500, 0});
  EXPECT_THROW(draw_splats(splats, 500, 1000, 1000, classes(std::vector<std::int32_t>(200000, 0)), {}, false, 1),
               Error);
}

TEST(Surface, ATiltedLatticeBecomesItsPlane) {
  std::vector<Splat> splats;
  std::vector<float> values;
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 60; ++i) {
      const float x = 10 + 2.5f * i, y = 10 + 2.5f * j;
      splats.push_back({x, y, 0.3f * x - 0.2f * y});
      values.push_back(2 * x + y);
    }
  Layer layer = draw_splats(splats, 0.85f * 2.5f, 170, 170, scalars(values), {}, true, 1);
  smooth_surface(layer, 2.5, 2);
  for (int y = 22; y < 146; ++y)
    for (int x = 22; x < 146; ++x) {
      const std::size_t i = layer.index(x, y);
      ASSERT_NEAR(layer.slope_x[i], 0.3, 0.03) << x << ", " << y;
      ASSERT_NEAR(layer.slope_y[i], -0.2, 0.03);
      ASSERT_NEAR(layer.value[i], 2 * (x + 0.5) + y + 0.5, 2);
    }
}

TEST(Surface, DoesNotCrossAnEdge) {
  // Two level sheets, one 100 pixels above the other, meet at x = 80.
  std::vector<Splat> splats;
  std::vector<float> values;
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 60; ++i) {
      splats.push_back({6 + 2.5f * i, 6 + 2.5f * j, i < 30 ? 100.0f : 0.0f});
      values.push_back(i < 30 ? 1.0f : 3.0f);
    }
  Layer layer = draw_splats(splats, 2.2f, 160, 160, scalars(values), {}, true, 1);
  smooth_surface(layer, 2.5, 1);
  for (int x : {60, 70, 77, 90, 100}) {
    EXPECT_NEAR(layer.slope_x[layer.index(x, 80)], 0, 0.05) << x;
    EXPECT_NEAR(layer.value[layer.index(x, 80)], x < 80 ? 1 : 3, 0.02) << x;
  }
}

TEST(Surface, ValuesOfTwoBodiesAreNotBlended) {
  std::vector<Splat> splats;
  ColourField field;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 40; ++i) {
      splats.push_back({6 + 2.5f * i, 6 + 2.5f * j, 0});
      field.values.push_back(i < 20 ? 0.0f : 200.0f);
    }
  const auto between = [&] {
    Layer layer = draw_splats(splats, 2.2f, 110, 110, field, {}, true, 1);
    smooth_surface(layer, 2.5, 1);
    return std::count_if(layer.value.begin(), layer.value.end(), [](float v) { return v > 0.5f && v < 199.5f; });
  };
  EXPECT_GT(between(), 100);
  for (float value : field.values) field.bodies.push_back(value > 0);
  EXPECT_EQ(between(), 0);
}

TEST(Surface, PointsWithoutAValueStayWithoutAndSpoilNoOthers) {
  std::vector<Splat> splats;
  std::vector<float> values;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 40; ++i) {
      splats.push_back({6 + 2.5f * i, 6 + 2.5f * j, 0});
      values.push_back(i < 20 ? NAN : 4.0f);
    }
  Layer layer = draw_splats(splats, 2.2f, 110, 110, scalars(values), {}, true, 1);
  smooth_surface(layer, 2.5, 1);
  EXPECT_TRUE(std::isnan(layer.value[layer.index(30, 50)]));
  for (int x = 57; x < 100; ++x) EXPECT_NEAR(layer.value[layer.index(x, 50)], 4, 1e-4) << x;
}

TEST(Outline, OfARowOfDiscsBecomesStraight) {
  std::vector<Splat> splats;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 20; ++i) splats.push_back({10 + 8.0f * i, 60 + 8.0f * j, 0});
  Layer layer = draw_splats(splats, 0.72f * 8, 180, 170, classes(std::vector<std::int32_t>(240, 0)), {}, false, 1);
  const auto spread = [&] {
    double low = INFINITY, high = -INFINITY;
    for (int x = 40; x < 140; ++x) {
      double height = 0;
      for (int y = 0; y < 100; ++y) height += layer.cover[layer.index(x, y)];
      low = std::min(low, height);
      high = std::max(high, height);
    }
    return std::pair{high - low, 100 - 0.5 * (low + high)};
  };
  EXPECT_GT(spread().first, 0.9);
  smooth_outline(layer, 8, 2);
  EXPECT_LT(spread().first, 0.2);
  EXPECT_NEAR(spread().second, 60 - 4, 0.6);  // half a spacing outside of the outermost centres
}

}  // namespace
}  // namespace scarp

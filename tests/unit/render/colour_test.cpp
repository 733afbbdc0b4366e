// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "solver/model/error.hpp"
#include "tools/render/colour_field.hpp"
#include "tools/render/colour_key.hpp"
#include "tools/render/colour_map.hpp"

namespace scarp {
namespace {

ColourScale scale_of(ColourMap map, double low, double high, int bands = 0) {
  return ColourScale{.low = low, .high = high, .bands = bands, .threshold = {}, .fade = 0, .table = colour_table(map)};
}

Rgb as_float(const Rgb8& c) { return {float(c[0]), float(c[1]), float(c[2])}; }

TEST(ColourMaps, HaveTheirPublishedEnds) {
  const auto batlow = colour_table(ColourMap::batlow);
  EXPECT_EQ(batlow.front(), (Rgb8{1, 25, 89}));
  EXPECT_EQ(batlow.back(), (Rgb8{250, 204, 250}));
  // The colour in the middle, (0.51125, 0.5109, 0.1933), lies between two control points.
  EXPECT_NEAR(batlow[128][0], 130, 1);
  EXPECT_NEAR(batlow[128][1], 130, 1);
  EXPECT_NEAR(batlow[128][2], 49, 1);
  const auto viridis = colour_table(ColourMap::viridis);
  EXPECT_EQ(viridis.front(), (Rgb8{68, 1, 84}));
  EXPECT_NEAR(viridis.back()[0], 253, 1);
  EXPECT_NEAR(viridis.back()[1], 231, 1);
  EXPECT_NEAR(viridis.back()[2], 37, 1);
}

TEST(ColourMaps, DifferFromEachOther) {
  std::set<Rgb8> middles;
  for (const auto& [name, map] : enum_names<ColourMap>::value) middles.insert(colour_table(map)[100]);
  EXPECT_EQ(middles.size(), enum_names<ColourMap>::value.size());
}

TEST(ColourScale, MapsTheEndsAndClampsBeyondThem) {
  const ColourScale scale = scale_of(ColourMap::viridis, -2, 6);
  EXPECT_EQ(scale(-2), as_float(scale.table.front()));
  EXPECT_EQ(scale(6), as_float(scale.table.back()));
  EXPECT_EQ(scale(-99), scale(-2));
  EXPECT_EQ(scale(99), scale(6));
  EXPECT_EQ(scale(2), as_float(scale.table[128]));
}

TEST(ColourScale, WhatIsNoNumberIsGrey) {
  const ColourScale scale = scale_of(ColourMap::viridis, 0, 1);
  EXPECT_EQ(scale(NAN), kNoValue);
  EXPECT_EQ(scale(INFINITY), kNoValue);
  EXPECT_EQ(scale(-INFINITY), kNoValue);
}

TEST(ColourScale, BandsAreFlatAndUseTheWholeMap) {
  const ColourScale scale = scale_of(ColourMap::batlow, 0, 10, 5);
  std::set<Rgb> colours;
  for (int i = 0; i <= 1000; ++i) colours.insert(scale(i * 0.01));
  EXPECT_EQ(colours.size(), 5u);
  EXPECT_EQ(scale(0.1), scale(1.99));
  EXPECT_NE(scale(1.99), scale(2.0));
  EXPECT_EQ(scale(0.1), as_float(scale.table.front()));
  EXPECT_EQ(scale(10), as_float(scale.table.back()));
}

TEST(ColourScale, ShowsTheGroundBelowTheThreshold) {
  ColourScale scale = scale_of(ColourMap::batlow, 0, 10);
  scale.threshold = 2;
  EXPECT_EQ(scale(1.999), kGround);
  EXPECT_EQ(scale(2), scale_of(ColourMap::batlow, 0, 10)(2));
}

Frame two_points() {
  Frame frame;
  frame.positions = {{0, 0, 0}, {1, 0, 0}};
  frame.fields = {{"stress", "Pa", 6, std::vector<float>{-3e3f, -3e3f, -3e3f, 4e3f, 0, 0, 100, 0, 0, 0, 0, 0}},
                  {"velocity", "m/s", 3, std::vector<float>{3, 4, 0, 0, 0, -2}},
                  {"material", "1", 1, std::vector<std::int32_t>{0, 7}},
                  {"colour", "1", 3, std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}},
                  {"deformation_gradient", "1", 9, std::vector<float>(18, 1)}};
  return frame;
}

TEST(ColourField, ReducesTensorsAndVectors) {
  const Frame frame = two_points();
  const ColourField stress = evaluate_field(frame, "stress", 1);
  EXPECT_EQ(stress.label, "Von Mises stress");
  EXPECT_NEAR(stress.values[0], std::sqrt(3.0) * 4e3, 1e-2);  // pure shear and pressure: sqrt(3) tau
  EXPECT_NEAR(stress.values[1], 100, 1e-4);                   // uniaxial
  const ColourField speed = evaluate_field(frame, "velocity", 2);
  EXPECT_EQ(speed.values, (std::vector<float>{5, 2}));
  EXPECT_EQ(evaluate_field(frame, "velocity.z", 1).values, (std::vector<float>{0, -2}));
  EXPECT_EQ(evaluate_field(frame, "stress.xy", 1).values, (std::vector<float>{4e3f, 0}));
  EXPECT_EQ(evaluate_field(frame, "material", 1).kind, ColourKind::classes);
  EXPECT_EQ(evaluate_field(frame, "colour", 1).colours[1], (Rgb8{4, 5, 6}));
}

std::string message_of(const Frame& frame, const std::string& field) {
  try {
    evaluate_field(frame, field, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(ColourField, SaysWhatThereIsInsteadOfAnUnknownField) {
  Frame frame = two_points();
  EXPECT_NE(message_of(frame, "displacment").find("velocity"), std::string::npos);
  EXPECT_NE(message_of(frame, "velocity.xx").find("x, y, z"), std::string::npos);
  EXPECT_NE(message_of(frame, "deformation_gradient").find("deformation_gradient.xx"), std::string::npos);
  frame.positions.push_back({2, 0, 0});
  EXPECT_NE(message_of(frame, "velocity").find("number of values"), std::string::npos);
}

/// A scene as extend_scene leaves it.
Scene scene_with(const std::vector<float>& values) {
  Scene scene;
  for (float v : values) {
    scene.low = scene.any ? std::min(scene.low, double(v)) : v;
    scene.high = scene.any ? std::max(scene.high, double(v)) : v;
    scene.any = true;
    count_value(scene.histogram, v);
  }
  return scene;
}

ColourKey key_of(const Scene& scene, const ColourOptions& options) {
  const ColourField field{ColourKind::scalar, "Displacement", "m", {}, {}, {}, {}};
  return make_colour_key(scene, field, options, {});
}

TEST(ColourKey, TakesTheRangeOfAllFramesRoundedOutwards) {
  const ColourKey key = key_of(scene_with({0.01f, 3.0f, 9.37f}), {});
  EXPECT_DOUBLE_EQ(key.scale.low, 0);
  EXPECT_DOUBLE_EQ(key.scale.high, 9.5);
  EXPECT_FALSE(key.below || key.above);
}

TEST(ColourKey, LeavesAFewStraysBeyondTheEnds) {
  std::vector<float> values;
  for (int i = 0; i < 50000; ++i) values.push_back(static_cast<float>(i % 1000) * 0.01f);
  values.push_back(4000);
  values.push_back(-7000);
  const ColourKey key = key_of(scene_with(values), {});
  EXPECT_LT(key.scale.high, 11);
  EXPECT_GT(key.scale.low, -1);
  EXPECT_TRUE(key.below && key.above);
}

TEST(ColourKey, KeepsASlideThatIsASmallPartOfTheSite) {
  std::vector<float> values(50000, 0.0f);
  for (int i = 0; i < 200; ++i) values.push_back(5.0f);
  EXPECT_DOUBLE_EQ(key_of(scene_with(values), {}).scale.high, 5);
}

TEST(ColourKey, BandsHaveRoundEdges) {
  ColourOptions options;
  options.bands = 6;
  const ColourKey key = key_of(scene_with({0.0f, 9.2f}), options);
  EXPECT_DOUBLE_EQ(key.scale.high, 12);
  ASSERT_EQ(key.ticks.values.size(), 7u);
  EXPECT_DOUBLE_EQ(key.ticks.values[1], 2);
}

TEST(ColourKey, CopesWithOneValueAndWithNone) {
  for (const std::vector<float>& values : {std::vector<float>{}, {0.0f}, {1900.0f, 1900.0f}, {-5e-12f}}) {
    const ColourKey key = key_of(scene_with(values), {});
    EXPECT_LT(key.scale.low, key.scale.high);
    EXPECT_GE(key.ticks.values.size(), 1u);
    for (float v : values) EXPECT_TRUE(key.scale.low <= v && v <= key.scale.high);
  }
}

TEST(ColourKey, RefusesARangeThatDoesNotIncrease) {
  ColourOptions options;
  options.range = Vec2{10, 10};
  EXPECT_THROW(key_of(scene_with({1.0f}), options), Error);
  options.range = Vec2{0, NAN};
  EXPECT_THROW(key_of(scene_with({1.0f}), options), Error);
  options.range = Vec2{0, 2};
  const ColourKey key = key_of(scene_with({1.0f, 3.0f}), options);
  EXPECT_DOUBLE_EQ(key.scale.high, 2);
  EXPECT_TRUE(key.above);
}

}  // namespace
}  // namespace scarp

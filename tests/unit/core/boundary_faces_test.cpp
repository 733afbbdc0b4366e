// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces and damping on plain arrays of nodes, without any body.
#include <gtest/gtest.h>

#include <limits>

#include "solver/core/node_conditions.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr double kDt = 0.01;

/// One node of 2 kg on the floor of a unit square.
struct Floor {
  explicit Floor(Face face, bool carried = false, std::uint8_t held_for_good = 0)
      : held(1, held_for_good), held_now(held) {
    domain.dimension = 2;
    domain.cell = 0.5;
    domain.max = {1, 1, 0};
    domain.faces[2] = face;
    faces = NodeFaces(domain, domain.cell, {{0.5, 0, 0}}, held, {{20, 10}}, carried);
  }
  NodeWork act(const Vec3& v, const Vec3& trial) {
    before = v;
    after = trial;
    return faces.act({1, &mass, &before, &after, kDt, 0}, held_now);
  }

  Domain domain;
  std::vector<std::uint8_t> held, held_now;
  NodeFaces faces;
  double mass = 2;
  Vec3 before{0, 0, 0}, after{0, 0, 0};
};

TEST(NodeFaces, OnlyFrictionAndDashpotsMakeAny) {
  for (const Face face : {Face(FaceCondition::free), Face(FaceCondition::roller), Face(FaceCondition::fixed)})
    EXPECT_TRUE(Floor(face).faces.empty());
  EXPECT_FALSE(Floor(Face(FaceCondition::friction, 0.5)).faces.empty());
  Domain domain{2, 0.5, {0, 0, 0}, {1, 1, 0}, {}};
  domain.faces[3] = FaceCondition::absorbing;
  EXPECT_TRUE(NodeFaces(domain, 0.5, {{0.5, 0.5, 0}}, {0}, {{1, 1}}, false).empty());
  EXPECT_FALSE(NodeFaces(domain, 0.5, {{0.5, 1, 0}}, {0}, {{1, 1}}, false).empty());
}

TEST(NodeFaces, FrictionSticks) {
  Floor floor(Face(FaceCondition::friction, 0.5));
  const NodeWork work = floor.act({0, 0, 0}, {0.19, -0.4, 0});  // 0.5 * 0.4 = 0.2 would stop that much
  EXPECT_EQ(floor.after, (Vec3{0, 0, 0}));
  EXPECT_EQ(floor.held_now[0], 7);
  EXPECT_EQ(work.friction, 0);
}

TEST(NodeFaces, FrictionSlides) {
  Floor floor(Face(FaceCondition::friction, 0.5));
  const NodeWork work = floor.act({1, 0, 0}, {1.1, -0.4, 0});
  EXPECT_DOUBLE_EQ(floor.after[0], 0.9);
  EXPECT_EQ(floor.after[1], 0);
  EXPECT_EQ(floor.held_now[0], 2);
  EXPECT_DOUBLE_EQ(work.friction, 2 * 0.2 * 0.5 * (1 + 0.9));  // impulse times mean velocity
}

TEST(NodeFaces, FrictionNeverPulls) {
  Floor floor(Face(FaceCondition::friction, 0.5), false, 0);
  floor.act({0, 0, 0}, {0, -1, 0});
  EXPECT_EQ(floor.held_now[0], 7);
  const NodeWork work = floor.act({0, 0, 0}, {0.3, 0.2, 0});
  EXPECT_EQ(floor.after, (Vec3{0.3, 0.2, 0}));
  EXPECT_EQ(floor.held_now[0], 0);
  EXPECT_EQ(work.friction, 0);
}

TEST(NodeFaces, WithoutFrictionAFaceIsAOneSidedRoller) {
  Floor floor(Face(FaceCondition::friction, 0));
  floor.act({0, 0, 0}, {0.3, -0.2, 0});
  EXPECT_EQ(floor.after, (Vec3{0.3, 0, 0}));
  floor.act({0, 0, 0}, {0, -0.2, 0});
  EXPECT_EQ(floor.held_now[0], 2);
}

TEST(NodeFaces, ACarriedNodeActsAgainOnceItsGapHasClosed) {
  Floor floor(Face(FaceCondition::friction, 0), true);
  floor.act({0, 0, 0}, {0, 1, 0});  // opens dt * 1
  floor.act({0, 1, 0}, {0, -0.25, 0});
  EXPECT_EQ(floor.after[1], -0.25);
  EXPECT_EQ(floor.held_now[0], 0);
  floor.act({0, 0, 0}, {0, -2, 0});  // dt * 0.75 is left
  EXPECT_DOUBLE_EQ(floor.after[1], -0.75);
  floor.act({0, 0, 0}, {0, -2, 0});
  EXPECT_NEAR(floor.after[1], 0, 1e-12);
}

TEST(NodeFaces, DashpotsSlowByTheImpedance) {
  Floor floor(FaceCondition::absorbing);
  const NodeWork work = floor.act({1, 1, 0}, {1, 1, 0});
  const double across = 1 / (1 + kDt * 2 * 10 / 0.5), normal = 1 / (1 + kDt * 2 * 20 / 0.5);
  EXPECT_DOUBLE_EQ(floor.after[0], across);
  EXPECT_DOUBLE_EQ(floor.after[1], normal);
  // m / 2 (v^2 - v~^2), as nothing else acts
  EXPECT_DOUBLE_EQ(work.damping, 2 - across * across - normal * normal);
}

TEST(NodeFaces, WhatHeldStillStaysAtRest) {
  Floor floor(FaceCondition::absorbing);
  floor.faces.hold_still(true);
  const Vec3 loaded{0.01, -0.1, 0};  // dt f / m
  EXPECT_EQ(floor.act({0, 0, 0}, loaded).damping, 0);
  EXPECT_EQ(floor.after, (Vec3{0, 0, 0}));
  EXPECT_EQ(floor.held_now[0], 7);
  floor.faces.hold_still(false);
  Vec3 pushed = loaded;
  const Vec3 before{0, 0, 0};
  floor.faces.push({1, &floor.mass, &before, &pushed, kDt, 0});
  floor.act(before, pushed);
  EXPECT_NEAR(norm(floor.after), 0, 1e-16);
  EXPECT_EQ(floor.held_now[0], 0);
}

TEST(NodeFaces, HeldForGoodStaysHeld) {
  for (const Face face : {Face(FaceCondition::friction, 0.5), Face(FaceCondition::absorbing)}) {
    Floor floor(face, true, 1);
    floor.act({0, 0, 0}, {0, 0.5, 0});
    EXPECT_EQ(floor.held_now[0] & 1, 1);
    EXPECT_EQ(floor.after[0], 0);
  }
}

TEST(NodeFaces, NodesWithoutMassAreLeftAlone) {
  Floor floor(Face(FaceCondition::friction, 0.5));
  floor.mass = 0;
  floor.act({0, 0, 0}, {1, -1, 0});
  EXPECT_EQ(floor.after, (Vec3{1, -1, 0}));
}

TEST(NodeFaces, RefusesAWrongCoefficient) {
  for (double mu : {-0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(Floor(Face(FaceCondition::friction, mu)), Error);
}

TEST(DampNodes, TakesAShareOfTheForceAgainstTheVelocity) {
  const std::vector<double> mass{2, 2, 0};
  const std::vector<Vec3> before{{1, -1, 0}, {0, 0, 0}, {1, 1, 1}};
  std::vector<Vec3> after{{1.5, -0.5, 0.1}, {0.5, 0, 0}, {2, 2, 2}};
  const double lost = damp_nodes({3, mass.data(), before.data(), after.data(), kDt, 0}, 0.4, 1);
  EXPECT_DOUBLE_EQ(after[0][0], 1.5 - 0.2);
  EXPECT_DOUBLE_EQ(after[0][1], -0.5 + 0.2);
  EXPECT_EQ(after[0][2], 0.1);
  EXPECT_EQ(after[1], (Vec3{0.5, 0, 0}));  // what rests is let go
  EXPECT_EQ(after[2], (Vec3{2, 2, 2}));
  EXPECT_DOUBLE_EQ(lost, 2 * 0.2 * (0.5 * (1 + 1.3) + 0.5 * (1 + 0.3)));
}

TEST(ActOnNodes, SameBitsForAnyNumberOfThreads) {
  std::vector<double> lost;
  for (int threads : {1, 2, 3}) {
    std::vector<double> mass(10000, 1.0);
    std::vector<Vec3> before(mass.size()), after(mass.size());
    for (std::size_t i = 0; i < mass.size(); ++i) {
      before[i] = {std::sin(1.0 * i), std::cos(2.0 * i), 0.1};
      after[i] = {std::sin(3.0 * i), std::cos(5.0 * i), -0.1};
    }
    std::vector<std::uint8_t> held_now(mass.size(), 0);
    NodeConditions conditions;
    conditions.damping = 0.3;
    const NodeWork work = act_on_nodes(conditions, {mass.size(), mass.data(), before.data(), after.data(), kDt, 0},
                                       held_now, {0, 0, 3}, threads);
    lost.insert(lost.end(), {work.damping, work.external});
  }
  EXPECT_NE(lost[0], 0);
  EXPECT_NE(lost[1], 0);
  for (std::size_t i = 2; i < lost.size(); ++i) EXPECT_EQ(lost[i], lost[i % 2]);
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rigid bodies in contact: their surfaces, their mass, and what they do to others.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "solver/core/mass_properties.hpp"
#include "solver/core/rigid_bodies.hpp"
#include "solver/core/run.hpp"
#include "solver/core/surface_points.hpp"
#include "solver/materials/tensor.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/rigid_seed.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

using std::numbers::pi;
using test::seed_rigid_box;

RigidOptions moving(RigidMotion motion, const RigidSurface& surface = {false, 0}) {
  RigidOptions options;
  options.motion = motion;
  options.surface = surface;
  return options;
}

TEST(TriangleTree, FindsTheNearestOfTheTrianglesThatFaceAWay) {
  const TriangleMesh mesh = sphere_mesh({0, 0, 0}, 1, 0.01);
  const TriangleTree tree(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-2, 2);
  const Vec3 facing{0.6, 0, 0.8};
  for (int i = 0; i < 200; ++i) {
    const Vec3 p{any(random), any(random), any(random)};
    double best = INFINITY;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!(dot(tree.face_normal(t), facing) > 0.7)) continue;
      const auto& v = mesh.triangles[t];
      best = std::min(
          best, closest_on_triangle(p, mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]).squared_distance);
    }
    ASSERT_EQ(tree.closest_facing(p, INFINITY, facing, 0.7)->squared_distance, best);
  }
  EXPECT_FALSE(TriangleTree(prism_mesh({{0, 0}, {1, 0}, {0, 1}}, 1)).closest_facing({0, 0, 0}, 9, {0, 0, 1}, 0.5));
}

TEST(SignedDistance, KnowsWhereAWayGoesIn) {
  const SignedDistance box(box_mesh({{0, 0, 0}, {1, 1, 1}})), ball(sphere_mesh({0.5, 0.5, 0.5}, 0.5, 0.01), 0.5);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.25, 0.75);
  for (int i = 0; i < 500; ++i) {
    const Vec3 below{any(random), any(random), -2 * any(random)}, above{any(random), any(random), 3};
    EXPECT_NEAR((*box.entered(below, above))[2], -1, 1e-15);
    EXPECT_NEAR((*box.entered(above, below))[2], 1, 1e-15);
    EXPECT_LT((*ball.entered(below, above))[2], -0.5);
    EXPECT_GT((*ball.entered(above, below))[2], 0.5);
    for (const SignedDistance* surface : {&box, &ball}) {
      EXPECT_FALSE(surface->entered({0.5, 0.5, 0.5}, above).has_value()) << "goes out";
      EXPECT_FALSE(surface->entered(below, {below[0], below[1], -0.001}).has_value()) << "stops before";
      EXPECT_FALSE(surface->entered(below + Vec3{2, 0, 0}, above + Vec3{2, 0, 0}).has_value()) << "passes by";
    }
  }
  EXPECT_TRUE(box.entered({0.5, 0.5, -1}, {0.5, 0.5, 1e-300}).has_value()) << "by an edge between two triangles";
}

/// Seen from the sheet that it went in by, a point sinks ever deeper, until it leaves the sheet beyond its rim.
TEST(SignedDistance, KeepsTheSheetOfAThinPlate) {
  for (int dimension : {2, 3}) {
    const SignedDistance plate(dimension == 3 ? box_mesh({{0, 0, 0}, {2, 0.01, 2}})
                                              : prism_mesh({{0, 0}, {2, 0}, {2, 0.01}, {0, 0.01}}, 1));
    const double z = dimension == 3 ? 1.3 : 0;
    const Vec3 up{0, 1, 0};
    for (double depth : {-0.3, -0.001, 0.001, 0.009, 0.02, 0.3}) {
      const auto foot = plate.at_sheet({0.7, 0.01 - depth, z}, up);
      ASSERT_TRUE(foot.has_value());
      EXPECT_NEAR(foot->distance, -depth, 1e-14);
      EXPECT_NEAR(foot->normal[1], 1, 1e-12);
    }
    EXPECT_FALSE(plate.at_sheet({-0.1, -0.05, z}, up).has_value()) << "beside the rim";
    EXPECT_NEAR(plate.at_sheet({-0.1, 0.05, z}, up)->distance, std::hypot(0.1, 0.04), 1e-14) << "above it";
  }
  // A valley's ground is one sheet, also below its bottom.
  const SignedDistance valley(prism_mesh({{-2, -1}, {2, -1}, {2, 2}, {0, 0}, {-2, 2}}, 1));
  EXPECT_NEAR(valley.at_sheet({0, -0.1, 0}, {0, 1, 0})->distance, -0.1, 1e-12);
  EXPECT_NEAR(valley.at_sheet({0.02, -0.1, 0}, {0, 1, 0})->distance, -std::hypot(0.02, 0.1), 1e-12);
}

TEST(MassProperties, AreExact) {
  const Box3 box{{1, 2, 3}, {2, 4, 6}};
  const MassProperties brick = mass_properties(box_mesh(box), 0, 2, 3);
  EXPECT_NEAR(brick.mass, 12, 1e-12);
  EXPECT_LT(norm(brick.centre - Vec3{1.5, 3, 4.5}), 1e-13);
  Vec3 moments = brick.moments;
  std::sort(moments.begin(), moments.end());
  EXPECT_LT(norm(moments - Vec3{1 + 4, 1 + 9, 4 + 9}), 1e-11);
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis{brick.axes[k], brick.axes[3 + k], brick.axes[6 + k]};
    EXPECT_NEAR(
        *std::max_element(axis.begin(), axis.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }),
        axis[0] + axis[1] + axis[2], 1e-9)
        << "along an edge of the brick";
  }
  EXPECT_NEAR(determinant(brick.axes), 1, 1e-12);
  const MassProperties sphere = mass_properties(sphere_mesh({1, 1, 1}, 2, 0.0001), 0, 1, 3);
  const MassProperties ball = mass_properties(sphere_mesh({1, 1, 1}, 2, 0.1), 2, 1, 3);
  EXPECT_NEAR(ball.mass, 32 * pi / 3, 1e-12);
  EXPECT_NEAR(ball.moments[1], 0.4 * ball.mass * 4, 1e-11);
  EXPECT_NEAR(sphere.mass, ball.mass, 1e-3 * ball.mass);
  EXPECT_NEAR(sphere.moments[2], ball.moments[2], 1e-3 * ball.moments[2]);
  // An L in the plane: two rectangles.
  const MassProperties ell =
      mass_properties(prism_mesh({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}, 0.7), 0, 5, 2);
  EXPECT_NEAR(ell.mass, 20, 1e-12);
  EXPECT_LT(norm(ell.centre - Vec3{(3 * 1.5 + 0.5) / 4, (3 * 0.5 + 1.5) / 4, 0}), 1e-13);
  const double about_origin = 5 * (9 + 1 + 1.0 / 3 + 7.0 / 3);
  EXPECT_NEAR(ell.moments[2], about_origin - 20 * dot(ell.centre, ell.centre), 1e-11);
  const MassProperties disk = mass_properties(prism_mesh(circle_outline({4, 5}, 2, 0.1), 1), 2, 3, 2);
  EXPECT_NEAR(disk.moments[2], 0.5 * disk.mass * 4, 1e-12);
}

TEST(SurfacePoints, ShareTheSurface) {
  const SurfacePoints box = spread_points(box_mesh({{0, 0, 0}, {1, 2, 3}}), 0.3, 3);
  double area = 0;
  for (double a : box.areas) area += a;
  EXPECT_NEAR(area, 22, 1e-11);
  EXPECT_LT(*std::max_element(box.areas.begin(), box.areas.end()), 0.3 * 0.3);
  EXPECT_GT(*std::min_element(box.areas.begin(), box.areas.end()), 0);
  for (const Vec3& x : box.places) EXPECT_NEAR(std::min({x[0], 1 - x[0], x[1], 2 - x[1], x[2], 3 - x[2]}), 0, 1e-15);
  const SurfacePoints outline = spread_points(prism_mesh({{0, 0}, {1, 0}, {0, 1}}, 0.2), 0.3, 2);
  ASSERT_EQ(outline.places.size(), 4u + 5u + 4u);
  double length = 0;
  for (double a : outline.areas) length += a;
  EXPECT_NEAR(length, 2 + std::sqrt(2), 1e-13);
}

/// A brick that spins about nearly its middle axis, which is unstable: it tumbles.
TEST(FreeRigidBody, KeepsItsMomentaAndEnergyWhereNothingActs) {
  Model model = test::empty_model({0, 0, 0}, {4, 4, 4}, 0.25);
  RigidOptions options = moving(RigidMotion::free);
  options.angular_velocity = 5;
  options.axis = Vec3{0.02, 1, 0.01};
  seed_rigid_box(model, "brick", {{1, 1, 1}, {1.5, 2, 3}}, options, {0.5, 0, -0.25});
  const std::vector<GroundMotion> none;
  const SolverOptions run_options = test::solver(1, {0, 0, 0});
  for (double dt : {0.004, 0.002}) {
    RigidBodies bodies(model, StepOptions(run_options, 3, none));
    HistorySample first, now;
    bodies.add_to(first, {0, 0, 0});
    double worst = 0, least = 1, late = 0;
    const int steps = static_cast<int>(40 / dt);
    for (int i = 0; i < steps; ++i) {
      bodies.step(i * dt, dt);
      now = {};
      bodies.add_to(now, {0, 0, 0});
      const double off = std::abs(now.kinetic / first.kinetic - 1);
      worst = std::max(worst, off);
      if (i > 0.9 * steps) late = std::max(late, off);
      least = std::min(least, bodies[0].now.turn[4]);
    }
    EXPECT_LT(least, -0.9) << "it has tumbled";
    EXPECT_LT(worst, 60 * dt * dt);
    EXPECT_LT(late, 1.05 * worst + 1e-12) << "no drift";
    EXPECT_LT(norm(now.angular_momentum - first.angular_momentum), 1e-9 * norm(first.angular_momentum));
    EXPECT_LT(norm(bodies[0].now.centre - bodies[0].reference_centre - 40.0 * Vec3{0.5, 0, -0.25}), 1e-9);
    EXPECT_NEAR(determinant(bodies[0].now.turn), 1, 1e-13);
  }
}

/// A block thrown at a plate that is thinner than its particles' spacing.
struct Throw {
  int dimension;
  BackEnd form;
  Formulation formulation;
};
Model thrown(const Throw& t, const RigidSurface& surface, const Vec3& velocity, RigidMotion motion = RigidMotion::fixed,
             const Vec3& wall = {0, 0, 0}) {
  const double deep = t.dimension == 3 ? 1 : 0;
  Model model = test::empty_model({0, 0, 0}, {1, 2, deep}, 0.125);
  test::seed_body(
      model, "block", NeoHookean{{1000, 1e5, 0.3}}, 2,
      [](const Vec3& X) {
        return X[1] > 0.75 && X[1] < 1.25 && X[0] > 0.25 && X[0] < 0.75 && (X[2] == 0 || (X[2] > 0.25 && X[2] < 0.75));
      },
      [&](const Vec3&) { return velocity; });
  model.bodies[0].formulation = t.formulation;
  RigidOptions options = moving(motion, surface);
  seed_rigid_box(model, "plate", {{0, 0.6, 0}, {1, 0.7, deep}}, options, wall);
  const double low = 0.69, high = 0.7;
  model.bodies[1].boundary = t.dimension == 3 ? box_mesh({{0, low, 0}, {1, high, 1}})
                                              : prism_mesh({{0, low}, {1, low}, {1, high}, {0, high}}, 1);
  model.contact.method = ContactMethod::penalty;
  return model;
}

class RigidPlate : public testing::TestWithParam<std::tuple<int, BackEnd, Formulation>> {
 protected:
  Throw how() const { return {std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam())}; }
};

TEST_P(RigidPlate, ThrowsBackWhatComes) {
  Model model = thrown(how(), {false, 0.3}, {0.5, -2, 0});
  SolverOptions options = test::solver(0.5, {0, 0, 0}, 0.05);
  options.back_end = how().form;
  test::RecordingSink sink;
  const RunReport report = run(model, options, test::output(0.1, 0.005), sink, 1);
  ASSERT_FALSE(report.failed) << report.failure.what;
  Vec3 impulse{0, 0, 0};
  double last = 0;
  for (const HistorySample& s : sink.samples) {
    ASSERT_EQ(s.contact_force.size(), 2u);
    EXPECT_LT(norm(s.contact_force[0] + s.contact_force[1]), 1e-9 * (1 + norm(s.contact_force[0])));
    impulse = impulse + (s.time - last) * s.contact_force[0];
    last = s.time;
  }
  const Vec3 gained = report.last.momentum - report.first.momentum;
  EXPECT_LT(norm(gained - impulse), 1e-9 * norm(gained));
  EXPECT_GT(gained[1], 1.5 * std::abs(report.first.momentum[1]));
  EXPECT_LT(report.last.momentum[0], report.first.momentum[0]);
  EXPECT_EQ(report.last.external, 0);
  const bool updated = how().formulation == Formulation::updated_lagrangian;
  EXPECT_LT(report.largest_energy_error, (updated ? 0.1 : 0.02) * report.first.total);
  for (std::size_t p = 0; p < model.bodies[0].end; ++p) ASSERT_GT(model.particles.position[p][1], 0.7);
}

/// The plate goes at the block: what the block gains in energy is the work of the plate.
TEST_P(RigidPlate, GivesTheWorkThatItDoes) {
  Model model = thrown(how(), {true, 0}, {0, 0, 0}, RigidMotion::given, {0.2, 1, 0});
  SolverOptions options = test::solver(0.3, {0, 0, 0}, 0.2);
  options.back_end = how().form;
  test::RecordingSink sink;
  const RunReport report = run(model, options, test::output(0.1, 0.005), sink, 1);
  ASSERT_FALSE(report.failed) << report.failure.what;
  EXPECT_GT(report.last.momentum[1], 0);
  EXPECT_GT(report.last.momentum[0], 0) << "rough";
  // Force times velocity, which is constant: the momentum along it.
  EXPECT_NEAR(report.last.external, dot(report.last.momentum, Vec3{0.2, 1, 0}), 0.01 * report.last.external);
  const bool updated = how().formulation == Formulation::updated_lagrangian;
  EXPECT_LT(report.largest_energy_error, (updated ? 0.1 : 0.03) * report.last.external);
}

INSTANTIATE_TEST_SUITE_P(All, RigidPlate,
                         testing::Values(std::tuple(2, BackEnd::nodal, Formulation::total_lagrangian),
                                         std::tuple(3, BackEnd::nodal, Formulation::total_lagrangian),
                                         std::tuple(2, BackEnd::particle_state, Formulation::total_lagrangian),
                                         std::tuple(2, BackEnd::nodal, Formulation::updated_lagrangian),
                                         std::tuple(3, BackEnd::nodal, Formulation::updated_lagrangian)));

TEST(RigidPlate, SameBitsOnAnyNumberOfThreads) {
  std::vector<std::vector<Vec3>> places;
  for (int threads : {1, 3}) {
    Model model = thrown({3, BackEnd::nodal, Formulation::total_lagrangian}, {false, 0.3}, {0.5, -2, 0});
    test::RecordingSink sink;
    run(model, test::solver(0.2, {0, 0, 0}), test::output(0.1, 0.1), sink, threads);
    places.push_back(model.particles.position);
  }
  EXPECT_EQ(places[0], places[1]);
}

/// Free bodies that fall on a fixed floor, and on an elastic block: momenta in pairs, energy kept where nothing rubs.
Model dropping(int dimension, bool ball, bool on_block, const RigidSurface& surface) {
  const double deep = dimension == 3 ? 1 : 0;
  Model model = test::empty_model({0, 0, 0}, {1, 2, deep}, 0.125);
  if (on_block)
    test::seed_body(model, "block", NeoHookean{{1000, 1e6, 0.3}}, 2, [](const Vec3& X) { return X[1] < 0.5; });
  RigidOptions options = moving(RigidMotion::free, surface);
  options.angular_velocity = 2;
  if (dimension == 3) options.axis = Vec3{0, 0.3, 1};
  seed_rigid_box(model, "stone", {{0.3, 0.6, dimension == 3 ? 0.3 : 0}, {0.7, 1, dimension == 3 ? 0.7 : 0}}, options,
                 {0.1, -1, 0});
  if (ball) {
    Body& stone = model.bodies.back();
    stone.ball_radius = 0.2;
    stone.boundary = dimension == 3 ? sphere_mesh({0.5, 0.8, 0.5}, 0.2, 0.002)
                                    : prism_mesh(circle_outline({0.5, 0.8}, 0.2, 0.002), 1);
  }
  if (!on_block)
    seed_rigid_box(model, "floor", {{0, 0.25, 0}, {1, 0.5, deep}}, moving(RigidMotion::fixed, surface), {0, 0, 0});
  model.contact.method = ContactMethod::penalty;
  return model;
}

TEST(FreeRigidBody, BouncesOffWhatItMeets) {
  for (int dimension : {2, 3})
    for (bool ball : {false, true})
      for (bool on_block : {false, true}) {
        Model model = dropping(dimension, ball, on_block, {false, 0});
        test::RecordingSink sink;
        const RunReport report = run(model, test::solver(0.4, {0, 0, 0}, 0.2), test::output(0.1, 0.01), sink, 1);
        ASSERT_FALSE(report.failed) << report.failure.what;
        const std::string name =
            std::to_string(dimension) + "D" + (ball ? " ball" : " box") + (on_block ? " on block" : "");
        const HistorySample &a = report.first, &b = report.last;
        // While a sharp corner is among points of the block a spacing apart, the sheets that hold them change.
        EXPECT_LT(report.largest_energy_error, (on_block && !ball ? 0.05 : 0.02) * a.total) << name;
        if (on_block) {
          EXPECT_LT(norm(b.momentum - a.momentum), 1e-10 * norm(a.momentum)) << name;
        } else {
          const std::size_t stone = 0;
          Vec3 impulse{0, 0, 0};
          double last = 0;
          for (const HistorySample& s : sink.samples) {
            impulse = impulse + (s.time - last) * s.contact_force[stone];
            last = s.time;
          }
          EXPECT_LT(norm(b.momentum - a.momentum - impulse), 1e-9 * norm(impulse)) << name;
          EXPECT_GT(b.momentum[1], 0) << name;
          EXPECT_NEAR(b.momentum[0], a.momentum[0], 1e-9 * norm(a.momentum)) << name << ": smooth";
          if (ball) {
            EXPECT_NEAR(b.momentum[1], -a.momentum[1], 0.01 * norm(a.momentum)) << name;
          }
        }
      }
}

/// Two free bodies that hit each other off their centres: nothing of either momentum is lost, rough or smooth.
TEST(FreeRigidBody, KeepsBothMomentaInACollision) {
  for (int dimension : {2, 3})
    for (int balls : {0, 1, 2})
      for (const RigidSurface& surface : {RigidSurface{false, 0.4}, RigidSurface{true, 0}}) {
        const double middle = dimension == 3 ? 0.5 : 0;
        Model model = test::empty_model({0, 0, 0}, {2, 1, 2 * middle}, 0.125);
        for (int k = 0; k < 2; ++k) {
          const Vec3 centre{k == 0 ? 0.5 : 1.2, k == 0 ? 0.4 : 0.55, middle};
          RigidOptions options = moving(RigidMotion::free, surface);
          options.angular_velocity = k == 0 ? 3 : -1;
          const Vec3 half{0.25, 0.25, dimension == 3 ? 0.2 : 0};
          seed_rigid_box(model, k == 0 ? "one" : "other", {centre - half, centre + half}, options,
                         {k == 0 ? 2.0 : -1.0, 0.3, dimension == 3 ? 0.1 * k : 0});
          if (k >= balls) continue;
          Body& ball = model.bodies.back();
          ball.ball_radius = 0.25;
          ball.boundary = dimension == 3 ? sphere_mesh(centre, 0.25, 0.002)
                                         : prism_mesh(circle_outline({centre[0], centre[1]}, 0.25, 0.002), 1);
        }
        model.contact.method = ContactMethod::penalty;
        test::RecordingSink sink;
        const RunReport report = run(model, test::solver(0.1, {0, 0, 0}, 0.1), test::output(0.1, 0.01), sink, 1);
        ASSERT_FALSE(report.failed) << report.failure.what;
        const HistorySample &a = report.first, &b = report.last;
        const std::string name = std::to_string(dimension) + "D, balls: " + std::to_string(balls) +
                                 (surface.rough ? ", rough" : ", mu " + std::to_string(surface.friction));
        Vec3 impulse{0, 0, 0};
        for (const HistorySample& s : sink.samples) impulse = impulse + s.contact_force[0];
        EXPECT_LT(impulse[0], 0) << name << ": they have met";
        EXPECT_LT(norm(b.momentum - a.momentum), 1e-11 * norm(a.momentum)) << name;
        EXPECT_LT(norm(b.angular_momentum - a.angular_momentum), 1e-9 * norm(a.angular_momentum)) << name;
        EXPECT_LT(report.largest_energy_error, 0.02 * report.first.total) << name;
      }
}

TEST(FreeRigidBody, OneThatRubsSpins) {
  for (int dimension : {2, 3}) {
    Model model = dropping(dimension, true, false, {true, 0});
    for (std::size_t p = 0; p < model.bodies[0].end; ++p) model.particles.velocity[p] = {1, -1, 0};
    model.bodies[0].rigid.angular_velocity = 0;
    test::RecordingSink sink;
    const RunReport report = run(model, test::solver(0.3, {0, -5, 0}, 0.1), test::output(0.1, 0.01), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    EXPECT_LT(report.last.momentum[0], report.first.momentum[0]);
    EXPECT_LT(report.largest_energy_error, 0.02 * report.first.total);
    const HistorySample& last = report.last;
    const Vec3 spin = last.angular_momentum - cross(last.centre - report.first.centre, last.momentum);
    EXPECT_LT(spin[2], -0.01 * 0.2 * norm(report.first.momentum));
  }
}

std::string refusal(Model model) {
  test::RecordingSink sink;
  try {
    run(model, test::solver(0.01, {0, 0, 0}), test::output(1, 1), sink, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Particles of a lattice above a surface that lies askew: it cuts the balls of the lowest, which must not throw them.
TEST(RigidContact, BeginsAtRestWhereALatticeMeetsASlope) {
  Model model = test::empty_model({0, 0, 0}, {3, 2, 0}, 0.25);
  const auto height = [](double x) { return 0.5 + 0.3 * x; };
  test::seed_body(model, "soil", NeoHookean{{1000, 1e6, 0.3}}, 2,
                  [&](const Vec3& X) { return X[0] > 0.5 && X[0] < 2 && X[1] > height(X[0]) && X[1] < 1.5; });
  model.bodies[0].formulation = Formulation::updated_lagrangian;
  seed_rigid_box(model, "ground", {{0, 0, 0}, {3, 0.5, 0}}, moving(RigidMotion::fixed, {false, 0.5}), {0, 0, 0});
  model.bodies[1].boundary = prism_mesh({{0, 0}, {3, 0}, {3, height(3)}, {0, height(0)}}, 1);
  model.contact.method = ContactMethod::penalty;
  test::RecordingSink sink;
  const RunReport report = run(model, test::solver(0.05, {0, 0, 0}), test::output(1, 1), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  EXPECT_LT(report.last.kinetic, 1e-20);
  // And rests on it: with weight, the springs give way by as much as they bear.
  SolverOptions options = test::solver(0.5, {0, -9.81, 0}, 0.4, ShapeFunction::gimp);
  options.gravity_ramp = 0.2;
  const RunReport loaded = run(model, options, test::output(1, 1), sink, 1);
  EXPECT_FALSE(loaded.failed) << loaded.failure.what;
  for (std::size_t p = 0; p < model.bodies[0].end; ++p) {
    const Vec3& x = model.particles.position[p];
    EXPECT_GT(x[1], height(x[0]) - 0.01);
  }
}

TEST(RigidContactChecks, RefuseWhatCannotBe) {
  const auto changed = [](auto&& change) {
    Model model = dropping(2, false, true, {false, 0});
    change(model, model.bodies[1].rigid);
    return refusal(model);
  };
  EXPECT_EQ(changed([](Model&, RigidOptions&) {}), "");
  EXPECT_NE(changed([](Model& m, RigidOptions&) { m.contact.method = ContactMethod::none; }).find("penalty"),
            std::string::npos);
  EXPECT_NE(changed([](Model&, RigidOptions& r) { r.table = {{0, 1}}; }).find("table"), std::string::npos);
  EXPECT_NE(changed([](Model&, RigidOptions& r) { r.grips = {"block"}; }).find("grips"), std::string::npos);
  EXPECT_NE(changed([](Model& m, RigidOptions&) { m.particles.mass.back() *= 2; }).find("densities"),
            std::string::npos);
  EXPECT_NE(changed([](Model& m, RigidOptions&) {
              m.bodies[1].boundary = prism_mesh({{0.3, 0.4}, {0.7, 0.4}, {0.7, 1}, {0.3, 1}}, 1);
            }).find("overlap at the start"),
            std::string::npos);
}

}  // namespace
}  // namespace scarp

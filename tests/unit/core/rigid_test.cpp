// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "solver/core/loads.hpp"
#include "solver/core/rigid_nodes.hpp"
#include "solver/core/run.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/rigid_seed.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

using std::numbers::pi;
using test::seed_rigid_box;

const LinearElastic kElastic{{1000, 1e6, 0.3}};

RigidBodies bodies_of(const Model& model) {
  return RigidBodies(model, StepOptions(test::solver(1, {0, 0, 0}), model.domain.dimension, model.shaking));
}

RigidOptions moving(RigidMotion motion = RigidMotion::given) {
  RigidOptions options;
  options.motion = motion;
  return options;
}

TEST(FactorIntegral, IsThatOfTheFactor) {
  const std::vector<std::vector<Vec2>> tables{
      {}, {{0, 2}}, {{0, 0}, {1, 1}}, {{-1, 3}, {0.5, -1}, {0.8, 2}}, {{0.4, 1}, {0.9, 5}}};
  for (const auto& table : tables) {
    double sum = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(integral_of_factor(table, 2.0 * i / n), sum, 1e-3);
      sum += 2.0 / n * factor_at(table, 2.0 * (i + 0.5) / n);
    }
    EXPECT_NEAR(integral_of_factor(table, 2), sum, 1e-6);
  }
}

TEST(SignedDistance, IsExactForBoxesInSpaceAndInThePlane) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-2, 3);
  const Box3 box{{-1, 0, 0}, {1, 1, 2}};
  const SignedDistance space(box_mesh(box)), plane(prism_mesh({{-1, 0}, {1, 0}, {1, 1}, {-1, 1}}, 1));
  for (int i = 0; i < 2000; ++i) {
    for (int dimension : {2, 3}) {
      const Vec3 x{place(random), place(random), dimension == 3 ? place(random) : 0};
      double inside = INFINITY;
      Vec3 outside{0, 0, 0};
      for (int a = 0; a < dimension; ++a) {
        outside[a] = std::max({0.0, box.min[a] - x[a], x[a] - box.max[a]});
        inside = std::min({inside, x[a] - box.min[a], box.max[a] - x[a]});
      }
      const double expected = norm(outside) > 0 ? norm(outside) : -inside;
      const SignedDistance& surface = dimension == 3 ? space : plane;
      const auto foot = surface.at(x, INFINITY);
      ASSERT_NEAR(foot->distance, expected, 1e-12);
      // Its slope along the normal is one.
      const double step = 1e-4;
      ASSERT_NEAR(surface.at(x + step * foot->normal, INFINITY)->distance, expected + step, 1e-9);
      EXPECT_FALSE(surface.at(x, 0.99 * std::abs(expected)).has_value());
    }
  }
}

TEST(RigidBodies, MoveAsGiven) {
  Model model = test::empty_model({0, 0, 0}, {4, 4, 4}, 0.5);
  RigidOptions options = moving();
  options.angular_velocity = 3;
  options.axis = Vec3{1, 2, -1};
  options.about = Vec3{0.5, 0, 0};
  options.table = {{0, 0}, {1, 1}, {2, -1}};
  seed_rigid_box(model, "block", {{1, 1, 1}, {2, 2, 2}}, options, {0.1, -0.2, 0.3});
  RigidBodies bodies = bodies_of(model);
  const Vec3 X{1.5, 1, 2};
  const double dt = 1e-4;
  Vec3 last = X;
  for (int i = 0; i < 15000; ++i) {
    bodies.step(i * dt, dt);
    const RigidBody& body = bodies[0];
    const Vec3 x = body.place(body.now, X);
    const Vec3 mean = 0.5 * (body.before.velocity_at(last) + body.now.velocity_at(x));
    ASSERT_LT(norm((1 / dt) * (x - last) - mean), 1e-5);
    ASSERT_LT(norm(body.material_point(body.now, x) - X), 1e-13);
    last = x;
  }
  // The integral of the factor is 0.5 + 0.25 at 1.5 s.
  const Vec3 axis = (1 / std::sqrt(6.0)) * Vec3{1, 2, -1}, arm = X - *options.about;
  const double angle = 0.75 * 3;
  const Vec3 turned =
      std::cos(angle) * arm + std::sin(angle) * cross(axis, arm) + ((1 - std::cos(angle)) * dot(axis, arm)) * axis;
  EXPECT_LT(norm(last - (*options.about + turned + 0.75 * Vec3{0.1, -0.2, 0.3})), 1e-9);
  bodies.write(model.particles);
  EXPECT_LT(norm(model.particles.position[0] - bodies[0].place(bodies[0].now, model.particles.reference_position[0])),
            1e-15);
}

/// However a thin plate lies in the lattice, of an edge that crosses it one end is carried.
TEST(RigidNodes, LetNothingThroughAThinPlate) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Vec3> places;
  const int n = 12;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) places.push_back({1.0 * i, 1.0 * j, 1.0 * k});
  for (int trial = 0; trial < 30; ++trial) {
    Model model = test::empty_model({0, 0, 0}, {12, 12, 12}, 1);
    RigidOptions options = moving();
    options.angular_velocity = 1;
    options.axis = Vec3{any(random), any(random), 1};
    seed_rigid_box(model, "plate", {{2, 2, 5.5}, {10, 10, 6.5}}, options, {0, 0, 0});
    model.bodies[0].boundary = box_mesh({{2, 2, 6}, {10, 10, 6.05}});
    RigidBodies bodies = bodies_of(model);
    bodies.step(0, 0.5 + 0.5 * any(random));
    RigidNodes nodes;
    nodes.find(bodies, places, 1);
    std::vector<bool> carried(places.size(), false);
    nodes.mark(carried);
    int crossing = 0;
    const RigidBody& body = bodies[0];
    for (std::size_t a = 0; a < places.size(); ++a)
      for (std::size_t stride : {1, n + 1, (n + 1) * (n + 1)}) {
        const std::size_t b = a + stride;
        if (b >= places.size() || norm(places[b] - places[a]) > 1.5) continue;
        const Vec3 A = body.material_point(body.now, places[a]), B = body.material_point(body.now, places[b]);
        if ((A[2] - 6) * (B[2] - 6) > 0) continue;
        const Vec3 C = A + ((6 - A[2]) / (B[2] - A[2])) * (B - A);
        if (C[0] < 2 || C[0] > 10 || C[1] < 2 || C[1] > 10) continue;
        ++crossing;
        ASSERT_TRUE(carried[a] || carried[b]);
      }
    EXPECT_GT(crossing, 50);
  }
}

/// What fixed bodies do to a node of the lattice is kept, that of moving ones found anew.
TEST(RigidNodes, AreTheSameWhetherKeptOrFound) {
  Model model = test::empty_model({0, 0, 0}, {8, 8, 8}, 1);
  RigidOptions fixed;
  fixed.motion = RigidMotion::fixed;
  seed_rigid_box(model, "ground", {{0, 0, 0}, {8, 8, 1.2}}, fixed, {0, 0, 0});
  seed_rigid_box(model, "piston", {{2, 2, 4}, {6, 6, 6}}, moving(), {0, 0, -1});
  RigidBodies bodies = bodies_of(model);
  RigidNodes kept;
  for (const int first : {0, 3, 0}) {  // others are occupied each time
    bodies.step(0.1 * first, 0.5);
    std::vector<Vec3> places;
    std::vector<std::size_t> keys;
    for (int i = first; i < 9 * 9 * 9; i += 2) {
      places.push_back({1.0 * (i % 9), 1.0 * (i / 9 % 9), 1.0 * (i / 81)});
      keys.push_back(static_cast<std::size_t>(i));
    }
    RigidNodes found;
    kept.find(bodies, places, 1, keys);
    found.find(bodies, places, 1);
    std::vector<bool> marked(places.size(), false), expected = marked;
    kept.mark(marked);
    found.mark(expected);
    EXPECT_EQ(marked, expected);
    EXPECT_GT(std::count(marked.begin(), marked.end(), true), 50);
  }
}

Model bar(int dimension, bool by_load, BackEnd) {
  const double deep = dimension == 3 ? 0.5 : 0;
  Model model = test::empty_model({0, 0, 0}, {3, 0.5, deep}, 0.25, {Condition::roller});
  const auto inside = [](const Vec3& X) { return X[0] < 2; };
  test::seed_body(model, "bar", kElastic, 2, inside);
  const std::vector<Vec2> table{{0, 0}, {0.05, 1}, {0.1, 0.5}};
  if (by_load) {
    LoadOptions load;
    load.name = "pull";
    load.where.box = BoxShape{{2, 0, 0}, {2, 0.5, deep}};
    load.velocity = Vec3{0.3, 0.1, 0};
    load.table = table;
    model.loads.push_back(load);
    return model;
  }
  RigidOptions options = moving();
  options.table = table;
  options.grips = {"bar"};
  seed_rigid_box(model, "grip", {{2, 0, 0}, {2.5, 0.5, deep}}, options, {0.3, 0.1, 0});
  return model;
}

/// A grip does what a load does that imposes the same velocity, and its force is the reaction.
TEST(RigidGrip, HoldsABodyInEitherForm) {
  for (int dimension : {2, 3})
    for (BackEnd form : {BackEnd::nodal, BackEnd::particle_state}) {
      SolverOptions options = test::solver(0.15, {0, 0, 0}, 0.2);
      options.back_end = form;
      Model gripped = bar(dimension, false, form), loaded = bar(dimension, true, form);
      test::RecordingSink sink, other;
      const RunReport report = run(gripped, options, test::output(0.05, 0.001), sink, 1);
      const RunReport of_load = run(loaded, options, test::output(0.05, 0.001), other, 1);
      ASSERT_FALSE(report.failed) << report.failure.what;
      EXPECT_NEAR(report.last.external, of_load.last.external, 0.01 * of_load.last.external);
      EXPECT_LT(report.largest_energy_error, 0.01 * report.last.external);
      double far = 0;
      for (std::size_t p = 0; p < loaded.particles.size(); ++p)
        far = std::max(far, norm(loaded.particles.position[p] - gripped.particles.position[p]));
      // A load imposes the velocity at the end of each step, a grip the mean one: half a step apart.
      EXPECT_LT(far, 5e-3 * report.largest_displacement);
      EXPECT_LT(norm(gripped.particles.position.back() - gripped.particles.reference_position.back() -
                     Vec3{0.0875 * 0.3, 0.0875 * 0.1, 0}),
                1e-12)
          << "of the grip: integral of the factor is 0.025 + 0.0375 + 0.025";
      // The wall takes no y: the force along it is what the bar gains, and its work is the external one.
      double impulse = 0, work = 0;
      for (std::size_t i = 1; i < sink.samples.size(); ++i) {
        const HistorySample &a = sink.samples[i - 1], &b = sink.samples[i];
        ASSERT_EQ(b.contact_force.size(), 2u);
        impulse -= (b.time - a.time) * b.contact_force[1][1];
        const double factor = factor_at(gripped.bodies[1].rigid.table, 0.5 * (a.time + b.time));
        work -= (b.time - a.time) * factor * dot(b.contact_force[1], Vec3{0.3, 0.1, 0});
      }
      EXPECT_NEAR(impulse, report.last.momentum[1], 1e-9 * std::abs(impulse));
      EXPECT_NEAR(work, report.last.external, 0.01 * work);
    }
}

/// A block of an updated-Lagrangian body that falls on a floor, which is thinner than a cell and lies between nodes.
Model falling(const RigidSurface& surface, const Vec3& floor_velocity, int dimension = 2) {
  const double deep = dimension == 3 ? 1.5 : 0;
  Model model = test::empty_model({0, 0, 0}, {6, 2, deep}, 0.25);
  test::seed_body(model, "block", NeoHookean{{1000, 1e6, 0.3}}, 2, [&](const Vec3& X) {
    return X[0] > 1 && X[0] < 2 && X[1] > 0.75 && X[1] < 1.25 && (X[2] == 0 || (X[2] > 0.5 && X[2] < 1));
  });
  model.bodies[0].formulation = Formulation::updated_lagrangian;
  RigidOptions options = moving(norm(floor_velocity) > 0 ? RigidMotion::given : RigidMotion::fixed);
  options.surface = surface;
  seed_rigid_box(model, "floor", {{0, 0.6, 0}, {6, 0.7, deep}}, options, floor_velocity);
  return model;
}

TEST(RigidCarrier, BearsDragsAndReleases) {
  const double g = 9.81;
  for (int dimension : {2, 3})
    for (ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline, ShapeFunction::gimp}) {
      const double mass = dimension == 2 ? 500 : 250;
      Model model = falling({false, 0.2}, {1, 0, 0}, dimension);
      test::RecordingSink sink;
      SolverOptions options = test::solver(0.35, {0, -g, 0}, 0.3, shape);
      const RunReport report = run(model, options, test::output(0.1, 0.01), sink, 1);
      ASSERT_FALSE(report.failed) << report.failure.what;
      Vec3 impulse{0, 0, 0};
      double last = 0;
      for (const HistorySample& s : sink.samples) {
        ASSERT_EQ(s.contact_force.size(), 2u);
        EXPECT_EQ(norm(s.contact_force[0]), 0) << "nobody knows whose the nodes are";
        impulse = impulse - (s.time - last) * s.contact_force[1];
        last = s.time;
      }
      const HistorySample& end = sink.samples.back();
      EXPECT_NEAR(impulse[0], end.momentum[0], 1e-8 * mass);
      EXPECT_NEAR(impulse[1] - mass * g * 0.35, end.momentum[1], 1e-8 * mass);
      // It slides all the time: mu of the normal impulse, whatever the blows.
      EXPECT_NEAR(impulse[0] / impulse[1], 0.2, 2e-3);
      EXPECT_NEAR(end.external, impulse[0], 1e-8 * mass) << "force times the floor's velocity of 1 m/s";
      EXPECT_GT(end.friction, 0);
      EXPECT_LT(report.largest_energy_error, 0.02 * report.largest_energy);
      double lowest = 1;
      for (std::size_t p = 0; p < model.bodies[0].end; ++p) lowest = std::min(lowest, model.particles.position[p][1]);
      EXPECT_GT(lowest, 0.6);
    }
}

TEST(RigidCarrier, HoldsWhatIsRoughAndLetsSmoothGo) {
  Model rough = falling({true, 0}, {1, 0, 0}), smooth = falling({false, 0}, {1, 0, 0});
  test::RecordingSink sink, other;
  SolverOptions options = test::solver(0.5, {0, -9.81, 0}, 0.3);
  options.transfer = Transfer::apic;
  const RunReport report = run(rough, options, test::output(0.1, 0.01), sink, 1);
  run(smooth, options, test::output(0.1, 0.01), other, 1);
  // The block sways about the floor's velocity, and its few cells damp what they were struck with.
  double mean = 0, count = 0;
  for (const HistorySample& s : sink.samples) {
    if (s.time < 0.25) continue;
    mean += s.momentum[0];
    ++count;
  }
  EXPECT_NEAR(mean / count, 500, 25);
  EXPECT_NEAR(other.samples.back().momentum[0], 0, 1e-9);
  EXPECT_LT(report.largest_energy_error, 0.2 * report.largest_energy);
  EXPECT_LT(report.last.total, 1e-9 * report.largest_energy) << "loses, not gains";
  // Lifted off a smooth floor that falls faster than it, the block is free.
  Model leaving = falling({false, 0}, {0, -0.2, 0});
  for (std::size_t p = 0; p < leaving.bodies[0].end; ++p) leaving.particles.velocity[p] = {0, 1, 0};
  const RunReport free = run(leaving, test::solver(0.1, {0, 0, 0}), test::output(0.1, 0.01), other, 1);
  EXPECT_NEAR(free.last.momentum[1], 500, 1e-9);
}

TEST(RigidCarrier, StandsStillWhileTheStartIsSought) {
  Model model = falling({true, 0}, {0.5, 0, 0});
  for (std::size_t p = 0; p < model.bodies[0].end; ++p)
    model.particles.position[p][1] = model.particles.reference_position[p][1] -= 0.05;
  SolverOptions options = test::solver(0.01, {0, -9.81, 0});
  options.relax = RelaxOptions{};
  options.max_steps = 20000;
  test::RecordingSink sink;
  const RunReport report = run(model, options, test::output(0.01, 0.001), sink, 1);
  ASSERT_FALSE(report.failed) << report.failure.what;
  EXPECT_NEAR(sink.samples.front().momentum[0], 0, 1e-12);
  EXPECT_EQ(sink.samples.front().external, 0);
  EXPECT_GT(report.last.momentum[0], 0);
  const Vec3 moved = model.particles.position.back() - model.particles.reference_position.back();
  EXPECT_NEAR(moved[0], 0.005, 1e-12);
}

TEST(RigidCarrier, SameBitsOnAnyNumberOfThreads) {
  std::vector<std::vector<Vec3>> places;
  for (int threads : {1, 3}) {
    Model model = falling({false, 0.3}, {1, 0.1, 0}, 3);
    test::RecordingSink sink;
    run(model, test::solver(0.2, {0, -9.81, 0}), test::output(0.1, 0.1), sink, threads);
    places.push_back(model.particles.position);
  }
  EXPECT_EQ(places[0], places[1]);
}

std::string refusal(Model model, const SolverOptions& options = test::solver(0.1, {0, 0, 0})) {
  test::RecordingSink sink;
  try {
    run(model, options, test::output(1, 1), sink, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RigidChecks, RefuseWhatCannotBe) {
  const auto changed = [](auto&& change) {
    Model model = bar(2, false, BackEnd::nodal);
    change(model, model.bodies[1].rigid);
    return refusal(model);
  };
  EXPECT_EQ(changed([](Model&, RigidOptions&) {}), "");
  EXPECT_NE(changed([](Model&, RigidOptions& r) { r.grips = {"rod"}; }).find("'rod'"), std::string::npos);
  EXPECT_NE(changed([](Model&, RigidOptions& r) { r.grips = {}; }).find("nothing can meet"), std::string::npos);
  EXPECT_NE(changed([](Model&, RigidOptions& r) { r.motion = RigidMotion::fixed; }).find("fixed"), std::string::npos);
  EXPECT_NE(changed([](Model&, RigidOptions& r) { r.axis = Vec3{0, 0, 1}; }).find("plane strain"), std::string::npos);
  EXPECT_NE(changed([](Model&, RigidOptions& r) { r.table = {{1, 0}, {0, 0}}; }).find("rising"), std::string::npos);
  EXPECT_NE(changed([](Model&, RigidOptions& r) { r.surface.friction = -1; }).find("friction"), std::string::npos);
  EXPECT_NE(changed([](Model& m, RigidOptions&) {
              m.particles.velocity.back() = {1, 0, 0};
            }).find("one velocity"),
            std::string::npos);
  EXPECT_NE(changed([](Model& m, RigidOptions&) { m.bodies[1].boundary = {}; }).find("boundary"), std::string::npos);
  EXPECT_NE(changed([](Model& m, RigidOptions& r) {
              for (std::size_t p = m.bodies[1].begin; p < m.bodies[1].end; ++p) m.particles.velocity[p] = {0, 0, 0};
              r.angular_velocity = 0;
            }).find("motion = \"fixed\""),
            std::string::npos);
  EXPECT_NE(changed([](Model& m, RigidOptions&) {
              m.bodies[1].boundary = prism_mesh({{2.6, 0}, {2.9, 0}, {2.9, 0.5}, {2.6, 0.5}}, 1);
            }).find("that rigid body 'grip' grips"),
            std::string::npos);
  EXPECT_NE(changed([](Model& m, RigidOptions&) { m.bodies[0].formulation = Formulation::rigid; }).find("all rigid"),
            std::string::npos);
  SolverOptions renewed = test::solver(0.1, {0, 0, 0});
  renewed.reference_update = 3;
  EXPECT_NE(refusal(bar(2, false, BackEnd::nodal), renewed).find("grips"), std::string::npos);
  Model pushed = bar(2, false, BackEnd::nodal);
  LoadOptions load;
  load.where.body = "grip";
  load.force = Vec3{1, 0, 0};
  pushed.loads.push_back(load);
  EXPECT_NE(refusal(pushed).find("acts on a rigid body"), std::string::npos);
  Model deep = falling({true, 0}, {0, 0, 0});
  for (std::size_t p = 0; p < deep.bodies[0].end; ++p)
    deep.particles.position[p][1] = deep.particles.reference_position[p][1] -= 0.15;
  deep.bodies[1].boundary = prism_mesh({{0, 0.1}, {6, 0.1}, {6, 0.8}, {0, 0.8}}, 1);
  EXPECT_NE(refusal(deep).find("at the start"), std::string::npos);
}

}  // namespace
}  // namespace scarp

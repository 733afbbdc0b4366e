// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "solver/core/loads.hpp"
#include "solver/core/run.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"

namespace scarp {
namespace {

LoadOptions load_in(const Vec3& min, const Vec3& max) {
  LoadOptions load;
  load.name = "push";
  load.where.box = BoxShape{min, max};
  return load;
}

/// 1 x 1 (x 1) m, cells of 0.25 m, its upper layer of particles marked as surface.
Model block(int dimension) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, dimension == 3 ? 1.0 : 0.0}, 0.25);
  test::seed_body(model, "block", NeoHookean{{1000, 1e5, 0.3}}, 2, test::everywhere);
  for (std::size_t p = 0; p < model.particles.size(); ++p)
    model.particles.surface[p] = model.particles.reference_position[p][1] > 0.9;
  return model;
}

SolverOptions until(double end_time) {
  SolverOptions options;
  options.end_time = end_time;
  options.gravity = Vec3{0, 0, 0};
  return options;
}

Vec3 momentum(const Model& model) {
  Vec3 sum{0, 0, 0};
  for (std::size_t p = 0; p < model.particles.size(); ++p)
    sum = sum + model.particles.mass[p] * model.particles.velocity[p];
  return sum;
}

std::string error_of(Model model) {
  test::RecordingSink sink;
  try {
    run(model, until(0.01), {}, sink, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FactorAt, IsLinearBetweenRowsAndConstantBeyond) {
  const std::vector<Vec2> table{{1, 10}, {2, 20}, {4, 0}};
  EXPECT_EQ(factor_at({}, 7), 1);
  EXPECT_EQ(factor_at(table, 0), 10);
  EXPECT_EQ(factor_at(table, 1), 10);
  EXPECT_EQ(factor_at(table, 1.5), 15);
  EXPECT_EQ(factor_at(table, 3), 10);
  EXPECT_EQ(factor_at(table, 4), 0);
  EXPECT_EQ(factor_at(table, 9), 0);
  EXPECT_EQ(factor_at({{0, 3}}, -1), 3);
}

TEST(Loads, ATractionActsOnTheAreaOfTheFace) {
  for (int dimension : {2, 3}) {
    Model model = block(dimension);
    LoadOptions load = load_in({0, 0.9, 0}, {0.5, 1, 1});  // half of the face
    load.traction = Vec3{0, -200, 0};
    model.loads = {load};
    const auto forces = find_particle_forces(model);
    ASSERT_EQ(forces.size(), 1u);
    Vec3 sum{0, 0, 0};
    for (const Vec3& force : forces[0].forces) sum = sum + force;
    EXPECT_NEAR(sum[1], -100, 1e-10);
    EXPECT_EQ(sum[0], 0);
  }
}

TEST(Loads, AForceGivesItsImpulse) {
  for (int dimension : {2, 3}) {
    Model model = block(dimension);
    LoadOptions load = load_in({0, 0, 0}, {0.3, 0.3, 1});
    load.force = Vec3{30, 10, 0};
    load.table = {{0, 0}, {0.05, 1}, {0.1, 0}};
    model.loads = {load};
    test::RecordingSink sink;
    OutputOptions output;
    output.every = output.history_every = 0.05;
    const RunReport report = run(model, until(0.1), output, sink, 1);
    ASSERT_FALSE(report.failed);
    EXPECT_NEAR(momentum(model)[0], 30 * 0.05, 1e-9);  // area of the triangle; steps meet its corner
    EXPECT_NEAR(momentum(model)[1], 10 * 0.05, 1e-9);
    EXPECT_GT(report.last.external, 0);
    EXPECT_NEAR(report.last.total, 0, 0.01 * report.last.external);
  }
}

TEST(Loads, AVelocityIsImposedAlongItsAxesOnly) {
  Model model = block(2);
  model.domain.faces[2] = Condition::fixed;  // the load takes the axis over
  LoadOptions load = load_in({0, 0, 0}, {1, 0, 0});
  load.velocity = Vec3{0.5, 9, 0};
  load.axes = "x";
  load.table = {{0, 0}, {0.2, 1}};
  model.loads = {load};
  test::RecordingSink sink;
  SolverOptions options = until(1);
  options.courant = 0.1;
  const RunReport report = run(model, options, {}, sink, 1);
  ASSERT_FALSE(report.failed);
  const std::size_t p = test::nearest(model.particles, {0.5, 0, 0});
  // 0.5 (1 - 0.1) m, and the shear of the quarter spacing above the floor
  EXPECT_NEAR(test::carried(model.particles, {0.5, 0, 0})[0] - 0.5, 0.45, 0.02);
  EXPECT_NEAR(model.particles.position[p][1], model.particles.reference_position[p][1], 0.01);
  // The kinetic energy of driven nodes is that of their particles, half a spacing inside.
  EXPECT_NEAR(report.last.total, 0, 0.05 * report.last.external);
}

TEST(Loads, ADisplacementIsMetAtEveryStep) {
  struct Way {
    Formulation formulation;
    ShapeFunction shape;
    UpdateOrder order;
  };
  for (const Way& way : {Way{Formulation::total_lagrangian, ShapeFunction::linear, UpdateOrder::musl},
                         Way{Formulation::updated_lagrangian, ShapeFunction::linear, UpdateOrder::musl},
                         Way{Formulation::updated_lagrangian, ShapeFunction::quadratic_bspline, UpdateOrder::usl},
                         Way{Formulation::updated_lagrangian, ShapeFunction::gimp, UpdateOrder::usf}}) {
    Model model = test::empty_model({0, 0, 0}, {2, 2, 0}, 0.25);
    test::seed_body(model, "block", NeoHookean{{1000, 1e5, 0.3}}, 2,
                    [](const Vec3& X) { return X[0] > 0.5 && X[0] < 1.5 && X[1] > 0.5 && X[1] < 1.5; });
    model.bodies[0].formulation = way.formulation;
    LoadOptions load = load_in({0, 0, 0}, {2, 2, 0});
    load.displacement = Vec3{0.2, -0.1, 0};
    load.table = {{0, 0}, {0.03, 1}, {0.1, -1}, {0.2, 0.5}};
    model.loads = {load};
    test::RecordingSink sink;
    int frames = 0;
    sink.on_frame = [&](const Model& m, double time) {
      const Vec3 wanted = factor_at(load.table, time) * *load.displacement;
      for (std::size_t p = 0; p < m.particles.size(); ++p)
        EXPECT_NEAR(norm(m.particles.position[p] - m.particles.reference_position[p] - wanted), 0, 1e-13);
      ++frames;
    };
    SolverOptions options = until(0.25);
    options.shape = way.shape;
    options.update = way.order;
    OutputOptions output;
    output.every = output.history_every = 0.0007;  // no more often than steps
    ASSERT_FALSE(run(model, options, output, sink, 1).failed);
    EXPECT_GT(frames, 300);
  }
}

TEST(Loads, ForcesOnUpdatedBodiesGiveTheirImpulse) {
  for (ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline, ShapeFunction::gimp})
    for (int dimension : {2, 3}) {
      Model model = block(dimension);
      model.bodies[0].formulation = Formulation::updated_lagrangian;
      model.domain.max = {2, 2, model.domain.max[2]};
      LoadOptions load = load_in({0, 0, 0}, {0.3, 0.3, 1});
      load.force = Vec3{30, 10, 0};
      load.table = {{0, 0}, {0.05, 1}, {0.1, 0}};
      model.loads = {load};
      test::RecordingSink sink;
      OutputOptions output;
      output.every = output.history_every = 0.05;
      SolverOptions options = until(0.1);
      options.shape = shape;
      const RunReport report = run(model, options, output, sink, 1);
      ASSERT_FALSE(report.failed);
      EXPECT_NEAR(momentum(model)[0], 30 * 0.05, 1e-9);
      EXPECT_NEAR(momentum(model)[1], 10 * 0.05, 1e-9);
      EXPECT_GT(report.last.external, 0);
      EXPECT_NEAR(report.last.total, 0, 0.02 * report.last.external);
    }
}

TEST(Loads, RegionsAreBoxesFacesAndBodies) {
  Model model = block(2);
  LoadRegion region;
  region.face = FaceName::x_max;
  EXPECT_TRUE(node_in(region, model, {1, 0.5, 0}, 0));
  EXPECT_FALSE(node_in(region, model, {0.75, 0.5, 0}, 0));
  EXPECT_TRUE(particle_in(region, model, test::nearest(model.particles, {1, 0.5, 0})));
  EXPECT_FALSE(particle_in(region, model, test::nearest(model.particles, {0.75, 0.5, 0})));
  region.box = BoxShape{{0, 0, 0}, {1, 0.25, 0}};
  EXPECT_TRUE(node_in(region, model, {1, 0.25, 0}, 0));
  EXPECT_FALSE(node_in(region, model, {1, 0.5, 0}, 0));
  region = {};
  region.body = "block";
  EXPECT_TRUE(node_in(region, model, {7, 7, 0}, 0));
  EXPECT_FALSE(node_in(region, model, {0, 0, 0}, -1));
}

TEST(Loads, WrongOnesAreRefused) {
  Model model = block(2);
  LoadOptions load = load_in({0, 0, 0}, {1, 1, 0});
  model.loads = {load};
  EXPECT_NE(error_of(model).find("one of velocity, displacement, traction and force"), std::string::npos);
  model.loads[0].force = Vec3{1, 0, 0};
  EXPECT_EQ(error_of(model), "");
  model.loads[0].table = {{0, 0}, {0, 1}};
  EXPECT_NE(error_of(model).find("rising times"), std::string::npos);
  model.loads[0].table.clear();
  model.loads[0].where.box = BoxShape{{2, 2, 0}, {3, 3, 0}};
  EXPECT_NE(error_of(model).find("with particles"), std::string::npos);
  model.loads[0].force.reset();
  model.loads[0].velocity = Vec3{1, 0, 0};
  EXPECT_NE(error_of(model).find("on no node"), std::string::npos);
  model.loads[0].velocity.reset();
  model.loads[0].displacement = Vec3{1, 0, 0};
  EXPECT_NE(error_of(model).find("it would jump"), std::string::npos);
  model.loads[0].displacement.reset();
  model.loads[0].where.body = "blok";
  model.loads[0].velocity = Vec3{1, 0, 0};
  EXPECT_NE(error_of(model).find("name of a body"), std::string::npos);
  model.loads[0].where = {};
  EXPECT_NE(error_of(model).find("at least one of box"), std::string::npos);
  model.loads[0].velocity = Vec3{1, 0, 1};
  EXPECT_NE(error_of(model).find("in the plane"), std::string::npos);
}

}  // namespace
}  // namespace scarp

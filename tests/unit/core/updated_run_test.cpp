// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <tuple>

#include "solver/core/estimate.hpp"
#include "solver/core/formulations.hpp"
#include "solver/core/run.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"

namespace scarp {
namespace {

using test::RecordingSink;

const NeoHookean kRubber{{1000, 1e5, 0.3}};
constexpr std::array<ShapeFunction, 3> kShapes{ShapeFunction::linear, ShapeFunction::quadratic_bspline,
                                               ShapeFunction::gimp};
constexpr std::array<UpdateOrder, 3> kOrders{UpdateOrder::musl, UpdateOrder::usl, UpdateOrder::usf};

void make_updated(Model& model) {
  for (Body& body : model.bodies) body.formulation = Formulation::updated_lagrangian;
}

SolverOptions solver(ShapeFunction shape, UpdateOrder order, double end_time, Vec3 gravity = {0, 0, 0}) {
  SolverOptions options;
  options.shape = shape;
  options.update = order;
  options.end_time = end_time;
  options.gravity = gravity;
  return options;
}

/// Few outputs, so that steps are as long as they may be.
OutputOptions one_frame(double end_time) {
  OutputOptions output;
  output.every = output.history_every = end_time;
  return output;
}

std::string describe(ShapeFunction shape, UpdateOrder order, int dimension) {
  return std::string(name_of(shape)) + ", " + std::string(name_of(order)) + ", " + std::to_string(dimension) + "D";
}

/// A block in the middle of a wide domain, free on all sides.
Model free_block(int dimension, const std::function<Vec3(const Vec3&)>& velocity = {}) {
  Model model = test::empty_model({0, 0, 0}, {3, 3, dimension == 3 ? 3.0 : 0.0}, 0.25);
  test::seed_body(
      model, "block", kRubber, 2,
      [&](const Vec3& X) {
        return X[0] > 1 && X[0] < 2 && X[1] > 1 && X[1] < 2 && (dimension == 2 || (X[2] > 1 && X[2] < 2));
      },
      velocity);
  make_updated(model);
  return model;
}

Vec3 swirl(const Vec3& X) { return {std::sin(3 * X[1]) + 0.2, 0.5 * std::cos(2 * X[0]), 0}; }

double largest_difference(const std::vector<Mat3>& a, const std::vector<Mat3>& b) {
  double worst = 0;
  for (std::size_t p = 0; p < a.size(); ++p)
    for (int i = 0; i < 9; ++i) worst = std::max(worst, std::abs(a[p][i] - b[p][i]));
  return worst;
}

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0;
  for (std::size_t p = 0; p < a.size(); ++p) worst = std::max(worst, norm(a[p] - b[p]));
  return worst;
}

TEST(Updated, FirstStepIsTheTotalLagrangianOne) {
  for (int dimension : {2, 3}) {
    Model updated = free_block(dimension, swirl), total = updated;
    total.bodies[0].formulation = Formulation::total_lagrangian;
    const SolverOptions options = solver(ShapeFunction::linear, UpdateOrder::musl, 1, {1, -9.81, 0});
    Formulations a(updated, options, 1), b(total, options, 1);
    const double dt = b.stable_time_step();
    EXPECT_LE(a.stable_time_step(), dt);  // the |v| term
    for (int step = 1; step <= 2; ++step) {
      a.step(dt);
      b.step(dt);
      b.write_particles();
      const double F = largest_difference(updated.particles.deformation_gradient, total.particles.deformation_gradient);
      const double v = largest_difference(updated.particles.velocity, total.particles.velocity);
      const double x = largest_difference(updated.particles.position, total.particles.position);
      if (step == 1) {
        EXPECT_LT(F, 1e-14);
        EXPECT_LT(v, 1e-14);
        EXPECT_LT(x, 1e-14);
      } else {
        EXPECT_GT(F, 1e-6) << "they are not the same method";
      }
    }
  }
}

TEST(Updated, FromRestTheTimeStepIsTheTotalLagrangianOne) {
  Model updated = free_block(2), total = updated;
  total.bodies[0].formulation = Formulation::total_lagrangian;
  const SolverOptions options = solver(ShapeFunction::linear, UpdateOrder::musl, 1);
  EXPECT_DOUBLE_EQ(Formulations(updated, options, 1).stable_time_step(),
                   Formulations(total, options, 1).stable_time_step());
  EXPECT_DOUBLE_EQ(Formulations(updated, options, 1).stable_time_step(), estimate(updated, options, {}).time_step);
}

TEST(Updated, ConservesMomentumInEveryOrderAndShape) {
  for (int dimension : {2, 3})
    for (ShapeFunction shape : kShapes)
      for (UpdateOrder order : kOrders)
        for (double flip : {1.0, 0.9}) {
          if (dimension == 3 && flip < 1 && order != UpdateOrder::usf) continue;
          Model model = free_block(dimension, swirl);
          SolverOptions options = solver(shape, order, dimension == 2 ? 0.05 : 0.02);
          options.flip = flip;
          RecordingSink sink;
          const RunReport report = run(model, options, one_frame(options.end_time), sink, 1);
          ASSERT_FALSE(report.failed) << describe(shape, order, dimension) << report.failure.what;
          const Vec3 change = report.last.momentum - report.first.momentum;
          EXPECT_LT(norm(change), 1e-12 * norm(report.first.momentum)) << describe(shape, order, dimension);
          EXPECT_GT(report.last.strain, 0.001 * report.first.kinetic);
        }
}

TEST(Updated, FallsFreelyAsGalileoSays) {
  for (int dimension : {2, 3})
    for (ShapeFunction shape : kShapes)
      for (UpdateOrder order : kOrders) {
        Model model = free_block(dimension, [](const Vec3&) { return Vec3{1, 2, 0}; });
        RecordingSink sink;
        const RunReport report = run(model, solver(shape, order, 0.2, {0, -9.81, 0}), one_frame(0.2), sink, 1);
        ASSERT_FALSE(report.failed);
        double sum_of_squares = 0, dv = 0, dx = 0, strain = 0;
        for (double dt : sink.steps) sum_of_squares += dt * dt;
        const Vec3 fall{0.2, 0.4 - 0.5 * 9.81 * (0.04 + sum_of_squares), 0};
        for (std::size_t p = 0; p < model.particles.size(); ++p) {
          dv = std::max(dv, norm(model.particles.velocity[p] - Vec3{1, 2 - 0.2 * 9.81, 0}));
          dx = std::max(dx, norm(model.particles.position[p] - model.particles.reference_position[p] - fall));
          for (int i = 0; i < 9; ++i)
            strain = std::max(strain, std::abs(model.particles.deformation_gradient[p][i] - kIdentity[i]));
        }
        // Rows of particles cross cells on the way; strain is rounding of v over light nodes.
        EXPECT_LT(dv, 1e-11) << describe(shape, order, dimension);
        EXPECT_LT(dx, 1e-11) << describe(shape, order, dimension);
        EXPECT_LT(strain, 1e-11) << describe(shape, order, dimension);
      }
}

void expect_same_bits(const Particles& a, const Particles& b) {
  for_each_field(a, [&](const char* name, const char*, const auto& values, const auto&) {
    for_each_field(b, [&](const char* other, const char*, const auto& expected, const auto&) {
      if constexpr (std::is_same_v<decltype(values), decltype(expected)>) {
        if (std::string(name) == other) {
          EXPECT_EQ(values, expected) << name;
        }
      }
    });
  });
}

TEST(Updated, SameBitsForAnyNumberOfThreads) {
  for (const auto& [dimension, shape, order] :
       {std::tuple(2, ShapeFunction::quadratic_bspline, UpdateOrder::musl),
        std::tuple(2, ShapeFunction::linear, UpdateOrder::usf), std::tuple(3, ShapeFunction::gimp, UpdateOrder::usl)}) {
    Particles first;
    for (int threads : {1, 2, 3}) {
      Model model = test::empty_model({0, 0, 0}, {3, 2, dimension == 3 ? 1.0 : 0.0}, dimension == 3 ? 0.25 : 0.1,
                                      {Condition::roller, Condition::roller, Condition::fixed});
      test::seed_body(model, "soil", MohrCoulomb{{1900, 1e6, 0.3}, 500, 25, 5}, 2,
                      [](const Vec3& X) { return X[1] < 1.5 - 0.5 * X[0]; });
      test::seed_body(
          model, "rubber", kRubber, 2, [](const Vec3& X) { return X[0] > 2 && X[1] > 1; },
          [](const Vec3&) {
            return Vec3{-3, -1, 0};
          });
      make_updated(model);
      RecordingSink sink;
      const RunReport report = run(model, solver(shape, order, 0.02, {0.5, -9.81, 0}), one_frame(0.02), sink, threads);
      ASSERT_FALSE(report.failed) << report.failure.what;
      if (threads == 1) {
        first = model.particles;
        EXPECT_GT(report.last.plastic, 0);
      } else {
        expect_same_bits(model.particles, first);
      }
    }
  }
}

TEST(Updated, LivesBesideTotalLagrangianBodiesThatDoNotNotice) {
  const auto model_of = [](bool with_updated) {
    Model model = test::empty_model({0, 0, 0}, {3, 1, 0}, 0.125, {Condition::free, Condition::free, Condition::fixed});
    test::seed_body(
        model, "total", kRubber, 2, [](const Vec3& X) { return X[0] < 1; },
        [](const Vec3& X) {
          return Vec3{X[1], 0, 0};
        });
    if (with_updated) {
      test::seed_body(model, "updated", NeoHookean{{1000, 5e4, 0.3}}, 2, [](const Vec3& X) { return X[0] > 2; });
      model.bodies[1].formulation = Formulation::updated_lagrangian;
    }
    return model;
  };
  Model both = model_of(true), alone = model_of(false);
  RecordingSink a, b;
  const SolverOptions options = solver(ShapeFunction::linear, UpdateOrder::musl, 0.1, {0, -9.81, 0});
  ASSERT_FALSE(run(both, options, {}, a, 1).failed);
  ASSERT_FALSE(run(alone, options, {}, b, 1).failed);
  for (std::size_t p = 0; p < alone.particles.size(); ++p)
    EXPECT_EQ(both.particles.position[p], alone.particles.position[p]);
  double sunk = 0;
  for (std::size_t p = both.bodies[1].begin; p < both.bodies[1].end; ++p)
    sunk = std::max(sunk, both.particles.reference_position[p][1] - both.particles.position[p][1]);
  EXPECT_GT(sunk, 0.01);
}

/// Rest under gravity first, then the velocities that were given.
TEST(Updated, RelaxesToRestUnderGravity) {
  for (ShapeFunction shape : kShapes) {
    Model model =
        test::empty_model({0, 0, 0}, {1, 2, 0}, 0.25, {Condition::roller, Condition::roller, Condition::fixed});
    test::seed_body(
        model, "column", NeoHookean{{1000, 1e7, 0.3}}, 2, [](const Vec3& X) { return X[1] < 1; },
        [](const Vec3&) {
          return Vec3{0, 0.01, 0};
        });
    make_updated(model);
    SolverOptions options = solver(shape, UpdateOrder::musl, 1e-6, {0, -10, 0});
    options.relax = RelaxOptions{};
    options.gravity_ramp = 0.01;
    RecordingSink sink;
    sink.on_frame = [&](const Model& m, double time) {
      if (time > 0) return;
      EXPECT_EQ(m.particles.position, m.particles.reference_position);
      double worst = 0;
      for (std::size_t p = 0; p < m.particles.size(); ++p) {
        EXPECT_EQ(m.particles.velocity[p], (Vec3{0, 0.01, 0}));
        const double exact = -1e4 * (1 - m.particles.position[p][1]);
        worst = std::max(worst, std::abs(m.particles.stress[p][1] - exact));
      }
      // Linear functions see the stress of the cell's centre, GIMP too little of the floor.
      EXPECT_LT(worst, shape == ShapeFunction::quadratic_bspline ? 600 : 1500) << name_of(shape);
    };
    const RunReport report = run(model, options, one_frame(1e-6), sink, 1);
    EXPECT_FALSE(report.failed) << report.failure.what;
    EXPECT_EQ(sink.frame_times.size(), 2u);
  }
}

TEST(Updated, LocalDampingTakesEnergyAndItIsAccountedFor) {
  Model model = free_block(2, swirl);
  SolverOptions options = solver(ShapeFunction::quadratic_bspline, UpdateOrder::musl, 0.2);
  options.damping = 0.3;
  RecordingSink sink;
  const RunReport report = run(model, options, one_frame(0.2), sink, 1);
  ASSERT_FALSE(report.failed);
  EXPECT_LT(report.last.kinetic + report.last.strain, 0.9 * report.first.total);
  EXPECT_NEAR(report.last.total, report.first.total, 0.05 * report.first.total);
}

/// A share of PIC per step dissipates with the number of steps, a rate with time. In both formulations.
TEST(Updated, PicRateDissipatesTheSameForAnyTimeStep) {
  for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    const auto energy = [&](double courant, double flip, double rate) {
      Model model = free_block(2, swirl);
      model.bodies[0].formulation = formulation;
      SolverOptions options = solver(ShapeFunction::linear, UpdateOrder::musl, 0.1);
      options.courant = courant;
      options.flip = flip;
      options.pic_rate = rate;
      RecordingSink sink;
      const RunReport report = run(model, options, one_frame(0.1), sink, 1);
      EXPECT_FALSE(report.failed);
      return report.last.total / report.first.total;
    };
    const double loss = 1 - energy(0.4, 1, 20);
    EXPECT_GT(loss, 0.02);
    EXPECT_NEAR(1 - energy(0.1, 1, 20), loss, 0.15 * loss);
    EXPECT_GT(1 - energy(0.1, 0.9, 0), 1.5 * (1 - energy(0.4, 0.9, 0)));
  }
}

/// Two blocks that meet head on through the shared grid stick and end with the mean velocity.
TEST(Updated, BodiesMeetThroughTheSharedGrid) {
  for (ShapeFunction shape : kShapes) {
    Model model = test::empty_model({0, 0, 0}, {4, 2, 0}, 0.125);
    const auto between = [](double low, double high) {
      return [=](const Vec3& X) { return X[0] > low && X[0] < high && X[1] > 0.5 && X[1] < 1.5; };
    };
    test::seed_body(model, "left", kRubber, 2, between(0.75, 1.75), [](const Vec3&) { return Vec3{1, 0, 0}; });
    test::seed_body(model, "right", kRubber, 2, between(2.25, 3.25), [](const Vec3&) { return Vec3{-1, 0, 0}; });
    make_updated(model);
    RecordingSink sink;
    const RunReport report = run(model, solver(shape, UpdateOrder::musl, 0.33), {}, sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    EXPECT_GT(report.last.strain, 0.3 * report.first.kinetic) << name_of(shape);
    double reach = 0;
    for (std::size_t p = 0; p < model.bodies[0].end; ++p) reach = std::max(reach, model.particles.position[p][0]);
    EXPECT_LT(reach, 2.05) << "the left one has passed into the right one";
  }
}

TEST(UpdatedFailure, AParticleThatLeavesTheGridIsNamed) {
  for (ShapeFunction shape : kShapes) {
    Model model = free_block(2, [](const Vec3&) { return Vec3{10, 0, 0}; });
    RecordingSink sink;
    const RunReport report = run(model, solver(shape, UpdateOrder::musl, 1), {}, sink, 1);
    EXPECT_TRUE(report.failed);
    EXPECT_EQ(report.failure.what, "a particle has left the grid");
    ASSERT_GE(report.failure.particle, 0);
    EXPECT_GT(report.failure.position[0], 3);
    EXPECT_LT(report.failure.position[0], 3.3);
    EXPECT_NEAR(report.failure.time, (3 - 1.9375) / 10, 0.02);
    EXPECT_EQ(report.failure.step, report.steps);
    EXPECT_GT(report.steps, 1);
  }
}

TEST(UpdatedFailure, AnInvertedOrInfiniteParticleIsNamed) {
  Model model = free_block(2);
  model.particles.velocity[7] = {1e300, -1e300, 0};
  RecordingSink sink;
  const RunReport report = run(model, solver(ShapeFunction::linear, UpdateOrder::usl, 1e-3), {}, sink, 1);
  EXPECT_TRUE(report.failed);
  EXPECT_FALSE(report.failure.what.empty());
  Model inverted = free_block(2);
  inverted.particles.deformation_gradient[3] = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
  RecordingSink silent;
  EXPECT_TRUE(run(inverted, solver(ShapeFunction::gimp, UpdateOrder::musl, 1), {}, silent, 1).failed);
  EXPECT_TRUE(silent.samples.empty());
}

/// Holding the nodes of a set is holding the faces, for each family of functions.
TEST(Updated, NodeSetsOfTheDomainsLatticeHoldAsFacesDo) {
  for (ShapeFunction shape : kShapes) {
    const auto block = [](std::array<Condition, 6> faces) {
      Model model = test::empty_model({0, 0, 0}, {1, 2, 0}, 0.25, faces);
      test::seed_body(model, "block", kRubber, 2, [](const Vec3& X) { return X[1] < 1; });
      make_updated(model);
      return model;
    };
    Model by_set = block({}), by_faces = block({Condition::roller, Condition::roller, Condition::fixed});
    NodeSet base{"base", Condition::fixed, -1, {}}, sides{"sides", Condition::roller, 0, {}};
    for (int i = 0; i <= 4; ++i) base.nodes.push_back({i, 0, 0});
    for (int j = 0; j <= 8; ++j) {
      sides.nodes.push_back({0, j, 0});
      sides.nodes.push_back({4, j, 0});
    }
    base.nodes.push_back({99, 0, 0});  // not a node of the grid: nothing to hold
    by_set.bodies[0].held = {base, sides};
    RecordingSink a, b;
    const SolverOptions options = solver(shape, UpdateOrder::musl, 0.2, {-3, -9.81, 0});
    ASSERT_FALSE(run(by_set, options, {}, a, 1).failed);
    const RunReport report = run(by_faces, options, {}, b, 1);
    ASSERT_FALSE(report.failed);
    EXPECT_EQ(by_set.particles.position, by_faces.particles.position) << name_of(shape);
    EXPECT_GT(report.last.strain, 0);
  }
}

/// A sudden stop on a floor with rollers: nothing passes through the walls, whatever the functions' reach.
TEST(Updated, WallsKeepTheParticlesIn) {
  for (ShapeFunction shape : kShapes) {
    Model model =
        test::empty_model({0, 0, 0}, {1, 2, 0}, 0.125, {Condition::roller, Condition::roller, Condition::roller});
    test::seed_body(
        model, "block", kRubber, 2, [](const Vec3& X) { return X[1] < 1; },
        [](const Vec3& X) {
          return Vec3{2 * std::sin(6 * X[1]), -4, 0};
        });
    make_updated(model);
    RecordingSink sink;
    const RunReport report = run(model, solver(shape, UpdateOrder::musl, 0.5, {0, -9.81, 0}), one_frame(0.5), sink, 1);
    ASSERT_FALSE(report.failed) << name_of(shape) << ": " << report.failure.what;
    for (const Vec3& x : model.particles.position) {
      EXPECT_GT(x[1], shape == ShapeFunction::gimp ? -0.25 * 0.125 : 0.0);
      EXPECT_LT(x[1], 2);
    }
  }
}

/// One particle alone in the corner of its cell: v~ = v + dt f / m at the light nodes across is huge in the USL order,
/// and the velocity gradient follows it; MUSL and USF take it from velocities that particles have.
TEST(Updated, UslFeelsLightNodesAndTheOthersDoNot) {
  std::array<double, 3> strain{};
  for (std::size_t i = 0; i < kOrders.size(); ++i) {
    Model model = test::empty_model({0, 0, 0}, {1, 1, 0}, 0.25);
    test::seed_body(model, "block", kRubber, 2, [](const Vec3& X) { return X[0] < 0.5 && X[1] < 0.5; });
    make_updated(model);
    for (std::size_t p = 0; p < model.particles.size(); ++p) {
      Vec3& x = model.particles.position[p];
      if (x[0] > 0.4) x[0] = 0.5 + 1e-7;  // just over into the next cell
      model.particles.deformation_gradient[p] = {0.99, 0, 0, 0, 1, 0, 0, 0, 1};
      const Sym6& s = model.particles.stress[p] = {-1e3, 0, 0, 0, 0, 0};
      ASSERT_LT(s[0], 0);
    }
    Formulations method(model, solver(ShapeFunction::linear, kOrders[i], 1), 1);
    method.step(method.stable_time_step());
    for (const Mat3& F : model.particles.deformation_gradient) strain[i] = std::max(strain[i], std::abs(F[0] - 0.99));
  }
  EXPECT_LT(strain[0], 0.1);
  EXPECT_GT(strain[1], 1e3);
  EXPECT_LT(strain[2], 0.1);
}

/// Below the cut-off USL takes the mapped velocity instead.
TEST(Updated, UslLeavesTheLightestNodesOutOfTheGradientButNoMomentum) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, 0}, 0.25);
  test::seed_body(model, "block", kRubber, 2, [](const Vec3& X) { return X[0] < 0.5 && X[1] < 0.5; });
  make_updated(model);
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    Vec3& x = model.particles.position[p];
    if (x[0] > 0.4) x[0] = 0.5 + 1e-12;
    model.particles.stress[p] = {-1e3, 0, 0, 0, 0, 0};
  }
  Formulations method(model, solver(ShapeFunction::linear, UpdateOrder::usl, 1), 1);
  method.step(method.stable_time_step());
  double momentum = 0, largest = 0, strain = 0;
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    momentum += model.particles.mass[p] * model.particles.velocity[p][0];
    largest = std::max(largest, model.particles.mass[p] * std::abs(model.particles.velocity[p][0]));
    strain = std::max(strain, std::abs(model.particles.deformation_gradient[p][0] - 1));
  }
  EXPECT_LT(strain, 0.5);
  EXPECT_GT(largest, 0.1);
  EXPECT_LT(std::abs(momentum), 1e-12 * largest);
}

void expect_refused(const Model& model, const SolverOptions& options, const std::string& words) {
  Model copy = model;
  RecordingSink sink;
  for (int which : {0, 1}) try {
      if (which)
        estimate(copy, options, {});
      else
        run(copy, options, {}, sink, 1);
      ADD_FAILURE() << "not refused: " << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(Updated, RefusesWhatItCannotRun) {
  const SolverOptions linear = solver(ShapeFunction::linear, UpdateOrder::musl, 1);
  Model model = free_block(2);
  Model total = model;
  total.bodies[0].formulation = Formulation::total_lagrangian;
  expect_refused(total, solver(ShapeFunction::linear, UpdateOrder::usl, 1), "usl");
  expect_refused(total, solver(ShapeFunction::gimp, UpdateOrder::musl, 1), "gimp");

  Model outside = model;
  outside.particles.position[5] = {3.5, 1, 0};
  expect_refused(outside, linear, "outside the domain");
  Model not_finite = model;
  not_finite.particles.position[5][0] = NAN;
  expect_refused(not_finite, linear, "finite");
  Model huge = model;
  huge.domain.max = {1e5, 1e5, 0};
  expect_refused(huge, linear, "size of the domain");
  Model broken = model;
  broken.domain.max[0] = 2.9;
  expect_refused(broken, linear, "whole cells");
  Model pulled = model;
  LoadOptions pull;
  pull.where.body = pulled.bodies[0].name;
  pull.velocity = Vec3{1, 0, 0};
  pulled.loads = {pull};
  expect_refused(pulled, linear, "share their nodes");
  pulled.loads[0].where = {BoxShape{{0.3, 0.3, 0}, {0.35, 0.35, 0}}, {}, {}};
  expect_refused(pulled, linear, "on no node");
  Model large = model;
  for (double& V : large.particles.reference_volume) V *= 5;
  expect_refused(large, solver(ShapeFunction::gimp, UpdateOrder::musl, 1), "edge of particle");
  Model shifted = model;
  shifted.bodies[0].held = {{"base", Condition::fixed, -1, {{0, 0, 0}}}};
  shifted.bodies[0].lattice.cell = 0.3;
  expect_refused(shifted, linear, "that of the domain");
  Model axis = model;
  axis.bodies[0].held = {{"bad", Condition::roller, 3, {{0, 0, 0}}}};
  expect_refused(axis, linear, "axis of the roller");
}

}  // namespace
}  // namespace scarp

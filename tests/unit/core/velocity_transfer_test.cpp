// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// APIC and XPIC, in both formulations.
#include <gtest/gtest.h>

#include "solver/core/apic.hpp"
#include "solver/core/check_model.hpp"
#include "solver/core/estimate.hpp"
#include "solver/core/formulations.hpp"
#include "solver/core/run.hpp"
#include "solver/core/transfer.hpp"
#include "solver/core/updated_transfer.hpp"
#include "solver/core/xpic.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

using test::RecordingSink;

const NeoHookean kRubber{{1000, 1e5, 0.3}};
constexpr std::array<ShapeFunction, 3> kShapes{ShapeFunction::linear, ShapeFunction::quadratic_bspline,
                                               ShapeFunction::gimp};
constexpr Mat3 kA{0.3, -0.5, 0.2, 0.7, 0.1, -0.4, -0.6, 0.9, 0.8};

Vec3 affine(int dimension, const Vec3& x) {
  Vec3 v{0, 0, 0};
  for (int i = 0; i < dimension; ++i) {
    v[i] = 0.2 + 0.1 * i;
    for (int a = 0; a < dimension; ++a) v[i] += kA[3 * i + a] * x[a];
  }
  return v;
}

Vec3 swirl(const Vec3& X) { return {std::sin(3 * X[1]) + 0.2, 0.5 * std::cos(2 * X[0]), 0}; }

/// A cut block, unevenly filled, that reaches to the walls or not.
Model block(int dimension, double low, double high, Formulation formulation,
            const std::function<Vec3(const Vec3&)>& velocity) {
  const double depth = dimension == 3 ? 1 : 0;
  Model model = test::empty_model({0, 0, 0}, {3, 3, 3 * depth}, 0.25);
  test::seed_body(
      model, "block", kRubber, 3,
      [&](const Vec3& X) {
        for (int a = 0; a < dimension; ++a)
          if (X[a] < low || X[a] > high) return false;
        return X[0] + X[1] < 1.8 * high;
      },
      velocity);
  model.bodies[0].formulation = formulation;
  sort_by_cell(model);
  return model;
}

SolverOptions with(Transfer transfer, double end_time, ShapeFunction shape = ShapeFunction::linear) {
  SolverOptions options = test::solver(end_time, {0, 0, 0}, 0.4, shape);
  options.transfer = transfer;
  return options;
}

/// Affine node velocities give every particle the field's gradient, but less of it where one function has nearly all
/// the weight: in the cells at the walls of B-splines. The map back gives the field again.
TEST(Apic, AffineFieldsPassExactly) {
  for (int dimension : {2, 3})
    for (ShapeFunction shape : kShapes) {
      Model model = block(dimension, 0, 1.1, Formulation::updated_lagrangian,
                          [&](const Vec3& X) { return affine(dimension, X); });
      UpdatedGrid grid = make_updated_grid(model, shape, 2);
      begin_affine(model.particles, grid, 2);
      const std::vector<Vec3> nodes = node_positions(grid);
      for (std::size_t i = 0; i < nodes.size(); ++i) grid.velocity_updated[i] = affine(dimension, nodes[i]);
      advance_affine(model.particles, grid, 2);
      const bool has_less = shape == ShapeFunction::quadratic_bspline;
      for (std::size_t p = 0; p < model.particles.size(); ++p)
        for (int i = 0; i < dimension; ++i)
          for (int a = 0; a < dimension; ++a) {
            const double got = grid.affine[p][3 * i + a] / kA[3 * i + a];
            if (has_less && model.particles.position[p][a] < 0.25) {
              EXPECT_GT(got, 0.5);
              EXPECT_LT(got, 1 + 1e-12);
            } else {
              EXPECT_NEAR(got, 1, 1e-12) << name_of(shape);
            }
          }
      map_to_nodes(model.particles, grid, 2);
      add_affine_momenta(model.particles, grid, 2);
      find_node_velocities(grid, 2);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (grid.mass[i] > grid.light_mass &&
            !(has_less && std::min({nodes[i][0], nodes[i][1], nodes[i][2] + 3 - dimension}) < 0.5)) {
          EXPECT_LT(norm(grid.velocity[i] - affine(dimension, nodes[i])), 1e-9) << name_of(shape);
        }
    }
}

TEST(Apic, AffineFieldsPassExactlyInTheReferenceConfiguration) {
  for (int dimension : {2, 3}) {
    Model model =
        block(dimension, 0, 1.1, Formulation::total_lagrangian, [&](const Vec3& X) { return affine(dimension, X); });
    TotalBody body = make_total_body(model, model.bodies[0]);
    begin_affine(model.particles, body, 2);
    for (std::size_t i = 0; i < body.grid.nodes.size(); ++i)
      body.velocity_updated[i] = body.velocity[i] = affine(dimension, body.node_positions[i]);
    advance_particles(model.particles, body, {0, 0}, 0.1, 2);
    advance_affine(model.particles, body, 2);
    find_node_velocities(body, 2);
    for (const Mat3& C : body.affine)
      for (int i = 0; i < dimension; ++i)
        for (int a = 0; a < dimension; ++a) EXPECT_NEAR(C[3 * i + a], kA[3 * i + a], 1e-12);
    for (std::size_t i = 0; i < body.grid.nodes.size(); ++i)
      EXPECT_LT(norm(body.velocity[i] - affine(dimension, body.node_positions[i])), 1e-12);
  }
}

/// S v*, one application of I - S S+ after the other.
std::vector<Vec3> filtered_by_hand(const Model& model, ShapeFunction shape, int order) {
  Model copy = model;
  UpdatedGrid grid = make_updated_grid(copy, shape, 1);
  std::vector<Vec3> rest = copy.particles.velocity;
  for (int k = 0; k < order; ++k) {
    copy.particles.velocity = rest;
    map_to_nodes(copy.particles, grid, 1);
    find_node_velocities(grid, 1);
    grid.velocity_updated = grid.velocity;
    advance_particles(copy.particles, grid, {0, 0}, 0, 1);  // S S+ rest
    for (std::size_t p = 0; p < rest.size(); ++p) rest[p] = rest[p] - copy.particles.velocity[p];
  }
  for (std::size_t p = 0; p < rest.size(); ++p) rest[p] = model.particles.velocity[p] - rest[p];
  return rest;
}

TEST(Xpic, FiltersAsItsOperatorSays) {
  for (int dimension : {2, 3})
    for (ShapeFunction shape : kShapes)
      for (int order : {1, 2, 3, 5}) {
        if (dimension == 3 && order > 2) continue;
        Model model = block(dimension, 0.6, 1.6, Formulation::updated_lagrangian, swirl);
        const std::vector<Vec3> expected = filtered_by_hand(model, shape, order);
        UpdatedGrid grid = make_updated_grid(model, shape, 2);
        grid.kept = grid.held;
        map_to_nodes(model.particles, grid, 2);
        find_node_velocities(grid, 2);
        grid.velocity_updated = grid.velocity;
        filter_velocities(model.particles, grid, order, 2);
        advance_particles(model.particles, grid, {0, 1}, 0, 2);
        double worst = 0;
        for (std::size_t p = 0; p < expected.size(); ++p)
          worst = std::max(worst, norm(model.particles.velocity[p] - expected[p]));
        EXPECT_LT(worst, 1e-13) << name_of(shape) << order;
      }
}

TEST(Xpic, TotalAndUpdatedFilterAlikeInTheFirstStep) {
  for (int dimension : {2, 3}) {
    Model total = block(dimension, 0.6, 1.6, Formulation::total_lagrangian, swirl), updated = total;
    updated.bodies[0].formulation = Formulation::updated_lagrangian;
    SolverOptions options = with(Transfer::xpic, 1);
    options.xpic_order = 4;
    Formulations a(updated, options, 1), b(total, options, 1);
    const double dt = b.stable_time_step();
    a.step(dt);
    b.step(dt);
    double worst = 0, change = 0;
    std::vector<Vec3> filtered(updated.particles.size());  // by id: the formulations sort in orders of their own
    for (std::size_t p = 0; p < filtered.size(); ++p) filtered[updated.particles.id[p]] = updated.particles.velocity[p];
    for (std::size_t p = 0; p < total.particles.size(); ++p) {
      worst = std::max(worst, norm(total.particles.velocity[p] - filtered[total.particles.id[p]]));
      change = std::max(change, norm(total.particles.velocity[p] - swirl(total.particles.reference_position[p])));
    }
    EXPECT_LT(worst, 1e-13);
    EXPECT_GT(change, 1e-4);
  }
}

/// What is driven moves as it is told, and what is held stays: v*_I is v_I there.
TEST(Xpic, KeepsWhatConditionsSay) {
  for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    Model model = test::empty_model({0, 0, 0}, {1, 1, 0}, 0.25, {Condition::fixed});
    test::seed_body(model, "block", kRubber, 2, test::everywhere);
    model.bodies[0].formulation = formulation;
    LoadOptions load;
    load.name = "pull";
    load.where.face = FaceName::x_max;
    load.velocity = Vec3{0.5, 0, 0};
    model.loads.push_back(load);
    SolverOptions options = with(Transfer::xpic, 0.02);
    options.xpic_order = 3;
    RecordingSink sink;
    const RunReport report = run(model, options, test::output(0.02, 0.02), sink, 1);
    ASSERT_FALSE(report.failed);
    for (std::size_t p = 0; p < model.particles.size(); ++p) {
      const double X = model.particles.reference_position[p][0], v = model.particles.velocity[p][0];
      if (X > 0.9) {
        EXPECT_NEAR(v, 0.5, 0.1);
      } else if (X < 0.1) {
        EXPECT_LT(std::abs(v), 0.1);
      }
    }
  }
}

TEST(VelocityTransfer, ConservesMomentumInEveryOrderAndShape) {
  for (Transfer transfer : {Transfer::apic, Transfer::xpic})
    for (int dimension : {2, 3})
      for (ShapeFunction shape : kShapes)
        for (UpdateOrder order : {UpdateOrder::musl, UpdateOrder::usl, UpdateOrder::usf}) {
          if (dimension == 3 && order != UpdateOrder::musl) continue;
          Model model = block(dimension, 0.8, 1.6, Formulation::updated_lagrangian, swirl);
          SolverOptions options = with(transfer, dimension == 2 ? 0.05 : 0.01, shape);
          options.update = order;
          RecordingSink sink;
          const RunReport report = run(model, options, test::output(options.end_time, options.end_time), sink, 1);
          ASSERT_FALSE(report.failed) << report.failure.what;
          EXPECT_LT(norm(report.last.momentum - report.first.momentum), 1e-12 * norm(report.first.momentum));
          EXPECT_GT(report.last.strain, 0.001 * report.first.kinetic);
        }
}

/// APIC on B-splines keeps angular momentum through deformation, PIC and FLIP do not.
TEST(Apic, ConservesAngularMomentum) {
  for (int dimension : {2, 3}) {
    const auto change = [&](Transfer transfer, double flip) {
      Model model = block(dimension, 0.8, 1.6, Formulation::updated_lagrangian, swirl);
      SolverOptions options = with(transfer, 0.05, ShapeFunction::quadratic_bspline);
      options.flip = flip;
      RecordingSink sink;
      const RunReport report = run(model, options, test::output(0.05, 0.05), sink, 1);
      EXPECT_FALSE(report.failed);
      return norm(report.last.angular_momentum - report.first.angular_momentum) / norm(report.first.angular_momentum);
    };
    EXPECT_LT(change(Transfer::apic, 1), 1e-12);
    EXPECT_GT(change(Transfer::flip, 0), 1e-3);
  }
}

TEST(VelocityTransfer, EnergyFallsAndBalanceCountsTheAffinePart) {
  for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian})
    for (Transfer transfer : {Transfer::apic, Transfer::xpic}) {
      Model model = block(2, 0.8, 1.6, formulation, swirl);
      SolverOptions options = with(transfer, 0.1);
      if (transfer == Transfer::xpic) options.xpic_order = 4;
      RecordingSink sink;
      const RunReport report = run(model, options, test::output(0.1, 0.1), sink, 1);
      ASSERT_FALSE(report.failed);
      EXPECT_LT(report.last.total, 1.005 * report.first.total);  // MUSL ripples
      EXPECT_GT(report.last.total, 0.7 * report.first.total);
      double centres = 0;
      for (std::size_t p = 0; p < model.particles.size(); ++p)
        centres += 0.5 * model.particles.mass[p] * dot(model.particles.velocity[p], model.particles.velocity[p]);
      if (transfer == Transfer::apic)
        EXPECT_GT(report.last.kinetic, centres * (1 + 1e-4));
      else
        EXPECT_NEAR(report.last.kinetic, centres, 1e-12 * centres);
    }
}

TEST(VelocityTransfer, SameBitsForAnyNumberOfThreads) {
  for (Transfer transfer : {Transfer::apic, Transfer::xpic})
    for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
      std::vector<Vec3> first;
      HistorySample last;
      for (int threads : {1, 3}) {
        Model model = block(2, 0.5, 1.9, formulation, swirl);
        RecordingSink sink;
        const RunReport report = run(model, with(transfer, 0.02), test::output(0.02, 0.02), sink, threads);
        ASSERT_FALSE(report.failed);
        if (threads == 1) {
          first = model.particles.velocity;
          last = report.last;
        } else {
          EXPECT_EQ(model.particles.velocity, first);
          EXPECT_EQ(report.last.kinetic, last.kinetic);
          EXPECT_EQ(report.last.angular_momentum, last.angular_momentum);
        }
      }
    }
}

TEST(VelocityTransfer, TheNodalFormSaysWhyItIsNotUsed) {
  Model model = block(2, 0.5, 1.9, Formulation::total_lagrangian, swirl);
  EXPECT_EQ(Formulations(model, with(Transfer::flip, 1), 1).obstacles()[0], "");
  EXPECT_EQ(Formulations(model, with(Transfer::apic, 1), 1).obstacles()[0],
            "transfer = \"apic\" goes through the particles");
}

/// A start at rest leaves no affine velocity behind, and kinetic energy that dies with the rest.
TEST(Apic, RelaxesToRest) {
  for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    Model model = test::empty_model({0, 0, 0}, {1, 2, 0}, 0.25,
                                    {Condition::roller, Condition::roller, Condition::fixed, Condition::free});
    test::seed_body(model, "column", NeoHookean{{1000, 1e7, 0.3}}, 2, [](const Vec3& X) { return X[1] < 1; });
    model.bodies[0].formulation = formulation;
    SolverOptions options = with(Transfer::apic, 1e-6);
    options.gravity = Vec3{0, -10, 0};
    options.relax = RelaxOptions{};
    RecordingSink sink;
    const RunReport report = run(model, options, test::output(1e-6, 1e-6), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    EXPECT_EQ(sink.samples[0].kinetic, 0);
    EXPECT_LT(std::abs(model.particles.stress[0][1] + 1e4), 2000);
  }
}

TEST(VelocityTransfer, OptionsThatDoNotGoTogetherAreRefused) {
  const auto refused = [](const SolverOptions& options) {
    try {
      check_options(options, 2);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  SolverOptions options = with(Transfer::apic, 1);
  EXPECT_EQ(refused(options), "no error");
  options.flip = 0.9;
  EXPECT_NE(refused(options).find("transfer = \"flip\""), std::string::npos);
  options.flip = 1;
  options.pic_rate = 1;
  EXPECT_NE(refused(options).find("pic_rate"), std::string::npos);
  options.pic_rate = 0;
  options.reference_update = 2;
  EXPECT_NE(refused(options).find("reference_update"), std::string::npos);
  options.reference_update.reset();
  options.xpic_order = 3;
  EXPECT_NE(refused(options).find("transfer = \"xpic\""), std::string::npos);
  options.transfer = Transfer::xpic;
  EXPECT_EQ(refused(options), "no error");
  for (int order : {1, 6}) {
    options.xpic_order = order;
    EXPECT_NE(refused(options).find("2 to 5"), std::string::npos);
  }
}

TEST(Apic, MemoryIsEstimated) {
  const Model model = block(2, 0.5, 1.9, Formulation::updated_lagrangian, swirl);
  const double more = estimate(model, with(Transfer::apic, 1), {}).memory_bytes -
                      estimate(model, with(Transfer::flip, 1), {}).memory_bytes;
  EXPECT_EQ(more, static_cast<double>(model.particles.size() * sizeof(Mat3)));
}

}  // namespace
}  // namespace scarp

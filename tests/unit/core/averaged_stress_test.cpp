// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/averaged_stress.hpp"

#include <gtest/gtest.h>

#include "solver/core/formulations.hpp"
#include "solver/core/run.hpp"
#include "solver/core/transfer.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"

namespace scarp {
namespace {

const NeoHookean kRubber{{1000, 1e5, 0.45}};

Vec3 swirl(const Vec3& X) { return {std::sin(3 * X[1]) + 0.2, 0.5 * std::cos(2 * X[0]), 0}; }

/// A block in the middle of a wide domain, free on all sides.
Model free_block(int dimension, const Material& law, const std::function<Vec3(const Vec3&)>& velocity,
                 Formulation formulation = Formulation::total_lagrangian) {
  Model model = test::empty_model({0, 0, 0}, {3, 3, dimension == 3 ? 3.0 : 0.0}, 0.25);
  test::seed_body(
      model, "block", law, 2,
      [&](const Vec3& X) {
        return X[0] > 1 && X[0] < 2 && X[1] > 1 && X[1] < 2 && (dimension == 2 || (X[2] > 1 && X[2] < 2));
      },
      velocity);
  model.bodies[0].formulation = formulation;
  return model;
}

SolverOptions options_of(double end_time, AntiLocking anti_locking, ShapeFunction shape = ShapeFunction::linear) {
  SolverOptions options;
  options.end_time = end_time;
  options.gravity = Vec3{0, 0, 0};
  options.anti_locking = anti_locking;
  options.shape = shape;
  return options;
}

/// A body whose nodes have moved by u from the reference configuration: F = I + grad u.
struct Displaced {
  Displaced(int dimension, const std::function<Vec3(std::size_t)>& u)
      : model(free_block(dimension, kRubber, {})), laws{prepare(model.materials[0].law)} {
    sort_by_cell(model);
    body = make_total_body(model, model.bodies[0]);
    average_volumes(body, model.particles);
    for (std::size_t i = 0; i < body.velocity.size(); ++i) body.velocity[i] = u(i);
    update_stress(model.particles, body, laws, 1, 1);
  }

  /// sum V0 W(F-bar), the obvious way.
  double energy() const {
    double sum = 0;
    for (std::size_t p = 0; p < model.particles.size(); ++p) {
      const Mat3& F = model.particles.deformation_gradient[p];
      sum += model.particles.reference_volume[p] *
             std::visit([&](const auto& law) { return law.stored_energy(make_motion(F, F), {}); }, laws[0]);
    }
    return sum;
  }

  Vec3 force(std::size_t node) {
    std::fill(body.velocity.begin(), body.velocity.end(), Vec3{0, 0, 0});
    advance_nodes(body, {0, 0, 0}, 1, 1);
    return body.grid.node_mass[node] * body.velocity_updated[node];
  }

  Model model;
  std::vector<PreparedLaw> laws;
  TotalBody body;
};

/// Some unevenness; small enough for every J to stay positive.
Vec3 uneven(std::size_t node, int dimension) {
  const double n = static_cast<double>(node);
  return {0.03 * std::sin(7 * n), 0.03 * std::cos(5 * n + 1), dimension == 3 ? 0.03 * std::sin(3 * n + 2) : 0};
}

TEST(AveragedStress, ForcesAreTheDerivativeOfTheEnergy) {
  for (int dimension : {2, 3}) {
    const auto u = [&](std::size_t i) { return uneven(i, dimension); };
    Displaced state(dimension, u);
    const std::size_t middle = state.body.grid.nodes.size() / 2;
    for (std::size_t node : {std::size_t{0}, middle})
      for (int a = 0; a < dimension; ++a) {
        const double e = 1e-5;
        const auto moved = [&](double by) {
          return Displaced(dimension,
                           [&](std::size_t i) {
                             Vec3 v = u(i);
                             if (i == node) v[a] += by;
                             return v;
                           })
              .energy();
        };
        const double expected = -(moved(e) - moved(-e)) / (2 * e);
        EXPECT_NEAR(state.force(node)[a], expected, 1e-5 * (1 + std::abs(expected))) << dimension << "D, " << node;
      }
  }
}

TEST(AveragedStress, LawsSeeTheMeanVolumeRatioOfTheCell) {
  for (int dimension : {2, 3}) {
    const Displaced state(dimension, [&](std::size_t i) { return uneven(i, dimension); });
    const auto& begin = state.body.grid.cell_begin;
    for (std::size_t c = 0; c + 1 < begin.size(); ++c) {
      double mean = 0, spread = 0;
      for (std::size_t p = begin[c]; p < begin[c + 1]; ++p)
        mean += determinant(state.body.since[p]) / static_cast<double>(begin[c + 1] - begin[c]);
      for (std::size_t p = begin[c]; p < begin[c + 1]; ++p) {
        EXPECT_NEAR(determinant(state.model.particles.deformation_gradient[p]), mean, 1e-13);
        spread = std::max(spread, std::abs(determinant(state.body.since[p]) - mean));
      }
      EXPECT_GT(spread, 1e-3);
    }
  }
}

/// Stretch and shear that are the same everywhere: F-bar is F.
TEST(AveragedStress, ChangesNothingWhereTheDeformationIsUniform) {
  for (const Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian})
    for (int dimension : {2, 3}) {
      const auto uniform = [](const Vec3& X) { return Vec3{0.4 * X[0] + 0.3 * X[1], -0.2 * X[0] + 0.1 * X[1], 0}; };
      Model plain = free_block(dimension, kRubber, uniform, formulation), averaged = plain;
      Formulations a(plain, options_of(1, AntiLocking::none), 1), b(averaged, options_of(1, AntiLocking::f_bar), 1);
      a.step(1e-3);
      b.step(1e-3);
      a.write_particles();
      b.write_particles();
      // MUSL's second map is uniform inside only.
      for (std::size_t p = 0; p < plain.particles.size(); ++p) {
        const Vec3& X = plain.particles.reference_position[p];
        if (std::abs(X[0] - 1.5) > 0.25 || std::abs(X[1] - 1.5) > 0.25 ||
            (dimension == 3 && std::abs(X[2] - 1.5) > 0.25))
          continue;
        for (int i = 0; i < 9; ++i)
          EXPECT_NEAR(plain.particles.deformation_gradient[p][i], averaged.particles.deformation_gradient[p][i], 1e-14);
        for (int i = 0; i < 6; ++i)
          EXPECT_NEAR(plain.particles.stress[p][i], averaged.particles.stress[p][i], 1e-9 * kRubber.youngs_modulus);
      }
    }
}

TEST(AveragedStress, FirstUpdatedLagrangianStepIsTheTotalLagrangianOne) {
  for (int dimension : {2, 3}) {
    Model total = free_block(dimension, kRubber, swirl), updated = total;
    updated.bodies[0].formulation = Formulation::updated_lagrangian;
    Formulations a(total, options_of(1, AntiLocking::f_bar), 1), b(updated, options_of(1, AntiLocking::f_bar), 1);
    const double dt = a.stable_time_step();
    a.step(dt);
    b.step(dt);
    a.write_particles();
    for (std::size_t p = 0; p < total.particles.size(); ++p) {
      for (int i = 0; i < 9; ++i)
        EXPECT_NEAR(total.particles.deformation_gradient[p][i], updated.particles.deformation_gradient[p][i], 1e-14);
      EXPECT_LT(norm(total.particles.velocity[p] - updated.particles.velocity[p]), 1e-14);
    }
  }
}

/// A blob that rings and yields: nothing is lost but what the law dissipates.
TEST(AveragedStress, ConservesMomentumAndClosesTheBalanceForElasticAndPlasticLaws) {
  const MohrCoulomb soil{{1900, 1e6, 0.45}, 2e3, 20, 0};
  struct Case {
    Formulation formulation;
    ShapeFunction shape;
  };
  for (const Case c : {Case{Formulation::total_lagrangian, ShapeFunction::linear},
                       Case{Formulation::updated_lagrangian, ShapeFunction::quadratic_bspline},
                       Case{Formulation::updated_lagrangian, ShapeFunction::gimp}})
    for (const Material& law : {Material(kRubber), Material(soil)}) {
      Model model = free_block(2, law, swirl, c.formulation);
      SolverOptions options = options_of(0.1, AntiLocking::f_bar, c.shape);
      options.courant = 0.1;
      OutputOptions output;
      output.every = output.history_every = 0.01;
      test::RecordingSink sink;
      const RunReport report = run(model, options, output, sink, 1);
      ASSERT_FALSE(report.failed) << report.failure.what;
      EXPECT_LT(norm(report.last.momentum - report.first.momentum), 1e-12 * norm(report.first.momentum));
      EXPECT_LT(report.largest_energy_error, 0.01 * report.first.kinetic) << name_of(c.shape);
      EXPECT_GT(report.last.strain + report.last.plastic, 0.05 * report.first.kinetic);
    }
}

TEST(AveragedStress, SameBitsForAnyNumberOfThreads) {
  for (const Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    std::vector<Vec3> first;
    for (int threads : {1, 3}) {
      Model model = free_block(2, kRubber, swirl, formulation);
      test::RecordingSink sink;
      run(model, options_of(0.05, AntiLocking::f_bar), {}, sink, threads);
      if (threads == 1) first = model.particles.position;
      EXPECT_EQ(model.particles.position, first);
    }
  }
}

}  // namespace
}  // namespace scarp

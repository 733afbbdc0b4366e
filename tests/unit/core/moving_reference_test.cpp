// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/moving_reference.hpp"

#include <gtest/gtest.h>

#include "solver/core/averaged_stress.hpp"
#include "solver/core/formulations.hpp"
#include "solver/core/run.hpp"
#include "solver/core/transfer.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

const NeoHookean kRubber{{1000, 1e5, 0.3}};
const MohrCoulomb kSoil{{1900, 1e6, 0.3}, 2e3, 25, 5};

Vec3 times(const Mat3& A, const Vec3& x) {
  return {A[0] * x[0] + A[1] * x[1] + A[2] * x[2], A[3] * x[0] + A[4] * x[1] + A[5] * x[2],
          A[6] * x[0] + A[7] * x[1] + A[8] * x[2]};
}

/// A free block of unit sides.
Model free_block(int dimension, const Material& law, const std::function<Vec3(const Vec3&)>& velocity = {}) {
  Model model = test::empty_model({0, 0, 0}, {3, 3, dimension == 3 ? 3.0 : 0.0}, 0.25);
  test::seed_body(
      model, "block", law, 2,
      [&](const Vec3& X) {
        return X[0] > 1 && X[0] < 2 && X[1] > 1 && X[1] < 2 && (dimension == 2 || (X[2] > 1 && X[2] < 2));
      },
      velocity);
  return model;
}

/// A block whose nodes have moved by u(X) at once; forces, F and energies of it.
struct Moved {
  Moved(int dimension, bool f_bar, const std::function<Vec3(const Vec3& X)>& u)
      : model(free_block(dimension, kRubber)), laws{prepare(model.materials[0].law)} {
    sort_by_cell(model);
    body = make_total_body(model, model.bodies[0]);
    if (f_bar) average_volumes(body, model.particles);
    carry(u);
  }

  /// Nodes and particles move by u of the nodes' places on the body's grid.
  void carry(const std::function<Vec3(const Vec3& X)>& u) {
    for (std::size_t i = 0; i < body.velocity.size(); ++i) {
      body.velocity[i] = {0, 0, 0};
      body.velocity_updated[i] = u(body.node_positions[i]);
    }
    advance_particles(model.particles, body, {1, 1}, 1, 1);
    for (std::size_t i = 0; i < body.velocity.size(); ++i) body.velocity[i] = u(body.node_positions[i]);
    update_stress(model.particles, body, laws, 1, 1);
  }

  void move() { ASSERT_FALSE(move_reference(model, body)); }

  double energy() const {
    double sum = 0;
    for (std::size_t p = 0; p < model.particles.size(); ++p) {
      const Mat3& F = model.particles.deformation_gradient[p];
      sum += model.particles.reference_volume[p] *
             std::visit([&](const auto& law) { return law.stored_energy(make_motion(F, F), {}); }, laws[0]);
    }
    return sum;
  }

  /// Of the particles' stress on the nodes.
  std::vector<Vec3> forces() {
    map_stress(model.particles, body, laws, 1);
    std::fill(body.velocity.begin(), body.velocity.end(), Vec3{0, 0, 0});
    advance_nodes(body, {0, 0, 0}, 1, 1);
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < body.velocity.size(); ++i)
      result.push_back(body.grid.node_mass[i] * body.velocity_updated[i]);
    return result;
  }

  Model model;
  std::vector<PreparedLaw> laws;
  TotalBody body;
};

/// x = A X, about the middle of the domain.
std::function<Vec3(const Vec3&)> linear(const Mat3& A) {
  return [A](const Vec3& X) {
    const Vec3 from_middle = X - Vec3{1.5, 1.5, 1.5};
    return times(A, from_middle) - from_middle;
  };
}

Mat3 stretch(int dimension) { return {1.7, 0.4, 0, -0.1, 0.8, 0, 0, 0, dimension == 3 ? 1.1 : 1}; }

Mat3 rotation(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

/// sum of f_I (A x_I) over the nodes: minus the stress power of the uniform velocity gradient A.
double power(const Moved& state, const std::vector<Vec3>& forces, const Mat3& A, const Mat3& F) {
  double sum = 0;
  for (std::size_t i = 0; i < forces.size(); ++i)
    sum += dot(forces[i], times(A, times(F, state.body.node_positions[i])));
  return sum;
}

TEST(MovingReference, AUniformStretchHasTheSameStressAndForcesBeforeAndAfter) {
  for (int dimension : {2, 3})
    for (bool f_bar : {false, true}) {
      const Mat3 F = stretch(dimension), A{0.3, -0.2, 0, 0.5, 0.7, 0, 0, 0, dimension == 3 ? 0.4 : 0};
      Moved state(dimension, f_bar, linear(F));
      const Particles before = state.model.particles;
      const double power_before = power(state, state.forces(), A, F);
      state.move();
      const Particles& after = state.model.particles;
      Vec3 sum{0, 0, 0};
      const std::vector<Vec3> forces = state.forces();
      for (const Vec3& f : forces) sum = sum + f;
      EXPECT_LT(norm(sum), 1e-9 * std::abs(power_before));
      EXPECT_NEAR(power(state, forces, A, kIdentity), power_before, 2e-3 * std::abs(power_before))
          << "particles stand a thousandth of a cell off at most";
      double volume = 0;
      for (std::size_t p = 0; p < after.size(); ++p) {
        const std::size_t q = std::find(before.id.begin(), before.id.end(), after.id[p]) - before.id.begin();
        EXPECT_EQ(after.stress[p], before.stress[q]);
        EXPECT_EQ(after.deformation_gradient[p], before.deformation_gradient[q]);
        EXPECT_EQ(after.reference_position[p], before.reference_position[q]);
        for (int i = 0; i < 9; ++i) EXPECT_NEAR(after.deformation_gradient[p][i], F[i], 1e-12);
        volume += after.reference_volume[p];
      }
      EXPECT_NEAR(volume, 1, 1e-12);
      // A second stretch, on the new grid: F is that of both.
      state.carry(linear(stretch(dimension)));
      const Mat3 both = multiply(stretch(dimension), F);
      for (std::size_t p = 0; p < after.size(); ++p)
        for (int i = 0; i < 9; ++i) EXPECT_NEAR(after.deformation_gradient[p][i], both[i], 1e-12);
    }
}

TEST(MovingReference, ForcesAreTheDerivativeOfTheEnergyAfterAMove) {
  for (int dimension : {2, 3})
    for (bool f_bar : {false, true}) {
      const auto uneven = [&](double by) {
        return [=](const Vec3& X) {
          return by *
                 Vec3{std::sin(7 * X[0] + X[1]), std::cos(5 * X[1]), dimension == 3 ? std::sin(3 * X[2] + X[0]) : 0};
        };
      };
      const auto state = [&](double by) {
        Moved moved(dimension, f_bar, linear(stretch(dimension)));
        moved.move();
        moved.carry(uneven(0.03));
        moved.move();
        moved.carry(uneven(0.02 + by));
        return moved;
      };
      const double e = 1e-6;
      const double expected = -(state(e).energy() - state(-e).energy()) / (2 * e);
      Moved now = state(0);
      const std::vector<Vec3> forces = now.forces();
      double got = 0;
      for (std::size_t i = 0; i < forces.size(); ++i) got += dot(forces[i], uneven(1)(now.body.node_positions[i]));
      EXPECT_NEAR(got, expected, 1e-6 * std::abs(expected)) << dimension << "D" << (f_bar ? ", f-bar" : "");
    }
}

TEST(MovingReference, ARigidRotationAsksForNoneAndSurvivesOne) {
  for (int dimension : {2, 3}) {
    Moved state(dimension, false, linear(rotation(0.7)));
    EXPECT_FALSE(is_past_limit(state.model.particles, state.body, 1 + 1e-9, 2));
    state.move();
    double largest = 0;
    for (const Vec3& f : state.forces()) largest = std::max(largest, norm(f));
    EXPECT_LT(largest, 1e-9 * 1e5);
    EXPECT_FALSE(is_past_limit(state.model.particles, state.body, 1 + 1e-9, 2));
  }
}

TEST(MovingReference, TheLimitIsTheRatioOfThePrincipalStretches) {
  for (int dimension : {2, 3}) {
    const double ratio = 2.618033988749895;  // a simple shear of 1: the square of the golden ratio
    Moved state(dimension, false, linear({1, 1, 0, 0, 1, 0, 0, 0, 1}));
    EXPECT_TRUE(is_past_limit(state.model.particles, state.body, ratio - 1e-6, 1));
    EXPECT_FALSE(is_past_limit(state.model.particles, state.body, ratio + 1e-6, 1));
    state.move();
    EXPECT_FALSE(is_past_limit(state.model.particles, state.body, 1 + 1e-9, 1)) << "counts from the last move";
  }
}

TEST(MovingReference, TheWaveSpeedOfAMovedGridBoundsThatOfTheCurrentConfiguration) {
  Moved state(3, false, linear(stretch(3)));
  const Motion motion = make_motion(stretch(3), stretch(3));
  const NeoHookean::Law law(kRubber);
  const Mat3 F = stretch(3);
  EXPECT_EQ(grid_wave_speed_squared(law, motion, {}, nullptr), law.wave_speed_squared(motion, {}));
  EXPECT_NEAR(grid_wave_speed_squared(law, motion, {}, &F), current_wave_speed_squared(law, motion, {}), 1e-6);
}

TEST(MovingReference, AParticleBeyondReachIsLostAndNothingChanges) {
  Moved state(2, false, linear(stretch(2)));
  const std::vector<std::int64_t> ids = state.model.particles.id;
  state.model.particles.position[3][0] = 1e9;
  EXPECT_EQ(move_reference(state.model, state.body), std::optional<std::size_t>(3));
  EXPECT_TRUE(state.body.base.empty());
  EXPECT_EQ(state.model.particles.id, ids);
}

SolverOptions moving(double end_time, Vec3 gravity, double limit, AntiLocking anti_locking = AntiLocking::none) {
  SolverOptions options = test::solver(end_time, gravity);
  options.reference_update = limit;
  options.anti_locking = anti_locking;
  return options;
}

TEST(MovingReference, ConservesMomentumAndClosesTheBalance) {
  const auto swirl = [](const Vec3& X) { return Vec3{6 * std::sin(3 * X[1]) + 0.5, 4 * std::cos(3 * X[0]), 0}; };
  for (int dimension : {2, 3})
    for (AntiLocking anti_locking : {AntiLocking::none, AntiLocking::f_bar})
      for (const Material& law : {Material(kRubber), Material(kSoil)}) {
        Model model = free_block(dimension, law, swirl);
        test::RecordingSink sink;
        const RunReport report =
            run(model, moving(0.2, {0, 0, 0}, 1.4, anti_locking), test::output(0.1, 0.005), sink, 2);
        ASSERT_FALSE(report.failed) << report.failure.what;
        EXPECT_GT(report.forms[0].reference_updates, 1);
        EXPECT_EQ(report.forms[0].obstacle, "its reference configuration moves");
        const double scale = std::sqrt(2 * report.first.kinetic * 1900);
        for (const HistorySample& s : sink.samples) EXPECT_LT(norm(s.momentum - report.first.momentum), 1e-12 * scale);
        EXPECT_LT(report.largest_energy_error, 0.03 * report.first.kinetic);
      }
}

TEST(MovingReference, FollowsAUniformShearThroughManyMoves) {
  const Mat3 step{1, 0.5, 0, 0, 1, 0, 0, 0, 1};
  for (int dimension : {2, 3}) {
    Moved state(dimension, false, linear(step));
    const int moves = 12;
    for (int i = 0; i < moves; ++i) {
      state.move();
      state.carry(linear(step));
    }
    const Mat3 expected{1, 0.5 * (moves + 1), 0, 0, 1, 0, 0, 0, 1};
    const Particles& P = state.model.particles;
    for (std::size_t p = 0; p < P.size(); ++p) {
      for (int i = 0; i < 9; ++i) EXPECT_NEAR(P.deformation_gradient[p][i], expected[i], 1e-12);
      const Vec3 X = P.reference_position[p];
      EXPECT_NEAR(P.position[p][0], X[0] + expected[1] * (X[1] - 1.5), moves * 0.5 * 0.25e-3);
      EXPECT_NEAR(P.position[p][1], X[1], 1e-12);
    }
  }
}

TEST(MovingReference, SameBitsForAnyNumberOfThreads) {
  Particles first;
  for (int threads : {1, 2, 3}) {
    Model model =
        test::empty_model({0, 0, 0}, {3, 2, 0}, 0.2, {Condition::roller, Condition::roller, Condition::fixed});
    test::seed_body(model, "soil", MohrCoulomb{{1900, 1e6, 0.3}, 500, 25, 0}, 2,
                    [](const Vec3& X) { return X[1] < 2 - 0.8 * X[0]; });
    LoadOptions load;
    load.where.box = {{0, 1, 0}, {0.5, 2, 0}};
    load.force = Vec3{500, 0, 0};
    model.loads.push_back(load);
    test::RecordingSink sink;
    const RunReport report = run(model, moving(0.25, {0, -9.81, 0}, 1.05), test::output(0.25, 0.1), sink, threads);
    ASSERT_FALSE(report.failed) << report.failure.what;
    EXPECT_GT(report.forms[0].reference_updates, 1);
    if (threads == 1) first = model.particles;
    EXPECT_EQ(model.particles.position, first.position);
    EXPECT_EQ(model.particles.stress, first.stress);
    EXPECT_EQ(model.particles.deformation_gradient, first.deformation_gradient);
    EXPECT_EQ(model.particles.id, first.id);
  }
}

TEST(MovingReference, AForceGoesOnActingOnItsParticles) {
  const auto shear = [](const Vec3& X) { return Vec3{12 * (X[1] - 1.5), 0, 0}; };
  Model model = free_block(2, kRubber, shear);
  LoadOptions load;
  load.where.box = {{1, 1.75, 0}, {1.25, 2, 0}};
  load.force = Vec3{30, 10, 0};
  model.loads.push_back(load);
  test::RecordingSink sink;
  const RunReport report = run(model, moving(0.2, {0, 0, 0}, 1.2), test::output(0.2, 0.01), sink, 1);
  ASSERT_FALSE(report.failed) << report.failure.what;
  EXPECT_GT(report.forms[0].reference_updates, 1);
  const Vec3 gained = report.last.momentum - report.first.momentum;
  EXPECT_NEAR(gained[0], 30 * 0.2, 1e-9);
  EXPECT_NEAR(gained[1], 10 * 0.2, 1e-9);
}

TEST(MovingReference, ALostParticleIsAFailureThatNamesIt) {
  Model model = free_block(2, kRubber, [](const Vec3& X) { return Vec3{8 * (X[1] - 1.5), 0, 0}; });
  model.particles.position[5][0] = 1e9;
  const std::int64_t id = model.particles.id[5];
  test::RecordingSink sink;
  const RunReport report = run(model, moving(1, {0, 0, 0}, 1.1), {}, sink, 1);
  ASSERT_TRUE(report.failed);
  EXPECT_EQ(report.failure.what, "a particle has left the grid");
  EXPECT_EQ(report.failure.particle, id);
  EXPECT_GT(report.failure.step, 1);
}

TEST(MovingReference, RefusesWhatCannotMove) {
  test::RecordingSink sink;
  const auto refuses = [&](Model model, const SolverOptions& options, const std::string& what) {
    try {
      run(model, options, {}, sink, 1);
      FAIL() << what;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  const Model model = free_block(2, kRubber);
  const SolverOptions options = moving(1, {0, 0, 0}, 2.6);
  refuses(model, moving(1, {0, 0, 0}, 1), "above 1");
  SolverOptions fast = options;
  fast.courant = 0.6;
  refuses(model, fast, "at most 0.5");
  Model updated = model;
  updated.bodies[0].formulation = Formulation::updated_lagrangian;
  refuses(updated, options, "no body is total-Lagrangian");
  Model absorbing = model;
  absorbing.domain.faces[2] = FaceCondition::absorbing;
  refuses(absorbing, options, "absorbing face");
  Model driven = model;
  driven.loads.emplace_back().name = "pull";
  driven.loads[0].velocity = Vec3{1, 0, 0};
  driven.loads[0].where.face = FaceName::x_min;
  refuses(driven, options, "'pull'");
}

}  // namespace
}  // namespace scarp

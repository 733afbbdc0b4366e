// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run says of its state beside energies: angular momentum, centre of mass, what sets the time step.
#include <gtest/gtest.h>

#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

using test::output;
using test::RecordingSink;
using test::solver;

TEST(AngularMomentum, IsThatOfASpinningAndFallingBlock) {
  const Vec3 spin{1, -2, 3}, drift{4, 5, 6};
  Model model = test::empty_model({0, 0, 0}, {2, 1, 1}, 0.25);
  const Vec3 centre{1, 0.5, 0.5};
  test::seed_body(model, "block", NeoHookean{{1000, 1e8, 0.3}}, 2, test::everywhere,
                  [&](const Vec3& X) { return drift + cross(spin, X - centre); });
  const Particles& P = model.particles;
  Vec3 expected{0, 0, 0};
  for (std::size_t p = 0; p < P.size(); ++p) {
    const Vec3 r = P.reference_position[p] - centre;
    expected = expected + P.mass[p] * (dot(r, r) * spin - dot(r, spin) * r);  // I omega
  }
  RecordingSink sink;
  const RunReport report = run(model, solver(0.01, {0, -10, 0}), output(0.01, 0.001), sink, 1);
  ASSERT_FALSE(report.failed);
  EXPECT_LT(norm(report.reference_centre - centre), 1e-12);
  EXPECT_LT(norm(report.first.angular_momentum - expected), 1e-12 * norm(expected));
  EXPECT_LT(norm(report.first.centre - centre), 1e-12);
  // A body in flight turns about its own centre as before, which moves: L = r_c x M v_c + I omega.
  const HistorySample& last = report.last;
  const Vec3 own = last.angular_momentum - cross(last.centre - centre, last.momentum);
  EXPECT_LT(norm(own - expected), 0.02 * norm(expected)) << "lumped maps lose an O(h^2) share of the spin";
  EXPECT_LT(norm(last.centre - centre - 0.01 * drift + 0.5 * 1e-4 * Vec3{0, 10, 0}), 2e-5)
      << "symplectic Euler: g dt t / 2";
}

TEST(StepLimit, NamesTheStiffestParticle) {
  for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    Model model = test::empty_model({0, 0, 0}, {2, 1, 0}, 0.25);
    test::seed_body(model, "soft", NeoHookean{{1000, 1e6, 0.3}}, 2, [](const Vec3& X) { return X[0] < 1; });
    test::seed_body(model, "stiff", NeoHookean{{1000, 1e8, 0.3}}, 2, [](const Vec3& X) { return X[0] > 1; });
    for (Body& body : model.bodies) body.formulation = formulation;
    // One particle of the stiff body is squeezed, and so stiffer than the others.
    const std::size_t squeezed = test::nearest(model.particles, {1.6, 0.6, 0});
    const std::int64_t id = model.particles.id[squeezed];
    model.particles.deformation_gradient[squeezed] = {0.8, 0, 0, 0, 0.8, 0, 0, 0, 1};
    RecordingSink sink;
    const RunReport report = run(model, solver(1e-5, {0, 0, 0}), output(1e-5, 1e-5), sink, 1);
    ASSERT_FALSE(report.failed);
    const StepLimit& limit = report.step_limit;
    EXPECT_EQ(limit.body, 1);
    EXPECT_EQ(limit.material, 1);
    EXPECT_GE(limit.wave_speed, 367) << "sqrt((lambda + 2 mu) / rho)";
    const double h = 0.25, courant = SolverOptions{}.courant;
    EXPECT_NEAR(limit.time_step, courant * h / (limit.wave_speed + limit.particle_speed), 1e-12);
    if (formulation == Formulation::total_lagrangian) {
      EXPECT_EQ(limit.particle, id);
    }
    EXPECT_LT(norm(limit.position - Vec3{1.6, 0.6, 0}), 0.1);
  }
}

TEST(StepLimit, NamesTheFastestParticleWhereItOutrunsTheWaves) {
  Model model = test::empty_model({0, 0, 0}, {4, 1, 0}, 0.25);
  test::seed_body(
      model, "fast", NeoHookean{{1000, 1e4, 0.3}}, 2, [](const Vec3& X) { return X[0] < 1; },
      [](const Vec3& X) {
        return Vec3{X[1] > 0.9 ? 30.0 : 10.0, 0, 0};
      });
  for (Body& body : model.bodies) body.formulation = Formulation::updated_lagrangian;
  RecordingSink sink;
  const RunReport report = run(model, solver(1e-6, {0, 0, 0}), output(1e-6, 1e-6), sink, 1);
  ASSERT_FALSE(report.failed);
  EXPECT_NEAR(report.step_limit.particle_speed, 30, 1e-9);
  EXPECT_GT(report.step_limit.position[1], 0.9);
}

/// A column squeezed at a steady speed: its cells become thinner and stiffer without end.
TEST(StepLimit, IsNamedWhereTheTimeStepCollapses) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, 0}, 0.5, {Condition::roller, Condition::roller, Condition::fixed});
  test::seed_body(model, "column", NeoHookean{{1000, 1e6, 0.3}}, 2, test::everywhere);
  LoadOptions press;
  press.name = "press";
  press.where.box = {{0, 1, 0}, {1, 1, 0}};
  press.velocity = Vec3{0, -5, 0};
  model.loads = {press};
  RecordingSink sink;
  const RunReport report = run(model, solver(1, {0, 0, 0}), output(0.1, 0.1), sink, 1);
  ASSERT_TRUE(report.failed);
  EXPECT_NE(report.failure.what.find("the time step has collapsed"), std::string::npos) << report.failure.what;
  EXPECT_NE(report.failure.what.find("body 'column', material 'column', wave speed"), std::string::npos)
      << report.failure.what;
  EXPECT_GE(report.failure.particle, 0);
  EXPECT_GT(report.failure.time, 0);
  EXPECT_LT(report.step_limit.time_step, 1e-5 * report.largest_dt);
}

}  // namespace
}  // namespace scarp

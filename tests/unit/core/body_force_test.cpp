// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "solver/core/run.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

using test::output;
using test::RecordingSink;
using test::solver;

Model block(int dimension) {
  Model model = test::empty_model({0, 0, 0}, {1, 2, dimension == 3 ? 1.0 : 0.0}, 0.25,
                                  {Condition::free, Condition::free, Condition::fixed});
  test::seed_body(model, "block", NeoHookean{{1000, 1e6, 0.3}}, 2, test::everywhere);
  return model;
}

TEST(BodyForce, ThatIsUniformIsGravity) {
  for (int dimension : {2, 3}) {
    const Vec3 g{1, -10, 0};
    Model heavy = block(dimension), pushed = block(dimension);
    pushed.body_force = [&](const Vec3&, double) { return g; };
    RecordingSink a, b;
    const RunReport by_gravity = run(heavy, solver(0.1, g, 0.1), output(0.1, 0.01), a, 1);
    const RunReport by_force = run(pushed, solver(0.1, {0, 0, 0}, 0.1), output(0.1, 0.01), b, 1);
    ASSERT_FALSE(by_gravity.failed || by_force.failed);
    for (std::size_t p = 0; p < heavy.particles.size(); ++p)
      EXPECT_LT(norm(heavy.particles.position[p] - pushed.particles.position[p]), 1e-13);
    EXPECT_GT(by_force.last.external, 1);
    EXPECT_NEAR(by_force.last.external, -by_gravity.last.potential, 5e-3 * by_force.last.external)
        << "O(dt): the mean velocity of a step against the one that moves the particles";
    EXPECT_LT(by_force.largest_energy_error, 0.01 * by_force.largest_energy);
  }
}

TEST(BodyForce, MayVaryInPlaceAndTime) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, 0}, 0.25);
  test::seed_body(model, "block", NeoHookean{{1000, 1e6, 0.3}}, 2, test::everywhere);
  // Its sum over the block is m (3 t, 0): the part that varies in place turns and strains.
  model.body_force = [](const Vec3& X, double t) { return Vec3{3 * t + (X[1] - 0.5), X[0] - 0.5, 0}; };
  RecordingSink sink;
  const RunReport report = run(model, solver(0.1, {0, 0, 0}), output(0.1, 0.01), sink, 1);
  ASSERT_FALSE(report.failed);
  // Forces are those at the start of each step: 3 sum t dt, less than the integral by 3 t dt / 2.
  EXPECT_NEAR(report.last.momentum[0], 1000 * 3 * 0.01 / 2, 1000 * 3 * 0.1 * report.largest_dt / 2);
  EXPECT_LT(report.last.momentum[0], 15);
  EXPECT_NEAR(report.last.momentum[1], 0, 1e-12);
  EXPECT_GT(report.last.strain, 0);
}

TEST(BodyForce, IsRefusedOnUpdatedLagrangianBodies) {
  Model model = block(2);
  model.bodies[0].formulation = Formulation::updated_lagrangian;
  model.body_force = [](const Vec3&, double) { return Vec3{0, 0, 0}; };
  RecordingSink sink;
  EXPECT_THROW(run(model, solver(0.1, {0, 0, 0}), output(0.1, 0.1), sink, 1), Error);
}

}  // namespace
}  // namespace scarp

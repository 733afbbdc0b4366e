// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the solver's speed is compared with computes the same thing.
#include "tests/bench/textbook.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/core/formulations.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

TEST(Textbook, ComputesWhatTheSolverDoes) {
  const NeoHookean rubber{{1000, 1e6, 0.3}};
  constexpr int n = 4, margin = 2;
  for (int dimension : {2, 3})
    for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
      const double end = n + 2 * margin, flat = dimension == 2 ? 0 : 1;
      textbook::Block block(dimension, n, margin, 1000, rubber.shear_modulus(), rubber.lambda());
      Model model = test::empty_model({0, 0, 0}, {end, end, flat * end}, 1, {});
      test::seed_body(model, "block", rubber, 2, [&](const Vec3& X) {
        bool inside = true;
        for (int a = 0; a < dimension; ++a) inside = inside && X[a] > margin && X[a] < margin + n;
        return inside;
      });
      model.bodies[0].formulation = formulation;
      for (std::size_t p = 0; p < block.particles.size(); ++p) {
        ASSERT_EQ(model.particles.reference_position[p][1], block.particles[p].X[1]);
        block.particles[p].v[0] = model.particles.velocity[p][0] = std::sin(block.particles[p].X[1]);
      }
      const std::vector<std::int64_t> ids = model.particles.id;
      Formulations method(model, test::solver(1, {0, -9.81, 0}), 1);
      const double gravity[3] = {0, -9.81, 0};
      for (int step = 0; step < 20; ++step) {
        method.step(2e-3);
        formulation == Formulation::total_lagrangian ? block.step_total(2e-3, gravity)
                                                     : block.step_updated(2e-3, gravity);
      }
      method.write_particles();
      double worst = 0, moved = 0;
      for (std::size_t p = 0; p < model.particles.size(); ++p) {
        const textbook::Particle& other = block.particles[static_cast<std::size_t>(model.particles.id[p])];
        for (int a = 0; a < 3; ++a) worst = std::max(worst, std::abs(model.particles.position[p][a] - other.x[a]));
        moved = std::max(moved, norm(model.particles.position[p] - model.particles.reference_position[p]));
      }
      EXPECT_GT(moved, 1e-3);
      EXPECT_LT(worst, 1e-12);
    }
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cantilevers at rest under a dead force at their tip against the elastica (Bisshopp and Drucker 1945), which knows
// neither shear nor stretch: at 12 times as long as deep they are worth half a percent.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using test::output;
using test::RecordingSink;
using test::solver;
using test::validate_near;
using test::validate_within;

struct Tip {
  double deflection = 0, shortening = 0;  ///< over the length
};

/// A beam of 6 x 0.5 m with n cells across; alpha = F L^2 / (E I), with L to the particles that carry F.
Tip tip_of_beam(int n, double alpha) {
  const double length = 6, depth = 0.5, h = depth / n, E = 12e6;
  const double arm = length - h / 4;
  Model model = test::empty_model({0, -5, 0}, {6.5, 1, 0}, h,
                                  {Condition::fixed, Condition::free, Condition::free, Condition::free});
  test::seed_body(model, "beam", NeoHookean{{1000, E, 0}}, 2,
                  [&](const Vec3& X) { return X[0] < length && X[1] > 0 && X[1] < depth; });
  LoadOptions load;
  load.name = "tip";
  load.where.box = {{length - h / 2, 0, 0}, {length, depth, 0}};
  load.force = Vec3{0, -alpha * E * std::pow(depth, 3) / 12 / (arm * arm), 0};
  load.table = {{0, 0}, {3, 1}};
  model.loads = {load};
  SolverOptions options = solver(40, {0, 0, 0}, 0.8);  // the first period is 4 s
  options.damping = 0.3;
  RecordingSink sink;
  const RunReport report = run(model, options, output(40, 1), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  EXPECT_LT(report.last.kinetic, 1e-7 * report.last.strain) << "not at rest";
  Vec3 sum{0, 0, 0};
  double count = 0;
  const Particles& P = model.particles;
  for (std::size_t p = 0; p < P.size(); ++p) {
    if (P.reference_position[p][0] < length - h / 2) continue;
    sum = sum + (P.position[p] - P.reference_position[p]);
    ++count;
  }
  return {-sum[1] / count / arm, -sum[0] / count / arm};
}

TEST(Elastica, TipForceBendsABeamAsFarAsItsElastica) {
  const double w = 0.49345748, u = 0.16064172;  // alpha = 2
  const Tip two = tip_of_beam(2, 2), four = tip_of_beam(4, 2), eight = tip_of_beam(8, 2);
  const std::string name = "elastica: tip force F L^2 / (E I) = 2, ";
  validate_near(name + "2 cells across: deflection / L", w, two.deflection, 0.035 * w,
                "3.5 %: bending of a linear cell");
  validate_near(name + "4 cells across: deflection / L", w, four.deflection, 0.01 * w, "1 %");
  validate_near(name + "4 cells across: shortening / L", u, four.shortening, 0.02 * u, "it goes with the square of w");
  validate_near(name + "8 cells across: deflection / L", w, eight.deflection, 0.005 * w,
                "what shear and stretch are worth");
  const double order = std::log2(std::abs((two.deflection - four.deflection) / (four.deflection - eight.deflection)));
  validate_within(name + "order of the deflection in the cell", 1.85, 2.2, order,
                  "differences of 2 to 4 and 4 to 8 cells: O(h^2) against the method's own limit");
}

TEST(Elastica, AFarLargerForceToo) {
  const Tip four = tip_of_beam(4, 4);
  validate_near("elastica: tip force F L^2 / (E I) = 4, 4 cells across: deflection / L", 0.66996418, four.deflection,
                0.01 * 0.66996418, "1 %");
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A soft bar drawn out at a uniform rate, against the stress of its stretch: how far each formulation carries a solid
// that is stretched. Weights in the current configuration lose it once its points stand more than a cell apart
// (numerical fracture), for which particle domains that stretch (CPDI2: Sadeghirad, Brannon, Guilkey 2013) were made;
// weights in the reference configuration do not.
#include <gtest/gtest.h>

#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using test::validate_near;
using test::validate_within;

constexpr double kCell = 0.25;

/// RMS error of the axial stress over the stress, of points that the wave from the bar's free end has not reached.
struct Drawn {
  double at_2 = NAN, at_4 = NAN;  ///< stretches
};

/// v = X: the stretch at time t is 1 + t.
Drawn drawn(Formulation formulation, ShapeFunction shape) {
  const NeoHookean rubber{{1000, 100, 0.3}};
  Model model = test::empty_model({0, 0, 0}, {20, 1, 0}, kCell,
                                  {Condition::roller, Condition::free, Condition::roller, Condition::roller});
  test::seed_body(
      model, "bar", rubber, 2, [](const Vec3& X) { return X[0] < 4; },
      [](const Vec3& X) {
        return Vec3{X[0], 0, 0};
      });
  model.bodies[0].formulation = formulation;
  const SolverOptions options = test::solver(3, {0, 0, 0}, 0.4, shape);
  Drawn result;
  test::RecordingSink sink;
  sink.on_frame = [&](const Model& now, double time) {
    const double stretch = 1 + time, mu = rubber.shear_modulus(), lambda = rubber.lambda();
    const double exact = (mu * (stretch * stretch - 1) + lambda * std::log(stretch)) / stretch;
    double square = 0, count = 0;
    for (std::size_t p = 0; p < now.particles.size(); ++p) {
      const double X = now.particles.reference_position[p][0];
      if (X < kCell || X > 1.5) continue;
      square += std::pow(now.particles.stress[p][0] / exact - 1, 2);
      ++count;
    }
    if (time == 1) result.at_2 = std::sqrt(square / count);
    if (time == 3) result.at_4 = std::sqrt(square / count);
  };
  EXPECT_FALSE(run(model, options, test::output(1, 1), sink, 1).failed);
  return result;
}

TEST(DrawnBar, OnlyTheReferenceConfigurationCarriesALargeStretch) {
  const Drawn total = drawn(Formulation::total_lagrangian, ShapeFunction::linear);
  const Drawn gimp = drawn(Formulation::updated_lagrangian, ShapeFunction::gimp);
  const Drawn bspline = drawn(Formulation::updated_lagrangian, ShapeFunction::quadratic_bspline);
  const std::string name = "drawn bar, error of the stress / stress: ";
  validate_near(name + "total-Lagrangian, stretch of 4", 0, total.at_4, 1e-6, "weights never change");
  validate_near(name + "GIMP, stretch of 2", 0, gimp.at_2, 0.02, "points a cell apart: supports still overlap");
  validate_near(name + "quadratic B-spline, stretch of 2", 0, bspline.at_2, 0.02, "the same");
  const std::string torn = "points two cells apart: the bar is torn, as a grid that stands still has it";
  validate_within(name + "GIMP, stretch of 4", 0.1, 1, gimp.at_4, torn);
  validate_within(name + "quadratic B-spline, stretch of 4", 0.1, 1, bspline.at_4, torn);
}

}  // namespace
}  // namespace scarp

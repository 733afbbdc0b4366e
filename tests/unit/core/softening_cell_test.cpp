// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A material that softens over a length is prepared for the cells of each body that it is in.
#include <gtest/gtest.h>

#include "solver/core/total_body.hpp"
#include "tests/support/lattice_seed.hpp"

namespace scarp {
namespace {

TEST(SofteningCell, EachBodysLawsKnowItsCell) {
  MohrCoulomb clay{{1900, 1e9, 0.3}, 20e3, 0, 0};
  clay.residual_cohesion = 5e3;
  clay.softening_strain = 0.01;
  clay.softening_length = 0.5;
  for (double cell : {0.25, 0.5, 2.0}) {
    Model model = test::empty_model({0, 0, 0}, {4, 4, 0}, cell);
    test::seed_body(model, "clay", clay, 2, test::everywhere);
    sort_by_cell(model);
    const TotalBody body = make_total_body(model, model.bodies[0]);
    ASSERT_EQ(body.laws.size(), 1u);
    // f of a stress-free point is - 2 c: the cohesion that is left after half the softening strain of a 0.5 m cell.
    const double left =
        -0.5 * std::get<MohrCoulomb::Law>(body.laws[0]).yield_function({}, {.equivalent_plastic_strain = 0.005});
    EXPECT_NEAR(left, 20e3 - 15e3 * std::min(1.0, 0.5 * cell / 0.5), 1e-6) << cell;
  }
}

}  // namespace
}  // namespace scarp

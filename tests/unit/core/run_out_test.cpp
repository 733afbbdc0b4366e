// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/run_out.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/lattice_seed.hpp"

namespace scarp {
namespace {

const Vec3 kDown3{0, 0, -9.81}, kDown2{0, -9.81, 0};

/// A 20 x 20 x 10 m block, cells of 1 m, whose part with X < 10, Y < 10 and Z > 6 slides by `shift`.
Model slid(const Vec3& shift) {
  Model model = test::empty_model({0, 0, 0}, {40, 20, 10}, 1);
  test::seed_body(model, "ground", NeoHookean{{2000, 1e7, 0.3}}, 2, [](const Vec3& X) { return X[0] < 20; });
  Particles& P = model.particles;
  for (std::size_t p = 0; p < P.size(); ++p) {
    const Vec3& X = P.reference_position[p];
    if (X[0] < 10 && X[1] < 10 && X[2] > 6) P.position[p] = X + shift;
  }
  return model;
}

TEST(RunOut, OfABlockThatSlides) {
  const Model model = slid({25, 0, -6});
  const RunOut r = measure_run_out(states_of(model.particles), model.domain, kDown3, {});
  EXPECT_EQ(r.threshold, 1) << "a cell";
  EXPECT_NEAR(r.moved_volume, 400, 1e-9);
  EXPECT_NEAR(r.moved_share, 0.1, 1e-12);
  EXPECT_LT(norm(r.centre_before - Vec3{5, 5, 8}), 1e-9);
  EXPECT_LT(norm(r.centre_after - Vec3{30, 5, 2}), 1e-9);
  EXPECT_LT(norm(r.direction - Vec3{1, 0, 0}), 1e-12);
  EXPECT_NEAR(*r.run_out.value, 25, 1e-9);
  EXPECT_NEAR(*r.crest_drop.value, 6, 1e-9);
  EXPECT_NEAR(*r.crest_retreat.value, 9.5, 1e-9) << "centres from 0.25 to 9.75";
  EXPECT_NEAR(*r.deposit_length.value, 9.5, 1e-9);
  EXPECT_NEAR(*r.deposit_width.value, 9.5, 1e-9);
  EXPECT_NEAR(r.deposit_thickness_largest, 4, 1e-9);
  EXPECT_NEAR(r.deposit_thickness_mean, 4, 1e-9);
  EXPECT_NEAR(r.footprint_before, 100, 1e-9);
  EXPECT_NEAR(r.footprint_after, 100, 1e-9);
  EXPECT_EQ(r.footprint_overlap, 0);
  EXPECT_NEAR(*r.travel_angle.value, std::atan2(9.5, 34.5) * 180 / std::numbers::pi, 1e-9)
      << "from the rear of the top, (0.25, 9.75), to the foot of the front, (34.75, 0.25)";
}

TEST(RunOut, FootprintsOverlapWhereAShortSlideLeavesThem) {
  const Model model = slid({4, 0, -1});
  const RunOut r = measure_run_out(states_of(model.particles), model.domain, kDown3, {});
  EXPECT_NEAR(r.footprint_overlap, 60, 1e-9);
  EXPECT_NEAR(*r.run_out.value, 4, 1e-9);
}

TEST(RunOut, IsMeasuredAlongADirectionWhereAsked) {
  const Model model = slid({6, 8, -6});
  EXPECT_NEAR(*measure_run_out(states_of(model.particles), model.domain, kDown3, {{}, Vec3{1, 0, -5}}).run_out.value, 6,
              1e-9);
  const RunOut own = measure_run_out(states_of(model.particles), model.domain, kDown3, {});
  EXPECT_LT(norm(own.direction - Vec3{0.6, 0.8, 0}), 1e-12);
  EXPECT_NEAR(*own.run_out.value, 10, 1e-9);
}

TEST(RunOut, OfATriangularWedgeInPlaneStrain) {
  // A slope of 45 degrees from (10, 10) down to (20, 0) slides by (3, -2).
  Model model = test::empty_model({0, 0, 0}, {40, 10, 0}, 1);
  test::seed_body(model, "slope", NeoHookean{{2000, 1e7, 0.3}}, 2, [](const Vec3& X) { return X[0] + X[1] < 20; });
  Particles& P = model.particles;
  for (std::size_t p = 0; p < P.size(); ++p)
    if (P.reference_position[p][0] > 8) P.position[p] = P.reference_position[p] + Vec3{3, -2, 0};
  const RunOut r = measure_run_out(states_of(P), model.domain, kDown2, {0.5, {}});
  EXPECT_NEAR(r.moved_volume, 20 + 50, 3) << "per metre; the staircase of the lattice";
  EXPECT_NEAR(*r.run_out.value, 3, 1e-9);
  EXPECT_NEAR(*r.crest_drop.value, 2, 1e-9);
  EXPECT_NEAR(*r.crest_retreat.value, 2, 0.51) << "from the crest at 10 back to 8";
  EXPECT_NEAR(*r.travel_angle.value, std::atan2(12, 15) * 180 / std::numbers::pi, 1.5) << "(8, 10) to (23, -2)";
  EXPECT_NEAR(r.footprint_before, 12, 1e-9);
  EXPECT_NEAR(r.footprint_overlap, 9, 1e-9);
  EXPECT_NEAR(r.deposit_thickness_largest, 10, 0.6);
  EXPECT_FALSE(r.deposit_width.value);
  EXPECT_EQ(r.deposit_width.why_not, "plane strain");
}

TEST(RunOut, SaysWhyThereIsNone) {
  const RunOut still = measure_run_out(states_of(slid({0.5, 0, 0}).particles), slid({0, 0, 0}).domain, kDown3, {});
  EXPECT_FALSE(still.why_nothing.empty());
  EXPECT_FALSE(still.run_out.value);
  EXPECT_EQ(still.run_out.why_not, "nothing moved by 1 m");
  const Model sunk = slid({0, 0, -3});
  const RunOut settled = measure_run_out(states_of(sunk.particles), sunk.domain, kDown3, {});
  EXPECT_NEAR(settled.moved_volume, 400, 1e-9);
  EXPECT_FALSE(settled.run_out.value);
  EXPECT_EQ(settled.crest_drop.why_not, "the moved mass has no mean horizontal motion");
  const Model model = slid({5, 0, 0});
  for (const Vec3& gravity : {Vec3{0, 0, 0}, Vec3{5, 0, -8}}) {
    const RunOut r = measure_run_out(states_of(model.particles), model.domain, gravity, {});
    EXPECT_NEAR(*r.run_out.value, 5, 1e-9);
    EXPECT_EQ(r.travel_angle.why_not, "gravity is not vertical");
  }
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/materials/elastic_state.hpp"

#include <gtest/gtest.h>

#include "solver/materials/law.hpp"
#include "tests/support/law_samples.hpp"

namespace scarp {
namespace {

TEST(ElasticState, SolidsBearTheStressThatWasAskedFor) {
  int found = 0;
  const auto hold = [&](const auto& samples) {
    for (const auto& m : samples) {
      const PreparedLaw law = prepare(Material(m));
      for (const Vec3& stress : {Vec3{0, 0, 0}, Vec3{-6e3, -1e4, -6e3}, Vec3{-1e5, -1.2e5, -1.1e5}}) {
        const auto state = elastic_state(law, stress);
        if (!state) continue;
        ++found;
        PointHistory history = state->history;
        const Sym6 s =
            std::visit([&](const auto& l) { return l.stress(make_motion(state->F, state->F), history); }, law);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(s[i], stress[i], 1e-9 * (1 + std::abs(stress[1]))) << m.name;
        for (int i = 3; i < 6; ++i) EXPECT_EQ(s[i], 0) << m.name;
        EXPECT_EQ(history.equivalent_plastic_strain, 0) << m.name;
      }
    }
  };
  hold(test::law_samples<LinearElastic>());
  hold(test::law_samples<NeoHookean>());
  hold(test::law_samples<Hencky>());
  EXPECT_EQ(found, 3 * static_cast<int>(test::law_samples<LinearElastic>().size() +
                                        test::law_samples<NeoHookean>().size() + test::law_samples<Hencky>().size()));
  hold(test::law_samples<VonMises>());
  hold(test::law_samples<MohrCoulomb>());
  hold(test::law_samples<DruckerPrager>());
}

TEST(ElasticState, WhatALawCannotBearIsNotGiven) {
  const MohrCoulomb sand{{1900, 20e6, 0.3}, 0, 30, 0};  // Ka = 1/3, Kp = 3
  const PreparedLaw law = prepare(Material(sand));
  EXPECT_TRUE(elastic_state(law, {-0.5e5, -1e5, -0.5e5}).has_value());
  EXPECT_TRUE(elastic_state(law, {-0.34e5, -1e5, -0.34e5}).has_value());
  EXPECT_FALSE(elastic_state(law, {-0.3e5, -1e5, -0.3e5}).has_value());
  EXPECT_FALSE(elastic_state(law, {-3.1e5, -1e5, -3.1e5}).has_value());
  EXPECT_FALSE(elastic_state(law, {1e3, 1e3, 1e3}).has_value());
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/probe.hpp"

#include <gtest/gtest.h>

#include <map>

#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"

namespace scarp {
namespace {

/// A 2 x 4 m block (3D: x 1 m) under its own weight, 1000 kg/m3 and 10 m/s2, stretched to F = diag(1.1, 1, 1) and
/// moved by (10, 0, 0); stress sigma_yy = -10^4 (4 - y).
Model weighty(int dimension) {
  Model model = test::empty_model({0, 0, 0}, {2, 4, dimension == 3 ? 1.0 : 0.0}, 0.5);
  test::seed_body(model, "block", NeoHookean{{1000, 1e6, 0.3}}, 2, test::everywhere);
  model.site.origin = {1000, 0, 0};
  Particles& P = model.particles;
  for (std::size_t p = 0; p < P.size(); ++p) {
    const Vec3& X = P.reference_position[p];
    P.position[p] = {1.1 * X[0] + 10, X[1], X[2]};
    P.velocity[p] = {X[1], 2, 0};
    P.deformation_gradient[p] = {1.1, 0, 0, 0, 1, 0, 0, 0, 1};
    P.stress[p] = {0, -1e4 * (4 - X[1]), 0, 0, 0, 0};
    P.equivalent_plastic_strain[p] = X[1] > 3 ? 0.5 : 0;
  }
  return model;
}

/// The rows that a probe gives, by column.
std::vector<std::map<std::string, double>> look(const Model& model, ProbeShape shape) {
  Probe probe({"probe", std::move(shape), {}}, model);
  std::vector<double> values;
  probe.measure(model, 7, values);
  const auto& columns = probe.columns();
  EXPECT_EQ(values.size() % columns.size(), 0u);
  std::vector<std::map<std::string, double>> rows(values.size() / columns.size());
  for (std::size_t i = 0; i < values.size(); ++i) rows[i / columns.size()][columns[i % columns.size()]] = values[i];
  return rows;
}

TEST(Probe, APointIsTheNearestMaterialPoint) {
  Model model = weighty(2);
  const auto row = look(model, PointProbe{{0.2, 3.0, 0}}).at(0);
  EXPECT_EQ(row.at("time_s"), 7);
  EXPECT_DOUBLE_EQ(row.at("position_x_m"), 1000 + 10 + 1.1 * 0.125) << "of two equally near ones the lower id";
  EXPECT_DOUBLE_EQ(row.at("position_y_m"), 2.875);
  EXPECT_NEAR(row.at("displacement_x_m"), 10 + 0.0125, 1e-12);
  EXPECT_DOUBLE_EQ(row.at("velocity_x_m_s"), 2.875);
  EXPECT_DOUBLE_EQ(row.at("stress_yy_Pa"), -11250);
  EXPECT_NEAR(row.at("strain_xx"), std::log(1.1), 1e-12);
  EXPECT_NEAR(row.at("strain_yy"), 0, 1e-12);
}

TEST(Probe, APointIsFollowedThroughASort) {
  Model model = weighty(2);
  Probe probe({"probe", PointProbe{{0.2, 3.0, 0}}, {}}, model);
  std::vector<double> before, after;
  probe.measure(model, 0, before);
  std::vector<std::size_t> order(model.particles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = order.size() - 1 - i;
  permute_particles(model.particles, order);
  probe.measure(model, 0, after);
  EXPECT_EQ(before, after);
}

TEST(Probe, ASectionCarriesTheWeightAboveIt) {
  for (int dimension : {2, 3}) {
    const Model model = weighty(dimension);
    for (double y : {1.0, 1.6, 2.25}) {
      const auto row = look(model, PlaneProbe{{{10, y, 0}, {0, 3, 0}}, {}}).at(0);
      EXPECT_NEAR(row.at("area_m2"), 2.2, 1e-12);
      EXPECT_NEAR(row.at("normal_force_N"), -2.2e4 * (4 - y), 1e-6) << "linear stress: exact at any height";
      EXPECT_NEAR(row.at("force_y_N"), row.at("normal_force_N"), 1e-9);
      EXPECT_NEAR(row.at("moment_z_N_m"), 1.1 * row.at("force_y_N"), 1e-6) << "acts in the middle, 1.1 m away";
    }
    const auto half = look(model, PlaneProbe{{{0, 2, 0}, {0, 1, 0}}, BoxShape{{10, 0, 0}, {11.1, 4, 1}}}).at(0);
    EXPECT_NEAR(half.at("area_m2"), 1.1, 1e-12);
  }
}

TEST(Probe, ALineIsAProfile) {
  const Model model = weighty(2);
  const auto rows = look(model, LineProbe{{{11, 0, 0}, {11, 8, 0}, 0.3, 8}, ProbePlace::current});
  ASSERT_EQ(rows.size(), 8u);
  for (std::size_t b = 0; b < 4; ++b) {
    const double y = static_cast<double>(b) + 0.5;
    EXPECT_DOUBLE_EQ(rows[b].at("distance_m"), y);
    EXPECT_EQ(rows[b].at("particles"), 8) << "4 rows of 2 columns";
    EXPECT_NEAR(rows[b].at("stress_yy_Pa"), -1e4 * (4 - y), 1e-8);
    EXPECT_NEAR(rows[b].at("velocity_x_m_s"), y, 1e-12);
    EXPECT_EQ(rows[b].at("equivalent_plastic_strain"), b == 3 ? 0.5 : 0);
  }
  EXPECT_EQ(rows[6].at("particles"), 0);
  EXPECT_TRUE(std::isnan(rows[6].at("stress_yy_Pa"))) << "nothing is there";
}

TEST(Probe, ARegionIsNowOrInTheReferenceConfiguration) {
  for (int dimension : {2, 3}) {
    const Model model = weighty(dimension);
    const BoxShape upper{{0, 2, 0}, {2, 4, 1}};
    EXPECT_EQ(look(model, BoxProbe{upper, ProbePlace::current}).at(0).at("particles"), 0) << "it has moved away";
    const auto row = look(model, BoxProbe{upper, ProbePlace::reference}).at(0);
    EXPECT_NEAR(row.at("mass_kg"), 4000, 1e-9);
    EXPECT_NEAR(row.at("volume_m3"), 4.4, 1e-12);
    EXPECT_NEAR(row.at("centre_x_m"), 1000 + 11.1, 1e-9);
    EXPECT_NEAR(row.at("centre_y_m"), 3, 1e-12);
    EXPECT_NEAR(row.at("stress_yy_Pa"), -1e4, 1e-8);
    EXPECT_NEAR(row.at("least_mean_stress_Pa"), -18750.0 / 3, 1e-8);
    EXPECT_NEAR(row.at("largest_mean_stress_Pa"), -1250.0 / 3, 1e-8);
    EXPECT_NEAR(row.at("largest_von_mises_stress_Pa"), 18750, 1e-8);
    EXPECT_NEAR(row.at("largest_displacement_m"), 10 + 0.1 * 1.875, 1e-12);
    EXPECT_NEAR(row.at("largest_speed_m_s"), std::hypot(3.875, 2), 1e-12);
    EXPECT_NEAR(row.at("equivalent_plastic_strain"), 0.25, 1e-12);
    EXPECT_EQ(row.at("largest_equivalent_plastic_strain"), 0.5);
  }
}

TEST(Probe, WhatIsNoShapeIsRefused) {
  const Model model = weighty(2);
  EXPECT_THROW(look(model, PlaneProbe{{{0, 2, 0}, {0, 0, 0}}, {}}), Error);
  EXPECT_THROW(look(model, LineProbe{{{1, 1, 0}, {1, 1, 0}, {}, 3}, ProbePlace::current}), Error);
  EXPECT_THROW(look(model, BoxProbe{{{1, 1, 0}, {1, 2, 0}}, ProbePlace::current}), Error);
}

}  // namespace
}  // namespace scarp

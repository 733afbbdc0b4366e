// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "solver/core/k0_state.hpp"
#include "solver/core/make_frame.hpp"
#include "solver/core/pore_water.hpp"
#include "solver/core/run.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"

namespace scarp {
namespace {

MohrCoulomb clay() {
  MohrCoulomb law{{1800, 20e6, 0.3}, 10e3, 25, 0};
  law.saturated_density = 2000;
  return law;
}

Model two_layers(int dimension) {
  const bool plane = dimension == 2;
  Model model = test::empty_model({0, 0, 0}, {4, plane ? 4.0 : 1, plane ? 0.0 : 4}, 0.5);
  const int up = dimension - 1;
  // A slope of steps of a particle's width, in two materials.
  test::seed_body(model, "rock", Hencky{{2600, 1e9, 0.25}}, 2, [=](const Vec3& X) { return X[up] < 1; });
  test::seed_body(model, "clay", clay(), 2, [=](const Vec3& X) { return X[up] > 1 && X[up] < 1 + 0.5 * X[0]; });
  return model;
}

TEST(Overburden, IsTheWeightAboveInAnyTerrain) {
  for (int dimension : {2, 3}) {
    Model model = two_layers(dimension);
    const std::vector<double> pressure = vertical_effective_pressure(model, 10);
    const Particles& P = model.particles;
    for (std::size_t p = 0; p < P.size(); ++p) {
      double above = 0;  // the slow way: everything in this column
      const double area = std::pow(P.reference_volume[p], (dimension - 1.0) / dimension);
      for (std::size_t q = 0; q < P.size(); ++q) {
        const Vec3 d = P.position[q] - P.position[p];
        if (std::abs(d[0]) > 0.01 || (dimension == 3 && std::abs(d[1]) > 0.01)) continue;
        if (q == p) above += 0.5 * P.mass[q] * 10 / area;
        if (d[dimension - 1] > 0.01) above += P.mass[q] * 10 / area;
      }
      EXPECT_NEAR(pressure[p], above, 1e-9 * above);
    }
  }
}

/// Particles of twice the edge stand in two columns each.
TEST(Overburden, BodiesOfOtherSizesShareColumns) {
  Model model = test::empty_model({0, 0, 0}, {2, 2, 0}, 1);
  test::seed_body(model, "fine", Hencky{{1000, 1e9, 0.25}}, 4, [](const Vec3& X) { return X[1] > 1; });
  test::seed_body(model, "coarse", Hencky{{1000, 1e9, 0.25}}, 2, [](const Vec3& X) { return X[1] < 1; });
  const std::vector<double> pressure = vertical_effective_pressure(model, 10);
  for (std::size_t p = 0; p < model.particles.size(); ++p)
    EXPECT_NEAR(pressure[p], 1000 * 10 * (2 - model.particles.position[p][1]), 1e-6);
}

TEST(PoreWater, ItsForceIsMinusTheGradientOfItsPressure) {
  WaterTable line;
  line.unit_weight = 9810;
  line.line = {{0, 3}, {2, 4}, {4, 3.5}};
  WaterTable raster = line;
  raster.line.clear();
  raster.surface.columns = raster.surface.rows = 5;
  raster.surface.cell = 1;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) raster.surface.z.push_back(3 + 0.1 * i - 0.2 * j);
  for (int dimension : {2, 3}) {
    const WaterTable& water = dimension == 2 ? line : raster;
    Model model = two_layers(dimension);
    for (std::size_t p = 0; p < model.particles.size(); ++p) {
      const Vec3& x = model.particles.position[p];
      const Vec3 force = water_force(water, model.particles, p, dimension);
      const double depth = water_level(water, x) - x[dimension - 1];
      if (depth < -0.2) {
        EXPECT_EQ(norm(force), 0);
      }
      if (depth < 0.2) continue;
      for (int a = 0; a < dimension; ++a) {
        Vec3 before = x, after = x;
        before[a] -= 0.125;
        after[a] += 0.125;
        const double slope = (pore_pressure(water, after, dimension) - pore_pressure(water, before, dimension)) / 0.25;
        EXPECT_NEAR(force[a], -slope * model.particles.reference_volume[p], 1e-8);
      }
    }
  }
}

TEST(PoreWater, MassesAreSaturatedBelowTheTable) {
  Model model = two_layers(2);
  model.water = WaterTable{9810, {{0, 1.625}}, {}};
  set_saturated_masses(model);
  set_saturated_masses(model);  // again gives the same
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    const double y = model.particles.position[p][1], density = model.particles.mass[p] / 0.0625;
    const double expected = y < 1 ? 2600 : y < 1.6 ? 2000 : y < 1.7 ? 1900 : 1800;  // one row is cut in half
    EXPECT_NEAR(density, expected, 1e-9) << y;
  }
  const Frame frame = make_frame(model, {OutputField::pore_pressure}, 0, 0);
  const auto& u = std::get<std::vector<float>>(find_field(frame, "pore_pressure")->values);
  for (std::size_t p = 0; p < u.size(); ++p)
    EXPECT_NEAR(u[p], 9810 * std::max(0.0, 1.625 - model.particles.position[p][1]), 1e-3);
}

std::string error_of(const Model& given, const SolverOptions& options) {
  Model model = given;
  test::RecordingSink sink;
  try {
    run(model, options, {}, sink, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(K0AndWater, WrongOnesAreRefused) {
  const Model model = two_layers(2);
  SolverOptions options;
  options.end_time = 1e-4;
  options.k0 = K0Options{};
  EXPECT_EQ(error_of(model, options), "");
  options.k0->ratio = 0.05;
  EXPECT_EQ(error_of(model, options), "");  // cohesion bears it
  options.k0->ratio = 4;
  EXPECT_NE(error_of(model, options).find("'clay' cannot bear"), std::string::npos);
  options.k0->ratio.reset();
  options.gravity_ramp = 1;
  EXPECT_NE(error_of(model, options).find("gravity_ramp"), std::string::npos);
  options.gravity_ramp = 0;
  options.gravity = Vec3{1, -10, 0};
  EXPECT_NE(error_of(model, options).find("straight down"), std::string::npos);
  options.k0.reset();
  EXPECT_EQ(error_of(model, options), "");
  Model wet = model;
  wet.water = WaterTable{9810, {{0, 1}}, {}};
  EXPECT_NE(error_of(wet, options).find("straight down"), std::string::npos);
  options.gravity.reset();
  wet.water->line.clear();
  EXPECT_NE(error_of(wet, options).find("an elevation"), std::string::npos);
  wet.water->line = {{1, 1}, {0, 2}};
  EXPECT_NE(error_of(wet, options).find("rises"), std::string::npos);
  wet.water->line = {{0, 1}};
  wet.water->unit_weight = -1;
  EXPECT_NE(error_of(wet, options).find("unit weight"), std::string::npos);
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A water table against closed forms of effective stress, and starts from K0 stress.
#include "solver/core/pore_water.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

constexpr double kG = 10, kWater = 1000, kDry = 1800, kSaturated = 2100, kHeight = 10, kCell = 0.5;

struct Way {
  const char* name;
  Formulation formulation;
  ShapeFunction shape;
  int dimension;
};
constexpr Way kWays[]{{"TL 2D", Formulation::total_lagrangian, ShapeFunction::linear, 2},
                      {"TL 3D", Formulation::total_lagrangian, ShapeFunction::linear, 3},
                      {"UL linear 2D", Formulation::updated_lagrangian, ShapeFunction::linear, 2},
                      {"UL GIMP 3D", Formulation::updated_lagrangian, ShapeFunction::gimp, 3}};

MohrCoulomb soil() {
  MohrCoulomb law{{kDry, 50e6, 0.3}, 20e3, 30, 0};
  law.saturated_density = kSaturated;
  return law;
}

WaterTable level(double elevation) {
  WaterTable water;
  water.unit_weight = kWater * kG;
  water.line = {{0, elevation}};
  return water;
}

Model column(const Way& way, const Material& law) {
  const bool plane = way.dimension == 2;
  Model model = test::empty_model({0, 0, 0}, {kCell, plane ? kHeight : kCell, plane ? 0 : kHeight}, kCell,
                                  {Condition::roller, Condition::roller, plane ? Condition::fixed : Condition::roller,
                                   plane ? Condition::free : Condition::roller, Condition::fixed});
  test::seed_body(model, "column", law, 2, test::everywhere);
  model.bodies[0].formulation = way.formulation;
  return model;
}

SolverOptions at_rest(const Way& way, double end) {
  SolverOptions options = solver(end, way.dimension == 2 ? Vec3{0, -kG, 0} : Vec3{0, 0, -kG});
  options.shape = way.shape;
  return options;
}

/// sigma'_v of level ground with the table at this elevation, as a pressure.
double vertical(double z, double table) {
  const double dry = std::max(0.0, kHeight - std::max(z, table));
  return kG * (kDry * dry + (kSaturated - kWater) * (kHeight - z - dry));
}

TEST(WaterTable, EffectiveStressIsThatOfBuoyantWeight) {
  for (const Way& way : kWays)
    for (double table : {13.0, 5.0}) {
      const std::string name =
          std::string(way.name) + (table > kHeight ? ", column under 3 m of water: " : ", table at mid height: ");
      Model model = column(way, soil());
      model.water = level(table);
      SolverOptions options = at_rest(way, 0.05);
      options.relax = RelaxOptions{};
      options.relax->until = 1e-9;
      RecordingSink sink;
      double worst = 0, pressure = 0;
      sink.on_frame = [&](const Model& m, double time) {
        const int up = way.dimension - 1;
        for (std::size_t p = 0; time == 0 && p < m.particles.size(); ++p) {
          const double z = m.particles.position[p][up], centre = (std::floor(z / kCell) + 0.5) * kCell;
          worst = std::max(worst, std::abs(m.particles.stress[p][up] + vertical(centre, table)));
          pressure = std::max(pressure, std::abs(pore_pressure(*m.water, m.particles.position[p], way.dimension) -
                                                 kWater * kG * std::max(0.0, table - z)));
        }
      };
      ASSERT_FALSE(run(model, options, output(0.05, 0.05), sink, 1).failed);
      validate_near(name + "largest error of sigma'_v / sigma'_v at the base", 0, worst / vertical(0, table),
                    way.formulation == Formulation::total_lagrangian ? 2e-3 : 3e-3,
                    "closed form at cell centres; small strain, which in UL moves points off them");
      validate_near(name + "error of the pore pressure, Pa", 0, pressure, 1e-6, "hydrostatic");
    }
}

/// A slope of 30 degrees on a fixed base, 2D.
Model slope(const Material& law, Formulation formulation) {
  Model model = test::empty_model({0, 0, 0}, {24, 8, 0}, 0.5, {Condition::roller, Condition::roller, Condition::fixed});
  test::seed_body(model, "slope", law, 2,
                  [](const Vec3& X) { return X[1] < std::max(2.0, std::min(6.0, (20 - X[0]) / 2)); });
  model.bodies[0].formulation = formulation;
  return model;
}

TEST(WaterTable, ASlopeUnderWaterBearsItsBuoyantWeight) {
  std::vector<Sym6> stress[2];
  for (bool wet : {false, true}) {
    Hencky law{{kDry, 50e6, 0.3}};  // elastic: the way to rest, which the mass sets, leaves no trace
    law.saturated_density = kSaturated;
    if (!wet) law.density = kSaturated - kWater;
    Model model = slope(law, Formulation::total_lagrangian);
    if (wet) model.water = level(9);
    SolverOptions options = solver(0.01, {0, -kG, 0});
    options.relax = RelaxOptions{};
    options.relax->until = 1e-9;
    RecordingSink sink;
    sink.on_frame = [&](const Model& m, double time) {
      if (time == 0) stress[wet] = m.particles.stress;
    };
    ASSERT_FALSE(run(model, options, output(0.01, 0.01), sink, 1).failed);
  }
  double worst = 0, largest = 0;
  for (std::size_t p = 0; p < stress[0].size(); ++p)
    for (int i = 0; i < 6; ++i) {
      worst = std::max(worst, std::abs(stress[0][p][i] - stress[1][p][i]));
      largest = std::max(largest, std::abs(stress[0][p][i]));
    }
  validate_near("slope under water: difference to a dry one of rho_sat - rho_w / largest stress", 0, worst / largest,
                5e-3, "the free water's weight is in - grad u; both relaxed to 1e-9");
}

TEST(K0, LevelGroundStartsAtRestWithItsStress) {
  for (const Way& way : kWays)
    for (bool elastic : {false, true}) {
      const std::string name =
          std::string(way.name) + (elastic ? ", K0 of a linear elastic column: " : ", K0 of a frictional column: ");
      const double table = 4.25, ratio = elastic ? 0.3 / 0.7 : 0.5;  // 1 - sin(30 deg)
      LinearElastic hooke{{kDry, 50e6, 0.3}};
      hooke.saturated_density = kSaturated;
      Model model = column(way, elastic ? Material(hooke) : Material(soil()));
      model.water = level(table);
      SolverOptions options = at_rest(way, 1);
      options.k0 = K0Options{};
      RecordingSink sink;
      double error = 0, sideways = 0, jump = 0;
      sink.on_frame = [&](const Model& m, double time) {
        const int up = way.dimension - 1;
        for (std::size_t p = 0; p < m.particles.size(); ++p) {
          const Sym6& s = m.particles.stress[p];
          const double v = vertical(m.particles.reference_position[p][up], table);
          if (time == 0) {
            error = std::max(error, std::abs(s[up] + v));
            sideways = std::max(sideways, std::abs(s[0] - ratio * s[up]));
          }
          jump = std::max(jump, std::abs(s[up] + v));
        }
      };
      const RunReport report = run(model, options, output(0.05, 0.01), sink, 1);
      ASSERT_FALSE(report.failed);
      const double base = vertical(0, table), settlement = base / 2 / 67.3e6 * kHeight;
      validate_near(name + "largest error of sigma'_v at t = 0 / that at the base", 0, error / base, 1e-9,
                    "overburden");
      validate_near(name + "largest error of sigma'_h = K0 sigma'_v / that at the base", 0, sideways / base, 1e-9,
                    elastic ? "nu / (1 - nu)" : "1 - sin(phi)");
      validate_near(name + "largest displacement in 1 s / settlement of its weight", 0,
                    report.largest_displacement / settlement, 0.02,
                    "at rest; a table inside a cell, and elastic strain in F, are what moves");
      validate_near(name + "largest change of sigma'_v in 1 s / that at the base", 0, jump / base, 0.01, "the same");
    }
}

TEST(K0, AnAbsorbingBaseBearsTheColumn) {
  Model model = column(kWays[0], soil());
  model.domain.faces[2] = FaceCondition::absorbing;
  SolverOptions options = at_rest(kWays[0], 1);
  options.k0 = K0Options{};
  RecordingSink sink;
  const RunReport report = run(model, options, output(0.1, 0.01), sink, 1);
  ASSERT_FALSE(report.failed);
  validate_near("K0 column on an absorbing base: displacement in 1 s / free fall", 0,
                report.largest_displacement / (0.5 * kG), 1e-4, "one step at rest finds what supports it");
}

TEST(K0, ASlopeRelaxesFasterFromIt) {
  double left[2];
  for (bool k0 : {false, true}) {
    MohrCoulomb law = soil();
    Model model = slope(law, Formulation::total_lagrangian);
    SolverOptions options = solver(0.5, {0, -kG, 0});
    if (k0) options.k0 = K0Options{};
    options.relax = RelaxOptions{};
    options.relax->time = 0.15;
    RecordingSink sink;
    ASSERT_FALSE(run(model, options, output(0.5, 0.005), sink, 1).failed);
    left[k0] = 0;
    for (const HistorySample& s : sink.samples) left[k0] = std::max(left[k0], s.kinetic);
  }
  validate_within("slope relaxed for 0.15 s: kinetic energy that is left from K0 / from nothing", 0, 0.5,
                  left[1] / left[0], "only shear and the toe are missing");
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fluids and clay against their closed forms: in runs, and at a point.
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"
#include "tests/support/triaxial.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using std::numbers::pi;
using test::output;
using test::RecordingSink;
using test::solver;
using test::validate_near;

/// A column of water at rest: the mass above a material point, times g, is its pressure at any compression.
TEST(Water, StandsWithHydrostaticPressure) {
  const double H = 1, g = 9.81, h = 0.1;
  for (const bool updated : {false, true}) {
    Model model = test::empty_model({0, 0, 0}, {2 * h, H + h, 0}, h,
                                    {Condition::roller, Condition::roller, Condition::roller, Condition::free});
    test::seed_body(model, "column", Water{.density = 1000, .sound_speed = 20}, 2,
                    [&](const Vec3& X) { return X[1] < H; });
    if (updated) model.bodies[0].formulation = Formulation::updated_lagrangian;
    SolverOptions options =
        solver(2, {0, -g, 0}, 0.4, updated ? ShapeFunction::quadratic_bspline : ShapeFunction::linear);
    options.damping = 0.5;
    RecordingSink sink;
    const RunReport report = run(model, options, output(2, 1), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    std::map<int, Vec2> cells;  // sum of p and count, by the row of reference cells
    for (std::size_t p = 0; p < model.particles.size(); ++p) {
      Vec2& cell = cells[static_cast<int>(model.particles.reference_position[p][1] / h)];
      cell[0] -= model.particles.stress[p][1];
      cell[1] += 1;
    }
    double worst = 0;
    for (const auto& [row, sum] : cells)
      worst = std::max(worst, std::abs(sum[0] / sum[1] - 1000 * g * (H - (row + 0.5) * h)) / (1000 * g * H));
    validate_near(
        std::string("water column, ") + (updated ? "UL B-spline" : "TL") +
            ": largest error of the pressure / that at the bottom",
        0, worst, updated ? 0.02 : 2e-3,
        updated ? "10 cells; the column sinks through the grid" : "linear cells carry it exactly; rest of the motion");
  }
}

/// Flow between two plates that starts from rest under a body force; viscosity alone resists.
/// u = a/(2 nu) y (H - y) - sum over odd n of 4 a H^2 / (nu pi^3 n^3) sin(n pi y / H) exp(-n^2 pi^2 nu t / H^2).
double poiseuille(double a, double nu, double H, double y, double t) {
  double u = a / (2 * nu) * y * (H - y);
  for (int n = 1; n < 60; n += 2)
    u -= 4 * a * H * H / (nu * std::pow(pi * n, 3)) * std::sin(n * pi * y / H) *
         std::exp(-n * n * pi * pi * nu * t / (H * H));
  return u;
}

TEST(Water, StartsToFlowBetweenPlatesAndDissipatesTheWorkOfTheForce) {
  const double H = 1, a = 1e-3, nu = 0.1, h = 1.0 / 16;
  Model model = test::empty_model({0, 0, 0}, {h, H, 0}, h,
                                  {Condition::free, Condition::free, Condition::fixed, Condition::fixed});
  test::seed_body(model, "oil", Water{.density = 1000, .sound_speed = 1, .viscosity = 1000 * nu}, 2, test::everywhere);
  NodeSet all{"straight stream lines", Condition::roller, 1, {}};  // one column of cells stands for an endless channel
  for (int j = 0; j <= 16; ++j)
    for (int i = 0; i <= 1; ++i) all.nodes.push_back({i, j, 0});
  model.bodies[0].held.push_back(all);
  RecordingSink sink;
  std::map<double, double> errors;
  sink.on_frame = [&](const Model& m, double time) {
    for (std::size_t p = 0; p < m.particles.size(); ++p)
      errors[time] = std::max(
          errors[time], std::abs(m.particles.velocity[p][0] - poiseuille(a, nu, H, m.particles.position[p][1], time)));
  };
  const RunReport report = run(model, solver(6, {a, 0, 0}, 0.4), output(1, 0.1), sink, 1);
  ASSERT_FALSE(report.failed) << report.failure.what;
  const double fastest = a * H * H / (8 * nu);
  validate_near("plane Poiseuille flow: largest error at 1 s / steady maximum", 0, errors[1.0] / fastest, 0.01,
                "O(h^2) of 16 cells; a tenth of the viscous time H^2 / nu");
  validate_near("plane Poiseuille flow: the same at 6 s", 0, errors[6.0] / fastest, 0.01, "the same; nearly steady");
  const double supplied = report.first.potential - report.last.potential;
  validate_near("plane Poiseuille flow: (dissipated + kinetic) / work of the force", 1,
                (report.last.plastic + report.last.kinetic) / supplied, 0.01, "balance of energy");
}

CamClay clay(double ratio) {
  CamClay m{.density = 1700, .shear_modulus = 20e6, .kappa = 0.05, .lambda = 0.2, .void_ratio = 1};
  m.initial_pressure = 100e3;
  m.critical_stress_ratio = 1.2;
  m.overconsolidation_ratio = ratio;
  return m;
}

TEST(CamClayElement, EndsWhereClosedFormsSay) {
  const CamClay normal = clay(1);
  test::Triaxial<CamClay> pressed(normal);
  const double end = 0.1, s = std::exp(-end / 3);
  const double p = test::pressure_of(pressed.move({s, 0, 0, 0, s, 0, 0, 0, s}));
  validate_near("Cam-clay, virgin compression: ln(p/p0) at a volumetric strain of 0.1",
                end * (1 + normal.swelling()) / (normal.swelling() + normal.hardening()), std::log(p / 100e3), 1e-10,
                "closed form, one step");
  for (const double ratio : {1.0, 8.0}) {
    test::Triaxial<CamClay> point(clay(ratio));
    Sym6 sigma{};
    for (int i = 1; i <= 500; ++i) sigma = point.undrained(2e-3 * i);
    const double critical = 100e3 * std::pow(ratio / 2, 1 - 0.05 / 0.2);
    const std::string name =
        "Cam-clay, undrained triaxial, overconsolidation " + std::to_string(static_cast<int>(ratio));
    validate_near(name + ": p in the end, Pa", critical, test::pressure_of(sigma), 1e-3 * critical,
                  "p0 (R/2)^(1 - kappa/lambda)");
    validate_near(name + ": q in the end, Pa", 1.2 * critical, test::deviator_of(sigma), 1.2e-3 * critical, "M p");
  }
  test::Triaxial<CamClay> drained(normal);
  Sym6 sigma{};
  for (int i = 1; i <= 400; ++i) sigma = drained.drained(4e-3 * i, 100e3);
  validate_near("Cam-clay, drained triaxial: p in the end, Pa", 100e3 / 0.6, test::pressure_of(sigma), 200,
                "p0 / (1 - M/3)");
}

}  // namespace
}  // namespace scarp

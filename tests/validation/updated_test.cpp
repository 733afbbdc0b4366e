// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Updated-Lagrangian bodies against closed forms and published figures (method.md section 3).
#include <gtest/gtest.h>

#include <numbers>

#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using std::numbers::pi;
using test::output;
using test::RecordingSink;
using test::solver;
using test::validate_near;
using test::validate_within;

constexpr Condition kFree = Condition::free, kRoller = Condition::roller, kFixed = Condition::fixed;

void make_updated(Model& model) {
  for (Body& body : model.bodies) body.formulation = Formulation::updated_lagrangian;
}

struct Disks {
  RunReport report;
  std::size_t particles = 0;
  double least_kinetic = 0, time_of_least = 0, last_total = 0, momentum_change = 0, momentum = 0;
};

/// Sulsky's disks, E = 1000, nu = 0.3, rho = 1000, v = 0.1, that meet through one grid of n x n cells.
Disks disks(int n, ShapeFunction shape) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, 0}, 1.0 / n);
  const NeoHookean law{{1000, 1000, 0.3}};
  const auto add = [&](const char* name, double centre, double v) {
    test::seed_body(
        model, name, law, 2, [=](const Vec3& X) { return std::hypot(X[0] - centre, X[1] - centre) < 0.2; },
        [=](const Vec3&) {
          return Vec3{v, v, 0};
        });
  };
  add("left", 0.2, 0.1);
  add("right", 0.8, -0.1);
  make_updated(model);
  RecordingSink sink;
  Disks d;
  d.report = run(model, solver(3.5, {0, 0, 0}, 0.2, shape), output(0.5, 0.01), sink, 1);
  d.particles = model.particles.size();
  d.least_kinetic = INFINITY;
  for (const HistorySample& s : sink.samples) {
    if (s.kinetic < d.least_kinetic) {
      d.least_kinetic = s.kinetic;
      d.time_of_least = s.time;
    }
    d.momentum_change = std::max(d.momentum_change, norm(s.momentum));
  }
  for (std::size_t p = 0; p < model.bodies[0].end; ++p) d.momentum += model.particles.mass[p] * std::sqrt(2) * 0.1;
  return d;
}

TEST(UpdatedDisks, MeetThroughOneGridKeepMomentumAndEnergyAndPart) {
  const Disks coarse = disks(20, ShapeFunction::linear), fine = disks(40, ShapeFunction::quadratic_bspline);
  ASSERT_FALSE(coarse.report.failed);
  ASSERT_FALSE(fine.report.failed);
  validate_near("UL disks, 20 cells: particles", 416, static_cast<double>(coarse.particles), 0, "exact count");
  validate_near("UL disks, 20 cells: energy at the start", 2.6, coarse.report.first.total, 1e-12, "of 416 particles");
  validate_near("UL disks, 20 cells: least kinetic energy", 0.077, coarse.least_kinetic, 0.01,
                "same discretisation in other codes; it rides on the step and the stress update");
  validate_near("UL disks, 20 cells: its time, s", 1.95, coarse.time_of_least, 0.03, "the same");
  validate_near("UL disks, 40 cells: particles", 1624, static_cast<double>(fine.particles), 0, "exact count");
  validate_within("UL disks, 40 cells: least kinetic energy / initial", 0.036, 0.064,
                  fine.least_kinetic / fine.report.first.total,
                  "limit of the mesh 0.058 +- 0.006; 0.028 with 20 cells");
  for (const Disks& d : {coarse, fine}) {
    const std::string name = "UL disks, " + std::to_string(d.particles) + " particles: ";
    validate_near(name + "momentum / that of one disk", 0, d.momentum_change / d.momentum, 1e-12,
                  "internal forces sum to nothing; rounding");
    validate_near(name + "total energy at 3.5 s / initial", 1, d.report.last.total / d.report.first.total, 0.01,
                  "nothing dissipates");
    validate_within(name + "kinetic energy at 3.5 s / initial", 0.85, 0.96,
                    d.report.last.kinetic / d.report.first.total, "they part; the rest is vibration");
  }
}

/// First mode of a fixed-free bar, L = 25, E = 100, rho = 1, v0 = 0.1, as in the total-Lagrangian test. Particles swing
/// over a third of a cell and cross its faces: linear functions err by 10 % here, smooth ones hardly.
TEST(UpdatedBar, VibratesInItsFirstMode) {
  const double length = 25, v0 = 0.1, amplitude = 2 * v0 / pi, mass = length * 0.5;
  for (ShapeFunction shape : {ShapeFunction::quadratic_bspline, ShapeFunction::gimp}) {
    Model model = test::empty_model({0, 0, 0}, {length + 1, 0.5, 0}, 0.5, {kFixed, kFree, kRoller, kRoller});
    test::seed_body(
        model, "bar", LinearElastic{{1, 100, 0}}, 2, [&](const Vec3& X) { return X[0] < length; },
        [&](const Vec3& X) {
          return Vec3{v0 * std::sin(pi * X[0] / (2 * length)), 0, 0};
        });
    make_updated(model);
    RecordingSink sink;
    const RunReport report = run(model, solver(20, {0, 0, 0}, 0.4, shape), output(10, 0.1), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    double worst = 0, crossing = 0;
    for (std::size_t i = 1; i < sink.samples.size(); ++i) {
      const HistorySample &a = sink.samples[i - 1], &b = sink.samples[i];
      worst = std::max(worst, std::abs(b.momentum[0] / mass - amplitude * std::cos(2 * pi * b.time / 10)));
      if (a.momentum[0] < 0 && b.momentum[0] >= 0)
        crossing = a.time + (b.time - a.time) * a.momentum[0] / (a.momentum[0] - b.momentum[0]);
    }
    const std::string name = "UL bar, " + std::string(name_of(shape)) + ": ";
    validate_near(name + "largest error of v_cm over two periods / amplitude", 0, worst / amplitude, 0.012,
                  "O(h^2) at 50 cells, and the half step between v and x");
    validate_near(name + "period", 10, crossing - 7.5, 0.02, "second rise through zero, at 17.5");
    validate_near(name + "energy after two periods / initial", 1, report.last.total / report.first.total, 1e-3,
                  "nothing dissipates");
  }
}

struct Column {
  double worst = 0, mean = 0;  ///< error of sigma_yy / rho0 g H
  double compression = 1;      ///< least F_yy
  double swing = 0;            ///< kinetic energy at the end / largest
};

/// A column of 10 m under its own weight, damped so that it comes to rest, against sigma_yy = - rho0 g (H - Y).
Column column(double E, double end_time) {
  const double height = 10, rho = 1000, g = 10, scale = rho * g * height;
  Model model = test::empty_model({0, 0, 0}, {0.5, height, 0}, 0.5, {kRoller, kRoller, kFixed, kFree});
  test::seed_body(model, "column", NeoHookean{{rho, E, 0.3}}, 2, test::everywhere);
  make_updated(model);
  SolverOptions options = solver(end_time, {0, -g, 0}, 0.4, ShapeFunction::quadratic_bspline);
  options.damping = 0.3;
  options.flip = 0.9;
  RecordingSink sink;
  const RunReport report = run(model, options, output(end_time, end_time / 100), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  Column c;
  c.swing = report.last.kinetic / report.largest_kinetic;
  const Particles& p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double error = std::abs(p.stress[i][1] + rho * g * (height - p.reference_position[i][1])) / scale;
    c.worst = std::max(c.worst, error);
    c.mean += error / static_cast<double>(p.size());
    c.compression = std::min(c.compression, p.deformation_gradient[i][4]);
  }
  return c;
}

TEST(UpdatedColumn, CarriesItsOwnWeight) {
  const Column stiff = column(1e7, 6), soft = column(4e5, 30);
  validate_near("UL column, 0.7 % strain: kinetic energy at the end / largest", 0, stiff.swing, 0.01, "damped");
  validate_near("UL column, 0.7 % strain: largest error of sigma_yy / rho0 g H", 0, stiff.worst, 0.01,
                "particles are not Gauss points in the cells at the walls");
  validate_near("UL column, 0.7 % strain: mean error of sigma_yy / rho0 g H", 0, stiff.mean, 0.002, "inside they are");
  validate_within("UL column, soft: compression at the base, F_yy", 0.7, 0.9, soft.compression,
                  "large strain, so that the test means it");
  validate_near("UL column, soft: largest error of sigma_yy / rho0 g H", 0, soft.worst, 0.08,
                "particles have crossed cells and stand unevenly in them: the known quadrature error");
  validate_near("UL column, soft: mean error of sigma_yy / rho0 g H", 0, soft.mean, 0.015, "the same");
}

/// A block on a face with friction at 30 degrees, after Coulomb. It is set down suddenly and rings on its base.
TEST(UpdatedIncline, SlidesAndSticksAfterCoulomb) {
  const double g = 9.81, angle = pi / 6, end = 0.5, free = g * std::sin(angle) * end;
  for (ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline, ShapeFunction::gimp})
    for (double mu : {0.0, 0.3, 0.7}) {
      Model model = test::empty_model({0, 0, 0}, {4, 1.25, 0}, 0.125);
      model.domain.faces[2] = Face(FaceCondition::friction, mu);
      test::seed_body(model, "block", NeoHookean{{1000, 1e6, 0.3}}, 2,
                      [](const Vec3& X) { return X[0] > 0.5 && X[0] < 1.5 && X[1] < 0.5; });
      make_updated(model);
      RecordingSink sink;
      const Vec3 gravity{g * std::sin(angle), -g * std::cos(angle), 0};
      const RunReport report = run(model, solver(end, gravity, 0.4, shape), output(end, end), sink, 1);
      ASSERT_FALSE(report.failed) << report.failure.what;
      const double exact = std::max(0.0, free - mu * g * std::cos(angle) * end), v = report.last.momentum[0] / 500;
      const std::string name =
          "UL incline, " + std::string(name_of(shape)) + ", mu = " + std::to_string(mu).substr(0, 3) + ": ";
      if (mu < 0.6)
        validate_near(name + "speed / that without friction", exact / free, v / free, mu > 0 ? 0.015 : 1e-9,
                      mu > 0 ? "the base rings after the sudden start" : "no force along the face");
      else
        validate_within(name + "creep / free slide", 0, 0.1, v / free, "sticks once the base has stopped ringing");
    }
}

}  // namespace
}  // namespace scarp

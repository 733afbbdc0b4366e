// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Updated-Lagrangian bodies that meet on the grid (method.md 1.3 and section 3).
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>

#include "tests/support/two_disks.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using std::numbers::pi;
using test::output;
using test::Rebound;
using test::RecordingSink;
using test::solver;
using test::validate_near;
using test::validate_within;

Rebound rebound(int n, double courant, ShapeFunction shape) {
  Model model = test::two_disks(n, Formulation::updated_lagrangian);
  model.contact.method = ContactMethod::grid;
  return test::rebound(std::move(model), solver(3.5, {0, 0, 0}, courant, shape));
}

void expect_balance(const std::string& name, const Rebound& r) {
  validate_near(name + "momentum / that of one disk", 0, r.drift, 1e-12, "impulses in pairs; rounding");
  validate_near(name + "largest error of the total energy / initial", 0,
                r.report.largest_energy_error / r.report.first.total, 0.02, "all that is lost is counted");
}

TEST(GridContactDisks, ReboundWithinThePublishedBands) {
  for (int n : {40, 80}) {
    const Rebound r = rebound(n, 0.2, ShapeFunction::gimp);
    ASSERT_FALSE(r.report.failed) << r.report.failure.what;
    const std::string name = "UL disks in contact, GIMP, " + std::to_string(n) + " cells: ";
    validate_near(name + "least kinetic energy / initial", 0.058, r.least, 0.006,
                  "limit of the mesh of unrelated codes");
    validate_near(name + "its time, s", 2.09, r.time_of_least, 0.02, "the same");
    validate_near(name + "largest strain energy / initial", 0.938, r.most_stored, 0.01, "the same");
    validate_near(name + "mean kinetic energy after parting / initial", 0.89, r.after, 0.02,
                  "the same; the rest is vibration");
    validate_near(name + "last time with a tenth of the largest force, s", 2.59, r.pressed, 0.02, "separation");
    expect_balance(name, r);
  }
}

/// A B-spline's node binds particles that are up to three cells apart: coarser by half.
TEST(GridContactDisks, ComeNearTheBandsWithOtherShapes) {
  for (const auto shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline}) {
    const Rebound r = rebound(80, 0.2, shape);
    ASSERT_FALSE(r.report.failed) << r.report.failure.what;
    const std::string name = "UL disks in contact, " + std::string(name_of(shape)) + ", 80 cells: ";
    validate_near(name + "least kinetic energy / initial", 0.058, r.least, 0.008, "the bands, and a third more");
    validate_near(name + "its time, s", 2.09, r.time_of_least, 0.02, "the bands");
    validate_near(name + "largest strain energy / initial", 0.938, r.most_stored, 0.01, "the bands");
    expect_balance(name, r);
  }
}

TEST(GridContactDisks, HoldWithHalfAndTwiceTheStep) {
  const Rebound r = rebound(40, 0.2, ShapeFunction::gimp);
  for (double courant : {0.1, 0.4}) {
    const Rebound other = rebound(40, courant, ShapeFunction::gimp);
    ASSERT_FALSE(other.report.failed) << other.report.failure.what;
    const std::string name =
        std::string("UL disks in contact, GIMP, ") + (courant < 0.2 ? "half" : "twice") + " the step: ";
    validate_near(name + "change of the least kinetic energy / initial", 0, other.least - r.least, 0.005,
                  "the step is not part of the model");
    validate_near(name + "change of its time, s", 0, other.time_of_least - r.time_of_least, 0.01, "the same");
    validate_near(name + "change of the kinetic energy after parting / initial", 0, other.after - r.after, 0.01,
                  "the same");
    expect_balance(name, other);
  }
}

/// Weight comes over this time, s, so that nothing bounces: an impulse of half as much.
constexpr double kRamp = 0.2;

std::string numbers(double degrees, double mu) {
  return std::to_string(degrees).substr(0, degrees < 10 ? 1 : 2) + " degrees, mu = " + std::to_string(mu).substr(0, 3);
}

SolverOptions on_incline(double degrees, double end, ShapeFunction shape) {
  const double g = 9.81, angle = degrees * pi / 180;
  SolverOptions options = solver(end, {g * std::sin(angle), -g * std::cos(angle), 0}, 0.5, shape);
  options.gravity_ramp = kRamp;
  return options;
}

struct Slide {
  double speed = 0, crept = 0;  ///< of the block at the end, in the mean of the second half / that without friction
  double force = 0;             ///< normal force in the second half / weight
  double balance = 0;           ///< error of the energy / largest
};

/// A block on a slab whose base is held.
Slide slide(double degrees, double mu, double end, ShapeFunction shape, double damping = 0) {
  Model model = test::empty_model({0, 0, 0}, {4, 1.25, 0}, 0.125, {Condition::free, Condition::free, Condition::fixed});
  test::seed_body(model, "slab", NeoHookean{{1000, 1e6, 0.3}}, 2, [](const Vec3& X) { return X[1] < 0.375; });
  test::seed_body(model, "block", NeoHookean{{1000, 1e6, 0.3}}, 2,
                  [](const Vec3& X) { return X[0] > 0.5 && X[0] < 1.5 && X[1] > 0.375 && X[1] < 0.875; });
  for (Body& body : model.bodies) body.formulation = Formulation::updated_lagrangian;
  model.contact.method = ContactMethod::grid;
  model.contact.friction = mu;
  RecordingSink sink;
  std::vector<double> x;
  double mass = 0, momentum = 0;
  sink.on_frame = [&](const Model& now, double) {
    mass = momentum = 0;
    double moment = 0;
    for (std::size_t p = now.bodies[1].begin; p < now.bodies[1].end; ++p) {
      mass += now.particles.mass[p];
      moment += now.particles.mass[p] * now.particles.position[p][0];
      momentum += now.particles.mass[p] * now.particles.velocity[p][0];
    }
    x.push_back(moment / mass);
  };
  SolverOptions options = on_incline(degrees, end, shape);
  options.damping = damping;
  const RunReport report = run(model, options, output(end / 2, end / 50), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  const Vec3 g = *options.gravity;
  Slide s;
  s.speed = momentum / mass / (g[0] * (end - kRamp / 2));
  s.crept = (x[2] - x[1]) / (end / 2) / (g[0] * (0.75 * end - kRamp / 2));
  double count = 0;
  for (const HistorySample& sample : sink.samples) {
    if (sample.time < 0.5 * end) continue;
    s.force += sample.contact_force[1][1] / (mass * -g[1]);
    ++count;
  }
  s.force /= count;
  s.balance = report.largest_energy_error / report.largest_energy;
  return s;
}

TEST(GridContactIncline, SlidesAndSticksAfterCoulomb) {
  for (const auto shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline, ShapeFunction::gimp}) {
    const std::string problem = "UL block on UL incline, " + std::string(name_of(shape)) + ", ";
    for (const auto& [degrees, mu] : {std::pair{5., 0.}, {30., 0.}, {30., 0.3}, {45., 0.3}, {45., 0.6}, {15., 0.1}}) {
      const Slide s = slide(degrees, mu, 0.5, shape);
      const std::string name = problem + numbers(degrees, mu) + ": ";
      validate_near(name + "speed / that without friction", 1 - mu / std::tan(degrees * pi / 180), s.speed, 0.015,
                    "Coulomb");
      validate_near(name + "normal force / weight", 1, s.force, 0.05, "the block rings on the slab");
      validate_near(name + "error of the energy / largest", 0, s.balance, 0.02, "all that is lost is counted");
    }
    for (const auto& [degrees, mu] : {std::pair{30., 0.7}, {5., 0.2}}) {
      const std::string name = problem + numbers(degrees, mu) + ": ";
      validate_near(name + "creep / free slide", 0, slide(degrees, mu, 1, shape).crept, 0.01,
                    "sticks: mean speed from 0.5 to 1 s");
    }
    const std::string name = problem + numbers(40, 1) + ": ";
    validate_within(name + "creep / free slide", -0.01, 0.1, slide(40, 1, 1, shape).crept,
                    "sticks; it rocks on its lower edge, and slips a little each time");
    validate_near(name + "the same, with damping of 0.02", 0, slide(40, 1, 1, shape, 0.02).crept, 0.01,
                  "no more where the rocking dies away");
  }
}

/// A stiff disk on an inclined slab. Rolls where tan < 3 mu, else slides.
TEST(GridContactRolling, OfADiskIsThatOfARigidOne) {
  const double g = 9.81, end = 0.5, R = 0.5, floor = 0.25;
  for (const auto& [degrees, mu] : {std::pair{45., 1.}, {30., 0.1}, {45., 0.2}}) {
    Model model =
        test::empty_model({0, 0, 0}, {5, 1.75, 0}, 0.03125, {Condition::free, Condition::free, Condition::fixed});
    test::seed_body(model, "slab", NeoHookean{{1000, 1e7, 0.3}}, 2, [&](const Vec3& X) { return X[1] < floor; });
    test::seed_body(model, "disk", NeoHookean{{1000, 1e7, 0.3}}, 2,
                    [&](const Vec3& X) { return std::hypot(X[0] - 1, X[1] - floor - R) < R; });
    for (Body& body : model.bodies) body.formulation = Formulation::updated_lagrangian;
    model.contact.method = ContactMethod::grid;
    model.contact.friction = mu;
    RecordingSink sink;
    const RunReport report = run(model, on_incline(degrees, end, ShapeFunction::gimp), output(end, end / 10), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    double mass = 0, momentum = 0;
    for (std::size_t i = model.bodies[1].begin; i < model.bodies[1].end; ++i) {
      mass += model.particles.mass[i];
      momentum += model.particles.mass[i] * model.particles.velocity[i][0];
    }
    const double angle = degrees * pi / 180;
    const bool rolls = std::tan(angle) < 3 * mu;
    const double a = rolls ? 2.0 / 3 * g * std::sin(angle) : g * (std::sin(angle) - mu * std::cos(angle));
    validate_near("UL disk on UL incline, " + numbers(degrees, mu) + ": acceleration / exact", 1,
                  momentum / mass / (a * (end - kRamp / 2)), rolls ? 0.05 : 0.03,
                  rolls ? "rolls: 2/3 g sin; the rim of a lattice has facets"
                        : "slides: g (sin - mu cos); the rim's facets catch by 0.01 of friction");
  }
}

/// Two cubes of 20 cells that are pressed together over a face: 5 % of their particles are of the face's two layers.
TEST(GridContactCost, OfAStepIsBelowHalfAsMuchAgain) {
  const auto seconds = [](ContactMethod method) {
    Model model = test::empty_model({0, 0, 0}, {44, 24, 24}, 1);
    const auto add = [&](const char* name, double from, double v) {
      test::seed_body(
          model, name, NeoHookean{{1000, 1e6, 0.3}}, 2,
          [=](const Vec3& X) {
            return X[0] > from && X[0] < from + 20 && X[1] > 2 && X[1] < 22 && X[2] > 2 && X[2] < 22;
          },
          [=](const Vec3&) {
            return Vec3{v, 0, 0};
          });
      model.bodies.back().formulation = Formulation::updated_lagrangian;
    };
    add("left", 2, 1);
    add("right", 22, -1);
    model.contact.method = method;
    RecordingSink sink;
    const auto begin = std::chrono::steady_clock::now();
    const RunReport report = run(model, solver(0.2, {0, 0, 0}, 0.5), output(0.2, 0.2), sink, 1);
    EXPECT_FALSE(report.failed);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() /
           static_cast<double>(report.steps);
  };
  double best = INFINITY;
  for (int i = 0; i < 3; ++i) best = std::min(best, seconds(ContactMethod::grid) / seconds(ContactMethod::none));
  validate_within("UL cubes that touch with 5 % of their particles: step with contact / without", 0.5, 1.5, best,
                  "best of three ratios in one run");
}

}  // namespace
}  // namespace scarp

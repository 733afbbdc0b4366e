// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Updated-Lagrangian bodies that meet on the grid (method.md 1.3 and section 3).
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/incline.hpp"
#include "tests/support/two_disks.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using std::numbers::pi;
using test::Incline;
using test::kRamp;
using test::output;
using test::Rebound;
using test::RecordingSink;
using test::Slide;
using test::slide;
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

TEST(GridContactDisks, ComeNearTheBandsWithOtherShapes) {
  for (const auto shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline}) {
    const Rebound r = rebound(80, 0.2, shape);
    ASSERT_FALSE(r.report.failed) << r.report.failure.what;
    const std::string name = "UL disks in contact, " + std::string(name_of(shape)) + ", 80 cells: ";
    const bool linear = shape == ShapeFunction::linear;
    validate_near(name + "least kinetic energy / initial", 0.058, r.least, linear ? 0.008 : 0.006,
                  linear ? "the bands, and a third more: particles cross cells" : "the bands");
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

Incline on(double degrees, double mu, ShapeFunction shape) {
  return {.degrees = degrees,
          .mu = mu,
          .method = ContactMethod::grid,
          .block = Formulation::updated_lagrangian,
          .slab = Formulation::updated_lagrangian,
          .shape = shape,
          .courant = 0.5};
}

TEST(GridContactIncline, SlidesAndSticksAfterCoulomb) {
  for (const auto shape : {ShapeFunction::linear, ShapeFunction::quadratic_bspline, ShapeFunction::gimp}) {
    const std::string problem = "UL block on UL incline, " + std::string(name_of(shape)) + ", ";
    for (const auto& [degrees, mu, height] : {std::tuple{5., 0., 0.5},
                                              {30., 0., 0.5},
                                              {30., 0.3, 0.5},
                                              {45., 0.3, 0.5},
                                              {45., 0.6, 0.5},
                                              {15., 0.1, 0.5},
                                              {45., 0.8, 0.25}}) {
      Incline incline = on(degrees, mu, shape);
      incline.height = height;
      const Slide s = slide(incline);
      const std::string name = problem + incline.numbers() + ": ";
      validate_near(name + "speed / that without friction", incline.exact(), s.speed, mu > 0.7 ? 0.02 : 0.015,
                    mu > 0.7 ? "Coulomb; where it rings it sticks now and then" : "Coulomb");
      validate_near(name + "normal force / weight", 1, s.force, 0.05, "the block rings on the slab");
      validate_near(name + "error of the energy / largest", 0, s.balance, 0.02, "all that is lost is counted");
    }
    for (const auto& [degrees, mu, height] :
         {std::tuple{30., 0.7, 0.5}, {5., 0.2, 0.5}, {30., 1., 0.25}, {40., 1., 0.25}}) {
      Incline incline = on(degrees, mu, shape);
      incline.height = height;
      incline.end = 1;
      validate_near(problem + incline.numbers() + ": creep / free slide", 0, slide(incline).crept, 0.01,
                    "sticks: mean speed from 0.5 to 1 s");
    }
    Incline high = on(40, 1, shape);
    high.end = 1;
    const std::string name = problem + high.numbers() + ", a higher block: ";
    validate_within(name + "creep / free slide", -0.01, 0.1, slide(high).crept,
                    "its rear lifts off: it rocks, and slips a little each time");
    high.damping = 0.02;
    validate_near(name + "the same, with damping of 0.02", 0, slide(high).crept, 0.01,
                  "no more where the rocking dies away");
  }
}

/// A stiff disk on an inclined slab. Rolls where tan < 3 mu, else slides.
TEST(GridContactRolling, OfADiskIsThatOfARigidOne) {
  const double g = 9.81, end = 0.5, R = 0.5, floor = 0.25;
  for (const auto& [degrees, mu] :
       {std::pair{5., 0.2}, {15., 0.5}, {30., 0.7}, {45., 1.}, {15., 0.05}, {30., 0.1}, {45., 0.2}}) {
    Model model =
        test::empty_model({0, 0, 0}, {5, 1.75, 0}, 0.03125, {Condition::free, Condition::free, Condition::fixed});
    test::seed_body(model, "slab", NeoHookean{{1000, 1e7, 0.3}}, 2, [&](const Vec3& X) { return X[1] < floor; });
    test::seed_body(model, "disk", NeoHookean{{1000, 1e7, 0.3}}, 2,
                    [&](const Vec3& X) { return std::hypot(X[0] - 1, X[1] - floor - R) < R; });
    model.bodies[1].boundary = prism_mesh(circle_outline({1, floor + R}, R, 3e-5), 0.1);
    for (Body& body : model.bodies) body.formulation = Formulation::updated_lagrangian;
    model.contact.method = ContactMethod::grid;
    model.contact.friction = mu;
    RecordingSink sink;
    const RunReport report =
        run(model, options_of(on(degrees, mu, ShapeFunction::gimp)), output(end, end / 10), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    double mass = 0, momentum = 0;
    for (std::size_t i = model.bodies[1].begin; i < model.bodies[1].end; ++i) {
      mass += model.particles.mass[i];
      momentum += model.particles.mass[i] * model.particles.velocity[i][0];
    }
    const double angle = degrees * pi / 180;
    const bool rolls = std::tan(angle) < 3 * mu;
    const double a = rolls ? 2.0 / 3 * g * std::sin(angle) : g * (std::sin(angle) - mu * std::cos(angle));
    validate_near(
        "UL disk on UL incline, " + on(degrees, mu, ShapeFunction::gimp).numbers() + ": acceleration / exact", 1,
        momentum / mass / (a * (end - kRamp / 2)), degrees < 10 ? 0.06 : 0.03,
        rolls ? degrees < 10 ? "rolls: 2/3 g sin; what is left of facets resists by 0.003 g" : "rolls: 2/3 g sin"
              : "slides: g (sin - mu cos)");
  }
}

}  // namespace
}  // namespace scarp

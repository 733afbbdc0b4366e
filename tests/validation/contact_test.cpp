// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bodies that meet (method.md 1.3 and section 3).
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

Rebound rebound(int n, double courant) {
  Model model = test::two_disks(n, Formulation::total_lagrangian);
  model.contact.method = ContactMethod::penalty;
  return test::rebound(std::move(model), solver(3.5, {0, 0, 0}, courant));
}

TEST(ContactDisks, ReboundWithinThePublishedBands) {
  for (int n : {40, 80}) {
    const Rebound r = rebound(n, 0.2);
    ASSERT_FALSE(r.report.failed) << r.report.failure.what;
    const std::string name = "TL disks in contact, " + std::to_string(n) + " cells: ";
    validate_near(name + "least kinetic energy / initial", 0.058, r.least, 0.006,
                  "limit of the mesh of unrelated codes");
    validate_near(name + "its time, s", 2.09, r.time_of_least, 0.02, "the same");
    validate_near(name + "largest strain energy, springs included / initial", 0.938, r.most_stored, 0.01, "the same");
    validate_near(name + "mean kinetic energy after parting / initial", 0.89, r.after, 0.02,
                  "the same; the rest is vibration");
    validate_near(name + "time when 99.5 % of the impulse has passed, s", 2.59, r.parted, 0.02,
                  "separation; their rims, which vibrate, patter");
    validate_near(name + "momentum / that of one disk", 0, r.drift, 1e-12, "forces in pairs; rounding");
    validate_near(name + "largest error of the total energy / initial", 0,
                  r.report.largest_energy_error / r.report.first.total, 0.02, "springs and laws are elastic");
  }
}

TEST(ContactDisks, HoldWithHalfAndTwiceTheStep) {
  const Rebound r = rebound(40, 0.2);
  for (double courant : {0.1, 0.4}) {
    const Rebound other = rebound(40, courant);
    ASSERT_FALSE(other.report.failed) << other.report.failure.what;
    const std::string name = std::string("TL disks in contact, ") + (courant < 0.2 ? "half" : "twice") + " the step: ";
    validate_near(name + "change of the least kinetic energy / initial", 0, other.least - r.least, 0.005,
                  "the step is not part of the model");
    validate_near(name + "change of its time, s", 0, other.time_of_least - r.time_of_least, 0.01, "the same");
    validate_near(name + "change of the kinetic energy after parting / initial", 0, other.after - r.after, 0.01,
                  "the same");
    validate_near(name + "largest error of the total energy / initial", 0,
                  other.report.largest_energy_error / other.report.first.total, 0.02, "springs and laws are elastic");
  }
}

TEST(ContactIncline, SlidesAndSticksAfterCoulomb) {
  const auto on = [](double degrees, double mu, double height) {
    return Incline{.degrees = degrees, .mu = mu, .height = height};
  };
  for (const Incline& incline : {on(5, 0, 0.5), on(30, 0, 0.5), on(30, 0.3, 0.5), on(45, 0.3, 0.5), on(45, 0.6, 0.5),
                                 on(15, 0.1, 0.5), on(45, 0.6, 0.25), on(45, 0.8, 0.25)}) {
    const Slide s = slide(incline);
    const std::string name = "TL block on TL incline, " + incline.numbers() + ": ";
    validate_near(name + "speed / that without friction", incline.exact(), s.speed, 0.015, "Coulomb");
    validate_near(name + "error of the energy / largest", 0, s.balance, 0.02, "all that is lost is counted");
  }
  for (const Incline& incline : {on(30, 0.7, 0.5), on(5, 0.2, 0.5), on(40, 1, 0.5), on(5, 1, 0.25), on(30, 1, 0.25),
                                 on(40, 1, 0.25), on(45, 1.2, 0.25)})
    validate_near("TL block on TL incline, " + incline.numbers() + ": creep / free slide", 0, slide(incline).speed,
                  0.01, "sticks; what is left is the swing of block and springs");
}

/// A stiff disk on an inclined slab. Rolls where tan < 3 mu, else slides.
TEST(ContactRolling, OfADiskIsThatOfARigidOne) {
  const double g = 9.81, end = 0.5, R = 0.5;
  for (const auto& [degrees, mu] :
       {std::pair{5., 0.2}, {15., 0.5}, {30., 0.7}, {45., 1.}, {15., 0.05}, {30., 0.1}, {45., 0.2}}) {
    const double angle = degrees * pi / 180;
    Model model =
        test::empty_model({0, 0, 0}, {5, 1.75, 0}, 0.03125, {Condition::free, Condition::free, Condition::fixed});
    const double floor = 0.25;
    test::seed_body(model, "slab", NeoHookean{{1000, 1e7, 0.3}}, 2, [&](const Vec3& X) { return X[1] < floor; });
    test::seed_body(model, "disk", NeoHookean{{1000, 1e7, 0.3}}, 2,
                    [&](const Vec3& X) { return std::hypot(X[0] - 1, X[1] - floor - R) < R; });
    model.bodies[1].boundary = prism_mesh(circle_outline({1, floor + R}, R, 3e-5), 0.1);
    model.contact.method = ContactMethod::penalty;
    model.contact.friction = mu;
    SolverOptions options = solver(end, {g * std::sin(angle), -g * std::cos(angle), 0});
    options.gravity_ramp = kRamp;
    RecordingSink sink;
    const RunReport report = run(model, options, output(end, end / 10), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    double mass = 0;
    Vec3 momentum{0, 0, 0}, centre{0, 0, 0};
    const Particles& p = model.particles;
    for (std::size_t i = model.bodies[1].begin; i < model.bodies[1].end; ++i) {
      mass += p.mass[i];
      momentum = momentum + p.mass[i] * p.velocity[i];
      centre = centre + p.mass[i] * p.position[i];
    }
    centre = (1 / mass) * centre;
    double spin = 0, inertia = 0;
    for (std::size_t i = model.bodies[1].begin; i < model.bodies[1].end; ++i) {
      const Vec3 r = p.position[i] - centre;
      spin -= p.mass[i] * cross(r, p.velocity[i])[2];
      inertia += p.mass[i] * dot(r, r);
    }
    const bool rolls = std::tan(angle) < 3 * mu;
    const double a = rolls ? 2.0 / 3 * g * std::sin(angle) : g * (std::sin(angle) - mu * std::cos(angle));
    const double turning = rolls ? a / R : 2 * mu * g * std::cos(angle) / R;
    const std::string name = "TL disk on TL incline, " + std::to_string(degrees).substr(0, degrees < 10 ? 1 : 2) +
                             " degrees, mu = " + std::to_string(mu).substr(0, mu < 0.1 ? 4 : 3) + ": ";
    validate_near(name + "acceleration / exact", 1, momentum[0] / mass / (a * (end - kRamp / 2)), rolls ? 0.02 : 0.01,
                  rolls ? "rolls: 2/3 g sin; it sways on its springs" : "slides: g (sin - mu cos)");
    // The points of a rim are a spacing apart, so that what they bear stands off the middle by a tenth of that.
    validate_near(name + "spin / exact", 1, spin / inertia / (turning * (end - kRamp / 2)),
                  rolls ? 0.02 : 0.1 / 64 / (mu * R), "of the same motion");
  }
}

}  // namespace
}  // namespace scarp

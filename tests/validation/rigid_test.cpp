// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rigid bodies that carry nodes of bodies which deform, or meet them and each other by their surfaces, against closed
// forms and the balances of momentum and energy.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <tuple>

#include "tests/support/incline.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using test::Incline;
using test::output;
using test::RecordingSink;
using test::Slide;
using test::slide;
using test::solver;
using test::validate_near;

RigidOptions given(const RigidSurface& surface) {
  RigidOptions options;
  options.motion = RigidMotion::given;
  options.surface = surface;
  return options;
}

double mean_force(const RecordingSink& sink, std::size_t body, int axis, double from, double to) {
  double sum = 0, time = 0, last = 0;
  for (const HistorySample& s : sink.samples) {
    if (s.time > from && s.time <= to) {
      sum += (s.time - last) * s.contact_force[body][axis];
      time += s.time - last;
    }
    last = s.time;
  }
  return sum / time;
}

/// A bar of 4 m between rollers whose end a rigid body suddenly moves with v: a P-wave of stress rho c v runs in.
struct Pulled {
  double force = 0;    ///< / rho c v A
  double work = 0;     ///< / force v t
  double balance = 0;  ///< / work
};
Pulled pull(Formulation formulation, BackEnd form, const RigidSurface& surface, double v) {
  const LinearElastic law{{1000, 1e6, 0.3}};
  const double c = std::sqrt(1e6 * 0.7 / (1.3 * 0.4) / 1000);
  Model model = test::empty_model({0, 0, 0}, {6, 0.25, 0}, 0.0625,
                                  {Condition::free, Condition::free, Condition::roller, Condition::roller});
  test::seed_body(model, "bar", law, 2, [](const Vec3& X) { return X[0] > 1 && X[0] < 5; });
  model.bodies[0].formulation = formulation;
  RigidOptions options = given(surface);
  if (formulation == Formulation::total_lagrangian) options.grips = {"bar"};
  test::seed_rigid_box(model, "jaw", {{0.5, 0, 0}, {1, 0.25, 0}}, options, {v, 0, 0});
  SolverOptions run_options = solver(0.1, {0, 0, 0}, 0.4, ShapeFunction::linear);
  run_options.back_end = form;
  RecordingSink sink;
  const RunReport report = run(model, run_options, output(0.05, 0.001), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  const double force = 1000 * c * v * 0.25, end = sink.samples.back().time;
  return {-mean_force(sink, 1, 0, 0.02, end) / force, report.last.external / (force * v * end),
          report.largest_energy_error / report.last.external};
}

TEST(RigidCarrier, SendsAWaveIntoABar) {
  const auto check = [](const std::string& name, const Pulled& p) {
    validate_near(name + "force / rho c v A", 1, p.force, 0.02, "P-wave, before it comes back");
    validate_near(name + "external work / (force v t)", 1, p.work, 0.03, "the first step's blow is not in it");
    validate_near(name + "balance of energy / external work", 0, p.balance, 0.02, "all that it gives is counted");
  };
  const RigidSurface rough{true, 0}, smooth{false, 0};
  check("rigid grip on a TL bar: ", pull(Formulation::total_lagrangian, BackEnd::nodal, rough, -0.1));
  check("rigid grip on a TL bar, particle state: ",
        pull(Formulation::total_lagrangian, BackEnd::particle_state, rough, -0.1));
  check("rough rigid body pulls a UL bar: ", pull(Formulation::updated_lagrangian, BackEnd::nodal, rough, -0.1));
  check("smooth rigid body pushes a UL bar: ", pull(Formulation::updated_lagrangian, BackEnd::nodal, smooth, 0.1));
}

/// A UL column between rollers, pressed slowly by a piston that goes through several cells: the force at the end /
/// closed form, and the error of the energy / external work.
std::pair<double, double> pressed_column(ShapeFunction shape, double cell) {
  const double height = 2, E = 1e5, nu = 0.25, M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), end = 2;
  Model model =
      test::empty_model({0, 0, 0}, {0.5, 3, 0}, cell, {Condition::roller, Condition::roller, Condition::roller});
  test::seed_body(model, "column", Hencky{{1000, E, nu}}, 3, [&](const Vec3& X) { return X[1] < height; });
  model.bodies[0].formulation = Formulation::updated_lagrangian;
  RigidOptions options = given({false, 0});
  options.table = {{0, 0}, {0.5, 1}, {1.5, 1}, {2, 0}};
  test::seed_rigid_box(model, "piston", {{0, height, 0}, {0.5, 2.5, 0}}, options, {0, -0.4, 0});
  SolverOptions run_options = solver(end, {0, 0, 0}, 0.4, shape);
  run_options.damping = 0.1;
  RecordingSink sink;
  const RunReport report = run(model, run_options, output(0.1, 0.01), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  const double stretch = 1 - 0.4 * 1.5 / height, force = -M * std::log(stretch) / stretch * 0.5;
  return {mean_force(sink, 1, 1, 1.9, end) / force, report.largest_energy_error / report.last.external};
}

TEST(RigidCarrier, PressesAColumnThroughCells) {
  for (const auto& [name, shape] :
       {std::pair{"GIMP", ShapeFunction::gimp}, {"B-spline", ShapeFunction::quadratic_bspline}}) {
    const auto [coarse, balance] = pressed_column(shape, 0.125);
    const double fine = pressed_column(shape, 0.0625).first;
    const std::string row = std::string("rigid piston on a UL column, ") + name + ", 30 %: ";
    validate_near(
        row + "force at the end / closed form", 1, coarse, 0.1,
        "Hencky, confined: M ln(stretch) / stretch; nodes know the piston to half a cell, a tenth of its way");
    validate_near(row + "the same with half the cell", 1, fine, 0.05, "half of that");
    validate_near(row + "balance of energy / external work", 0, balance, 0.02,
                  "piston, damping and impact are counted");
  }
}

/// A floor drags a block along: Coulomb's force until the block has its velocity.
TEST(RigidCarrier, DragsABlockAsCoulombSays) {
  const double g = 9.81, mu = 0.25, v = 1;
  for (const double degrees : {0.0, 20.0}) {
    Model model = test::empty_model({0, 0, 0}, {6, 4, 0}, 0.125);
    const double a = degrees * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
    // Along and across a floor through (3, 1.03), which lies askew in the lattice.
    const auto frame = [=](const Vec3& X) {
      return Vec3{(X[0] - 3) * c + (X[1] - 1.03) * s, -(X[0] - 3) * s + (X[1] - 1.03) * c, 0};
    };
    test::seed_body(model, "block", NeoHookean{{1000, 2e6, 0.3}}, 3, [&](const Vec3& X) {
      const Vec3 Y = frame(X);
      return std::abs(Y[0]) < 0.75 && Y[1] > 0.03 && Y[1] < 0.6;
    });
    model.bodies[0].formulation = Formulation::updated_lagrangian;
    test::seed_rigid_box(model, "floor", {{0, 0.5, 0}, {6, 1.03, 0}}, given({false, mu}), {v * c, v * s, 0});
    const auto place = [=](double along, double across) {
      return Vec2{3 + along * c - across * s, 1.03 + along * s + across * c};
    };
    model.bodies[1].boundary = prism_mesh({place(-3, -0.4), place(3, -0.4), place(3, 0), place(-3, 0)}, 1);
    SolverOptions options = solver(0.7, {g * s, -g * c, 0}, 0.3, ShapeFunction::gimp);
    options.gravity = Vec3{g * s, -g * c, 0};  // straight into the floor
    options.gravity_ramp = 0.1;
    RecordingSink sink;
    const RunReport report = run(model, options, output(0.1, 0.005), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    double mass = 0;
    for (std::size_t p = 0; p < model.bodies[0].end; ++p) mass += model.particles.mass[p];
    const auto along = [&](const HistorySample& sample) {
      return (sample.momentum[0] * c + sample.momentum[1] * s) / mass;
    };
    Vec3 impulse{0, 0, 0};
    double last = 0;
    for (const HistorySample& sample : sink.samples) {
      if (sample.time > 0.25 + 1e-9) break;
      impulse = impulse - (sample.time - last) * sample.contact_force[1];
      last = sample.time;
    }
    const std::string row =
        "rigid floor drags a UL block, " + std::to_string(static_cast<int>(degrees)) + " degrees askew: ";
    validate_near(row + "impulse along / across in 0.25 s", mu,
                  (impulse[0] * c + impulse[1] * s) / (impulse[1] * c - impulse[0] * s), 0.01,
                  "Coulomb, while it slides");
    validate_near(row + "velocity after 0.7 s / floor's", 1, along(sink.samples.back()) / v, 0.03, "then it sticks");
    validate_near(row + "balance of energy / external work", 0, report.largest_energy_error / report.last.external,
                  0.05, "floor's work and friction are counted");
  }
}

RigidOptions rigid(RigidMotion motion, const RigidSurface& surface) {
  RigidOptions options;
  options.motion = motion;
  options.surface = surface;
  return options;
}

/// An elastic ball of 0.4 m, of particles 0.05 m apart, thrown at a wall of 0.01 m.
struct Thrown {
  double behind = 0;   ///< particles
  double impulse = 0;  ///< error of the wall's / momentum lost
  double after = 0;    ///< speed / before
  double balance = 0;
};
Thrown throw_at_wall(double speed, double courant, double askew) {
  Model model = test::empty_model({0, 0, 0}, {2, 1, 1}, 0.1);
  test::seed_body(
      model, "boulder", NeoHookean{{2500, 2e7, 0.25}}, 2,
      [](const Vec3& X) {
        return norm(X - Vec3{0.5, 0.5, 0.5}) < 0.2;
      },
      [&](const Vec3&) {
        return Vec3{speed, 0, 0};
      });
  model.bodies[0].boundary = sphere_mesh({0.5, 0.5, 0.5}, 0.2, 0.0005);
  test::seed_rigid_box(model, "wall", {{0.8, 0, 0}, {0.9, 1, 1}}, rigid(RigidMotion::fixed, {false, 0.3}), {0, 0, 0});
  TriangleMesh wall = box_mesh({{0.8, -0.5, -0.5}, {0.81, 1.5, 1.5}});
  const double c = std::cos(askew), s = std::sin(askew);
  for (Vec3& v : wall.vertices)
    v = {0.8 + (v[0] - 0.8) * c - (v[1] - 0.5) * s, 0.5 + (v[0] - 0.8) * s + (v[1] - 0.5) * c, v[2]};
  model.bodies[1].boundary = wall;
  model.contact.method = ContactMethod::penalty;
  RecordingSink sink;
  const double time = 0.3 / speed + 0.02;
  const RunReport report = run(model, solver(time, {0, 0, 0}, courant), output(time / 4, time / 40), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  Thrown result;
  for (std::size_t p = 0; p < model.bodies[0].end; ++p) {
    const Vec3& x = model.particles.position[p];
    result.behind += (x[0] - 0.8) * c + (x[1] - 0.5) * s > 0;
  }
  Vec3 impulse{0, 0, 0};
  double last = 0;
  for (const HistorySample& sample : sink.samples) {
    impulse = impulse + (sample.time - last) * sample.contact_force[1];
    last = sample.time;
  }
  const Vec3 lost = report.first.momentum - report.last.momentum;
  result.impulse = norm(impulse - lost) / norm(lost);
  result.after = norm(report.last.momentum) / norm(report.first.momentum);
  result.balance = report.largest_energy_error / report.first.total;
  return result;
}

TEST(RigidWall, LetsNoBoulderThrough) {
  // Waves run at 98 m/s: the last is a blow at half of that.
  for (const auto& [speed, courant, askew] :
       {std::tuple{1.0, 0.4, 0.0}, {10.0, 0.1, 0.0}, {10.0, 0.4, 0.3}, {10.0, 1.0, 0.3}, {50.0, 1.0, 0.0}}) {
    const Thrown t = throw_at_wall(speed, courant, askew);
    char name[120];
    std::snprintf(name, sizeof name,
                  "boulder on a wall of a tenth of a cell%s, %g m/s, courant %g: ", askew > 0 ? ", askew" : "", speed,
                  courant);
    validate_near(name + std::string("particles behind it"), 0, t.behind, 0, "does not go through");
    validate_near(name + std::string("wall's impulse less momentum lost / that"), 0, t.impulse, 0.01,
                  "the force history is the blow");
    if (courant > 0.4) continue;  // whether it holds at all, not how well
    validate_near(name + std::string("balance of energy / initial"), 0, t.balance, courant < 0.2 ? 0.02 : 0.05,
                  "springs and law are elastic; an error of the first order in the step");
  }
}

/// A ball (disk) on a slope, both rigid: rolls where tan < 7/2 mu (3 mu), else slides.
TEST(RigidBall, RollsAndSlidesDownASlope) {
  const double g = 9.81, R = 0.5, end = 0.5;
  for (int dimension : {2, 3})
    for (const auto& [degrees, mu] : {std::pair{10., 0.5}, {45., 1.}, {30., 0.1}, {45., 0.2}}) {
      const double angle = degrees * std::numbers::pi / 180, deep = dimension == 3 ? 2 : 0;
      Model model = test::empty_model({0, 0, 0}, {6, 2, deep}, 0.25);
      const double middle = 0.5 * deep;
      test::seed_rigid_box(model, "ball", {{0.5, 0.5, std::max(0.0, middle - R)}, {1.5, 1.5, middle + R}},
                           rigid(RigidMotion::free, {false, mu}), {0, 0, 0});
      model.bodies[0].ball_radius = R;
      model.bodies[0].boundary = dimension == 3 ? sphere_mesh({1, 0.25 + R, middle}, R, 0.01)
                                                : prism_mesh(circle_outline({1, 0.25 + R}, R, 0.01), 1);
      test::seed_rigid_box(model, "slope", {{0, 0, 0}, {6, 0.25, deep}}, rigid(RigidMotion::fixed, {true, 0}),
                           {0, 0, 0});
      model.contact.method = ContactMethod::penalty;
      SolverOptions options = solver(end, {g * std::sin(angle), -g * std::cos(angle), 0}, 0.2);
      options.gravity_ramp = 0.1;
      RecordingSink sink;
      const RunReport report = run(model, options, output(end, end / 10), sink, 1);
      ASSERT_FALSE(report.failed) << report.failure.what;
      const double share = dimension == 3 ? 0.4 : 0.5;  // of m R^2
      const double density = 2500, mass = density * (dimension == 3 ? 4.0 / 3 * std::numbers::pi * R * R * R
                                                                    : std::numbers::pi * R * R);
      const bool rolls = std::tan(angle) < (1 + 1 / share) * mu;
      const double a = rolls ? g * std::sin(angle) / (1 + share) : g * (std::sin(angle) - mu * std::cos(angle));
      const double turning = rolls ? a / R : mu * g * std::cos(angle) / (share * R);
      // About the first centre: the spin, and the path's moment, whose arm is what the springs give.
      const HistorySample& last = report.last;
      const Vec3 arm = last.centre - report.first.centre;
      const double spin = -(last.angular_momentum[2] - cross(arm, last.momentum)[2]) / (share * mass * R * R);
      char name[100];
      std::snprintf(name, sizeof name,
                    "rigid %s on a rigid slope, %g degrees, mu = %g: ", dimension == 3 ? "ball" : "disk", degrees, mu);
      validate_near(name + std::string("acceleration / exact"), 1, last.momentum[0] / mass / (a * (end - 0.05)), 0.005,
                    rolls ? dimension == 3 ? "rolls: 5/7 g sin" : "rolls: 2/3 g sin" : "slides: g (sin - mu cos)");
      validate_near(name + std::string("spin / exact"), 1, spin / (turning * (end - 0.05)), 0.01, "of the same motion");
    }
}

/// A deformable block on a rigid ramp that lies askew in the lattice.
TEST(RigidRamp, ABlockSlidesAndSticksAfterCoulomb) {
  using enum Formulation;
  const auto check = [](const std::string& name, const Incline& on) {
    const Slide s = slide(on);
    // An updated-Lagrangian block rings after its weight has come: its mean speed counts.
    validate_near(name + on.numbers() + ": speed / that without friction", on.exact(),
                  on.block == updated_lagrangian ? s.crept : s.speed, on.sticks() ? 0.01 : 0.015,
                  on.sticks() ? "sticks" : "Coulomb");
    validate_near(name + on.numbers() + ": error of the energy / largest", 0, s.balance,
                  on.block == updated_lagrangian ? 0.1 : 0.02,
                  on.block == updated_lagrangian ? "forces on particles do work on nodes, whose motion is not theirs"
                                                 : "all that is lost is counted");
  };
  for (const auto& [degrees, mu, height] : {std::tuple{30., 0., 0.5},
                                            {30., 0.3, 0.5},
                                            {30., 0.7, 0.5},
                                            {5., 0.2, 0.25},
                                            {15., 0.1, 0.25},
                                            {30., 1., 0.25},
                                            {40., 1., 0.25},
                                            {45., 0.3, 0.25},
                                            {45., 0.6, 0.25},
                                            {45., 0.8, 0.25}}) {
    const Incline on{.degrees = degrees, .mu = mu, .slab = rigid, .height = height};
    check("TL block on a rigid slab, 2D, ", on);
    Incline updated = on;
    updated.block = updated_lagrangian;
    updated.shape = ShapeFunction::gimp;
    check("UL block on a rigid slab, springs, ", updated);
  }
  check("TL block on a rigid slab, 3D, ", {.degrees = 30, .mu = 0.3, .slab = rigid, .dimension = 3});
}

}  // namespace
}  // namespace scarp

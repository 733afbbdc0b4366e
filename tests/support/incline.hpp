// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A block on an inclined slab, in the slab's frame: x down the slope, y out of it.
//
// Friction of mu N at the base turns the block: N stands mu height / 2 before its middle. Beyond a sixth of its length,
// mu > 0.67 for a block half as high as long, its rear lifts off, and an elastic one rocks, hops and slips a little
// each time, by any method and whatever the step. One a quarter as high stays flat.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "solver/core/run.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/rigid_seed.hpp"
#include "tests/support/run_options.hpp"

namespace scarp::test {

struct Incline {
  double degrees = 0, mu = 0;
  ContactMethod method = ContactMethod::penalty;
  Formulation block = Formulation::total_lagrangian;
  Formulation slab = Formulation::total_lagrangian;  ///< its base is held; or rigid
  ShapeFunction shape = ShapeFunction::linear;
  int dimension = 2;
  double end = 0.5;  ///< s
  double damping = 0;
  double courant = SolverOptions{}.courant;
  double height = 0.5;  ///< of the block, m; it is 1 m long

  double angle() const { return degrees * std::numbers::pi / 180; }
  bool sticks() const { return mu > std::tan(angle()); }
  /// Speed over that without friction, after Coulomb.
  double exact() const { return sticks() ? 0 : 1 - mu / std::tan(angle()); }
  std::string numbers() const {
    char text[64];
    std::snprintf(text, sizeof text, "%g degrees, mu = %g", degrees, mu);
    return text;
  }
};

/// Weight comes over this time, s, so that nothing bounces: an impulse of half as much.
inline constexpr double kRamp = 0.2;

inline SolverOptions options_of(const Incline& on) {
  const double g = 9.81;
  SolverOptions options =
      solver(on.end, {g * std::sin(on.angle()), -g * std::cos(on.angle()), 0}, on.courant, on.shape);
  options.gravity_ramp = kRamp;
  options.damping = on.damping;
  return options;
}

struct Slide {
  double speed = 0;    ///< of the block at the end / that without friction
  double crept = 0;    ///< in the mean of the second half, likewise; of an updated-Lagrangian block
  double force = 0;    ///< normal force in the second half / weight
  double balance = 0;  ///< error of the energy / largest
};

inline Slide slide(const Incline& on) {
  const double deep = on.dimension == 3 ? 0.5 : 0;
  const bool rigid = on.slab == Formulation::rigid;
  Model model = empty_model({0, 0, 0}, {4, 1.25, deep}, 0.125,
                            {Condition::free, Condition::free, rigid ? Condition::free : Condition::fixed});
  const NeoHookean law{{1000, 1e6, 0.3}};
  if (rigid) {
    RigidOptions slab;
    slab.surface = {false, on.mu};
    seed_rigid_box(model, "slab", {{0, 0, 0}, {4, 0.375, deep}}, slab, {0, 0, 0});
  } else {
    seed_body(model, "slab", law, 2, [](const Vec3& X) { return X[1] < 0.375; });
    model.bodies[0].formulation = on.slab;
  }
  seed_body(model, "block", law, 2,
            [&on](const Vec3& X) { return X[0] > 0.5 && X[0] < 1.5 && X[1] > 0.375 && X[1] < 0.375 + on.height; });
  model.bodies[1].formulation = on.block;
  model.contact.method = on.method;
  if (!rigid) model.contact.friction = on.mu;
  const Body& block = model.bodies[1];
  double mass = 0;
  for (std::size_t p = block.begin; p < block.end; ++p) mass += model.particles.mass[p];
  const auto mean_of = [&](const Model& now, std::vector<Vec3> Particles::*field) {
    double sum = 0;
    for (std::size_t p = block.begin; p < block.end; ++p) sum += now.particles.mass[p] * (now.particles.*field)[p][0];
    return sum / mass;
  };
  RecordingSink sink;
  std::vector<double> x;
  if (on.block == Formulation::updated_lagrangian)
    sink.on_frame = [&](const Model& now, double) { x.push_back(mean_of(now, &Particles::position)); };
  const SolverOptions options = options_of(on);
  const RunReport report = run(model, options, output(on.end / 2, on.end / 50), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  const Vec3 g = *options.gravity;
  Slide s;
  s.speed = mean_of(model, &Particles::velocity) / (g[0] * (on.end - kRamp / 2));
  if (x.size() == 3) s.crept = (x[2] - x[1]) / (on.end / 2) / (g[0] * (0.75 * on.end - kRamp / 2));
  double count = 0;
  for (const HistorySample& sample : sink.samples) {
    if (sample.time < 0.5 * on.end) continue;
    s.force += sample.contact_force[1][1] / (mass * -g[1]);
    ++count;
  }
  s.force /= count;
  s.balance = report.largest_energy_error / report.largest_energy;
  return s;
}

}  // namespace scarp::test

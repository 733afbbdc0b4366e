// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Volumetric locking, shown and cured, at Prandtl's strip footing on soil without friction: its collapse load is
// (2 + pi) c per width, and the plastic flow keeps the volume.
#include <gtest/gtest.h>

#include <numbers>

#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using test::validate_near;
using test::validate_within;

struct Footing {
  double load = 0;  ///< at a settlement of `kDepth`, per width and cohesion
  double rise = 0;  ///< of the load between 0.6 kDepth and kDepth, as a share of it: 0 at collapse
};

constexpr double kDepth = 0.1;  ///< of half the width

/// Half of a smooth footing of half width 1, pressed down slowly. The nodes under it carry the ground half a cell
/// beyond its edge too.
Footing footing(int points, AntiLocking anti_locking) {
  const double h = 0.25, c = 10e3;
  const Condition roller = Condition::roller;
  Model model = test::empty_model({0, 0, 0}, {5, 2.5, 0}, h, {roller, roller, Condition::fixed, Condition::free});
  const MohrCoulomb clay{{1000, 1000 * c, 0.3}, c, 0, 0};
  test::seed_body(model, "ground", clay, points, test::everywhere);
  const double wave = clay.wave_speed(), speed = 5e-4 * wave;
  LoadOptions load;
  load.where.box = {{-0.01, 2.49, 0}, {1.01, 2.51, 0}};
  load.velocity = Vec3{0, -speed, 0};
  load.axes = "y";
  load.table = {{0, 0}, {10 / wave, 1}};
  model.loads.push_back(load);
  SolverOptions options;
  options.gravity = Vec3{0, 0, 0};
  options.end_time = kDepth / speed;
  options.courant = 0.8;
  options.damping = 0.2;
  options.anti_locking = anti_locking;
  OutputOptions output;
  output.every = options.end_time;
  output.history_every = options.end_time / 20;
  test::RecordingSink sink;
  const RunReport report = run(model, options, output, sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  const auto at = [&](std::size_t i) {
    const HistorySample &a = sink.samples[i - 1], &b = sink.samples[i];
    return (b.external - a.external) / (b.time - a.time) / speed / (c * (1 + h / 2));
  };
  return {at(20), (at(20) - at(12)) / at(20)};
}

TEST(Footing, LocksWithoutAndCollapsesAtPrandtlsLoadWithFBar) {
  const double exact = 2 + std::numbers::pi;
  for (int n : {2, 3}) {
    const std::string name = "strip footing, " + std::to_string(n) + " x " + std::to_string(n) + ": ";
    const Footing locked = footing(n, AntiLocking::none), free = footing(n, AntiLocking::f_bar);
    validate_near(name + "load / c, f-bar", exact, free.load, 0.04 * exact,
                  "upper bound, 4 cells under half the footing; it sinks by a tenth of that");
    validate_within(name + "rise of the load over the last two fifths, f-bar", 0, 0.05, free.rise,
                    "collapse, but for the ground that wells up beside it");
    validate_within(name + "load / c, none", 1.2 * exact, 2 * exact, locked.load, "locks: a quarter too much");
    validate_within(name + "rise of the load, none / f-bar", 2, 10, locked.rise / free.rise, "it never collapses");
  }
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the transfers between particles and nodes keep and what they take: FLIP, PIC and their blend by a rate, APIC,
// XPIC.
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

/// The first mode of a fixed-free bar in so few cells that the transfers differ. Linear functions, two particles per
/// cell and axis: a round trip from the nodes to the particles and back, S+ S, leaves lambda = 1 - 3/8 (1 - cos k h) of
/// a wave of number k. A transfer that leaves q of the velocity per step leaves sqrt(q) of the amplitude.
struct Bar {
  static constexpr int cells = 4, periods = 10;
  static constexpr double length = 1, speed = 10, v0 = 1e-3, period = 4 * length / speed;

  static double lambda() { return 1 - 3.0 / 8 * (1 - std::cos(pi / (2 * cells))); }

  /// Amplitude of the last period / that of the first, and the steps between them.
  static std::pair<double, double> swing(const SolverOptions& options) {
    Model model =
        test::empty_model({0, 0, 0}, {length, length / cells, 0}, length / cells, {kFixed, kFree, kRoller, kRoller});
    test::seed_body(model, "bar", LinearElastic{{1000, 1e5, 0}}, 2, test::everywhere, [](const Vec3& X) {
      return Vec3{v0 * std::sin(pi * X[0] / (2 * length)), 0, 0};
    });
    RecordingSink sink;
    const RunReport report = run(model, options, output(options.end_time, period / 40), sink, 1);
    EXPECT_FALSE(report.failed);
    const double omega = 2 * cells * speed / length * std::sin(pi / (4 * cells)), mass = 1000 * length * length / cells;
    const auto amplitude = [&](std::size_t begin) {
      double sum = 0;
      for (std::size_t i = begin; i < begin + 40; ++i) {
        const double v = sink.samples[i].momentum[0] / mass, u = sink.samples[i].centre[0] - 0.5 * length;
        sum += v * v + omega * omega * u * u;
      }
      return std::sqrt(sum);
    };
    return {amplitude(sink.samples.size() - 40) / amplitude(0), static_cast<double>(report.steps) *
                                                                    static_cast<double>(sink.samples.size() - 40) /
                                                                    static_cast<double>(sink.samples.size() - 1)};
  }
  static SolverOptions options(Transfer transfer, double courant = 0.4) {
    SolverOptions options = solver(periods * period, {0, 0, 0}, courant);
    options.transfer = transfer;
    options.back_end = BackEnd::particle_state;
    return options;
  }
};

TEST(TransferBar, LeavesTheAmplitudeThatTheRoundTripDoes) {
  const auto row = [](const std::string& name, const SolverOptions& options, double q, double tolerance,
                      const std::string& why) {
    const auto [left, steps] = Bar::swing(options);
    validate_near("transfers, bar of 4 cells: amplitude left after 9 periods, " + name, std::pow(q, steps / 2), left,
                  tolerance, why);
  };
  const double lost = 1 - Bar::lambda();
  row("FLIP", Bar::options(Transfer::flip), 1, 0.01,
      "keeps the particles' velocities; the rest is the ripple of leapfrog");
  SolverOptions pic = Bar::options(Transfer::flip);
  pic.flip = 0;
  row("PIC", pic, 1 - lost, 3e-5, "lambda^(n/2), lambda = 1 - 3/8 (1 - cos k h) of a round trip, n steps");
  row("APIC", Bar::options(Transfer::apic), 1, 0.01, "what is linear in a cell passes unchanged");
  for (int order : {2, 3, 5}) {
    SolverOptions xpic = Bar::options(Transfer::xpic);
    xpic.xpic_order = order;
    row("XPIC(" + std::to_string(order) + ")", xpic, 1 - std::pow(lost, order), 0.01,
        "q^(n/2), q = 1 - (1 - lambda)^" + std::to_string(order));
  }
  // A rate r: q = 1 - (1 - exp(-r dt)) (1 - lambda), whose n-th power does not depend on dt.
  const double rate = 15;
  const double expected = std::exp(-0.5 * rate * lost * (Bar::periods - 1) * Bar::period);
  for (double courant : {0.4, 0.2, 0.1}) {
    SolverOptions blend = Bar::options(Transfer::flip, courant);
    blend.pic_rate = rate;
    const auto [left, steps] = Bar::swing(blend);
    validate_near("transfers, bar of 4 cells: amplitude left after 9 periods, PIC rate 15/s, courant " +
                      std::to_string(courant).substr(0, 3),
                  expected, left, 0.02, "exp(-r (1 - lambda) t / 2) for any time step");
  }
}

struct Disk {
  double angular = 0;  ///< largest change / initial
  double left = 0;     ///< angular momentum at the end / initial
  double energy = 0;   ///< total energy at the end / initial
};

/// A disk of 8 cells' radius turns about its centre, its rim at a tenth of the wave speed.
Disk disk(Transfer transfer, double flip, int order, double turns,
          ShapeFunction shape = ShapeFunction::quadratic_bspline) {
  const double radius = 1, rim = 1, c = 10, centre = 1.5;
  Model model = test::empty_model({0, 0, 0}, {3, 3, 0}, radius / 8);
  const double nu = 0.3, E = 1000 * c * c * (1 + nu) * (1 - 2 * nu) / (1 - nu);
  test::seed_body(
      model, "disk", NeoHookean{{1000, E, nu}}, 2,
      [&](const Vec3& X) { return std::hypot(X[0] - centre, X[1] - centre) < radius; },
      [&](const Vec3& X) {
        return Vec3{-rim * (X[1] - centre), rim * (X[0] - centre), 0};
      });
  model.bodies[0].formulation = Formulation::updated_lagrangian;
  const double end = turns * 2 * pi * radius / rim;
  SolverOptions options = solver(end, {0, 0, 0}, 0.4, shape);
  options.transfer = transfer;
  options.flip = flip;
  if (transfer == Transfer::xpic) options.xpic_order = order;
  RecordingSink sink;
  const RunReport report = run(model, options, output(end, end / 100), sink, 1);
  EXPECT_FALSE(report.failed) << report.failure.what;
  Disk d;
  const double L = report.first.angular_momentum[2];
  for (const HistorySample& s : sink.samples) d.angular = std::max(d.angular, std::abs(s.angular_momentum[2] / L - 1));
  d.left = report.last.angular_momentum[2] / L;
  d.energy = report.last.total / report.first.total;
  return d;
}

TEST(TransferDisk, TurnsOn) {
  const std::string name = "transfers, disk of 8 cells' radius: ";
  const Disk apic = disk(Transfer::apic, 1, 0, 5), gimp = disk(Transfer::apic, 1, 0, 1, ShapeFunction::gimp);
  validate_near(name + "largest change of angular momentum over 5 turns / initial, APIC", 0, apic.angular, 1e-10,
                "B-splines: kept by construction; rounding");
  validate_near(name + "energy after 5 turns / initial, APIC", 1, apic.energy, 0.005,
                "a rigid motion passes unchanged; what else there is does in part");
  validate_near(name + "change of angular momentum over a turn / initial, APIC, GIMP", 0, gimp.angular, 1e-3,
                "the spread of the weights varies with the particle's place");
  const Disk flip = disk(Transfer::flip, 1, 0, 1), pic = disk(Transfer::flip, 0, 0, 0.1);
  validate_within(name + "angular momentum left after a turn, FLIP", 0.95, 1, flip.left, "not kept, O(h^2) per turn");
  validate_within(name + "angular momentum left after 0.1 turns, PIC", 0, 0.05, pic.left,
                  "a particle's own spin is lost in each step: h^2 / R^2 of it all");
  double before = pic.left;
  const std::array<std::pair<double, double>, 3> bands{{{0.6, 0.8}, {0.75, 0.87}, {0.82, 0.93}}};
  for (int k = 0; k < 3; ++k) {
    const int order = std::array<int, 3>{2, 3, 5}[k];
    const Disk d = disk(Transfer::xpic, 1, order, 0.1);
    validate_within(name + "angular momentum left after 0.1 turns, XPIC(" + std::to_string(order) + ")", bands[k].first,
                    bands[k].second, d.left,
                    "not kept: lumped maps miss part of the rim's motion, less with the order");
    EXPECT_GT(d.left, before);
    before = d.left;
  }
}

}  // namespace
}  // namespace scarp

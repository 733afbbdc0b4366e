// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Slump of a 45 degree slope of cohesive soil under sudden gravity (Huang et al. 2015; Wyser et al. 2020), against
// the bands of method.md section 3 at h = 1 m.
#include <gtest/gtest.h>

#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using test::validate_near;
using test::validate_within;

TEST(Slump, RunsOutWithinThePublishedBands) {
  Model model = test::empty_model({0, 0, 0}, {110, 35, 0}, 1,
                                  {Condition::roller, Condition::roller, Condition::fixed, Condition::free});
  test::seed_body(model, "slope", MohrCoulomb{{2100, 70e6, 0.3}, 10e3, 20, 0}, 3,
                  [](const Vec3& X) { return X[1] < 15 || X[0] + X[1] < 63.75; });
  validate_near("slump: particles", 21840, static_cast<double>(model.particles.size()), 0, "3 x 3 per cell, exact");
  SolverOptions options;
  options.end_time = 7.2;
  OutputOptions output;
  output.every = 0.36;
  output.history_every = 0.04;
  test::RecordingSink sink;
  const RunReport report = run(model, options, output, sink, 2);
  ASSERT_FALSE(report.failed) << report.failure.what << " at " << report.failure.time;
  const Particles& p = model.particles;
  double front = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.reference_position[i][1] > 15) front = std::max(front, p.position[i][0]);
  double peak = 0, time_of_peak = 0, last_moving = 0;
  for (const HistorySample& s : sink.samples) {
    if (s.kinetic > peak) {
      peak = s.kinetic;
      time_of_peak = s.time;
    }
    if (s.kinetic > 0.01 * report.largest_kinetic) last_moving = s.time;
  }
  const std::string band = "TL, UL and published codes at h = 1 m; no regularisation, so bands";
  validate_within("slump: run-out of the toe, m", 7.5, 13, front - 48.75, band);
  validate_within("slump: drop of the crest, m", 7.5, 9.2, 35 - test::carried(p, {28.75, 35, 0})[1], band);
  validate_within("slump: largest displacement, m", 12, 15.5, report.largest_displacement, band);
  validate_within("slump: time of the kinetic energy's peak, s", 2.1, 2.6, time_of_peak, band);
  validate_within("slump: last time with more than 1 % of the peak kinetic energy, s", 4, 6.5, last_moving,
                  "at rest after 6 to 6.5 s");
  validate_near("slump: energy drift / potential energy released", 0,
                report.largest_energy_error / std::abs(report.last.potential), 0.05, "the plastic work closes the balance");
  std::printf("slump: %lld steps, dt %.2e to %.2e s, peak kinetic %.3e J/m\n", static_cast<long long>(report.steps),
              report.smallest_dt, report.largest_dt, peak);
}

}  // namespace
}  // namespace scarp

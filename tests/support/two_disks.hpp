// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sulsky's disks that run into each other (method.md section 3).
#pragma once

#include <algorithm>

#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"

namespace scarp::test {

/// E = 1000, nu = 0.3, rho = 1000, v = 0.1, in n x n cells.
inline Model two_disks(int n, Formulation formulation) {
  Model model = empty_model({0, 0, 0}, {1, 1, 0}, 1.0 / n);
  const auto add = [&](const char* name, double centre, double v) {
    seed_body(
        model, name, NeoHookean{{1000, 1000, 0.3}}, 2,
        [=](const Vec3& X) { return std::hypot(X[0] - centre, X[1] - centre) < 0.2; },
        [=](const Vec3&) {
          return Vec3{v, v, 0};
        });
    model.bodies.back().formulation = formulation;
    model.bodies.back().boundary = prism_mesh(circle_outline({centre, centre}, 0.2, 1e-5), 1.0 / n);
  };
  add("left", 0.2, 0.1);
  add("right", 0.8, -0.1);
  return model;
}

struct Rebound {
  RunReport report;
  double least = 1, time_of_least = 0;  ///< of the kinetic energy / initial
  double most_stored = 0;               ///< strain energy, springs included / initial kinetic
  double parted = 0;                    ///< when 99.5 % of the impulse between them has passed, s
  double pressed = 0;                   ///< last time with a tenth of the largest force between them, s
  double after = 0;                     ///< mean kinetic energy from 2.6 s on / initial
  double drift = 0;                     ///< of the momentum / that of one disk
};

inline Rebound rebound(Model model, const SolverOptions& options) {
  RecordingSink sink;
  Rebound r;
  r.report = run(model, options, output(0.5, 0.005), sink, 1);
  const double start = r.report.first.kinetic, momentum = start / 0.1;
  double impulse = 0, passed = 0, largest = 0, count = 0;
  for (const HistorySample& s : sink.samples) {
    impulse += norm(s.contact_force[0]);
    largest = std::max(largest, norm(s.contact_force[0]));
  }
  for (const HistorySample& s : sink.samples) {
    if (s.kinetic / start < r.least) {
      r.least = s.kinetic / start;
      r.time_of_least = s.time;
    }
    r.most_stored = std::max(r.most_stored, (s.strain + s.contact) / start);
    if (passed < 0.995 * impulse) r.parted = s.time - 0.0025;  // a mean over 5 ms
    if (norm(s.contact_force[0]) > 0.1 * largest) r.pressed = s.time - 0.0025;
    passed += norm(s.contact_force[0]);
    r.drift = std::max(r.drift, norm(s.momentum) / momentum);
    if (s.time < 2.6) continue;
    r.after += s.kinetic / start;
    ++count;
  }
  r.after /= count;
  return r;
}

}  // namespace scarp::test

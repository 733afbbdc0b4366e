// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Links the solver library and nothing else: a block falls for a tenth of a second and must do so as Galileo says.
#include <cmath>
#include <cstdio>

#include "solver/core/run.hpp"

namespace {

struct Silent : scarp::FrameSink {
  void frame(const scarp::Model&, const scarp::ParticleStates&, double, std::int64_t) override {}
  void sample(const scarp::HistorySample&) override {}
  void progress(double, double, std::int64_t, double) override {}
};

/// A cube of 4 x 4 x 4 cells of 0.25 m with 8 points each, 1000 kg.
scarp::Model block() {
  scarp::Model model;
  scarp::NeoHookean rubber;
  rubber.density = 1000;
  rubber.youngs_modulus = 1e6;
  rubber.poissons_ratio = 0.3;
  model.materials = {{"rubber", rubber}};
  model.domain = {3, 0.25, {0, 0, 0}, {1, 1, 1}, {}};
  constexpr int n = 8;
  scarp::resize_particles(model.particles, n * n * n);
  for (int i = 0; i < n * n * n; ++i) {
    const scarp::Vec3 x{(i % n + 0.5) / n, (i / n % n + 0.5) / n, (i / (n * n) + 0.5) / n};
    model.particles.id[i] = i;
    model.particles.reference_position[i] = model.particles.position[i] = x;
    model.particles.reference_volume[i] = 1.0 / (n * n * n);
    model.particles.mass[i] = 1000.0 / (n * n * n);
  }
  scarp::Body body;
  body.name = "block";
  body.lattice = {{0, 0, 0}, 0.25, {4, 4, 4}};
  body.end = model.particles.size();
  model.bodies = {body};
  return model;
}

}  // namespace

int main() {
  scarp::Model model = block();
  scarp::SolverOptions options;
  options.end_time = 0.1;
  options.gravity = scarp::Vec3{0, 0, -10};
  Silent sink;
  const scarp::RunReport report = scarp::run(model, options, {}, sink, 1);
  double mean = 0;
  for (const scarp::Vec3& v : model.particles.velocity) mean += v[2] / static_cast<double>(model.particles.size());
  const bool right = !report.failed && std::abs(mean + 1.0) < 1e-12;
  std::printf("fell for %g s, mean velocity %.15g m/s: %s\n", report.end_time, mean, right ? "right" : "wrong");
  return right ? 0 : 1;
}

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Granular flow down an incline against Bagnold's profile.
#include <gtest/gtest.h>

#include <numbers>

#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"
#include "tests/support/validation_table.hpp"

namespace scarp {
namespace {

using test::output;
using test::RecordingSink;
using test::solver;
using test::validate_near;

/// Unusually large grains: the law knows them by the inertial number alone, and flow so slow that the layer hardly
/// shears is steady within milliseconds.
const Granular kGrains{{1500, 1.5e8, 0.3}, 0.38, 0.64, 0.279, 40, 2500};
constexpr double kDepth = 1, kGravity = 9.81;
constexpr int kCells = 32;

/// u = 2/3 I/d sqrt(rho g cos / rho_s) (H^1.5 - (H - y)^1.5), mu(I) = tan: GDR MiDi 2004; Jop, Forterre, Pouliquen
/// 2006.
double bagnold(double angle, double y) {
  const double slope = std::tan(angle), number = kGrains.I_0 * (slope - kGrains.mu_s) / (kGrains.mu_2 - slope);
  return 2.0 / 3 * number / kGrains.grain_diameter *
         std::sqrt(kGrains.density * kGravity * std::cos(angle) / kGrains.grain_density) *
         (std::pow(kDepth, 1.5) - std::pow(kDepth - y, 1.5));
}

double pressure(double angle, double y) { return kGrains.density * kGravity * std::cos(angle) * (kDepth - y); }

/// One column of cells stands for an endless layer: its nodes move along x only, under the pressure of the weight above
/// from the start, and what the layer beside it presses on is a force on the particles: half a cell's pressure on each,
/// so that the nodes of a side get all of it.
Model layer(double angle) {
  const double h = kDepth / kCells;
  Model model = test::empty_model({0, 0, 0}, {h, kDepth, 0}, h, {Condition::free, Condition::free, Condition::fixed});
  test::seed_body(model, "layer", kGrains, 2, test::everywhere);
  NodeSet all{"layer", Condition::roller, 1, {}};
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= 1; ++i) all.nodes.push_back({i, j, 0});
  model.bodies[0].held.push_back(all);
  Particles& particles = model.particles;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double P = pressure(angle, particles.reference_position[p][1]);
    const double stretch = std::exp(-P / (3 * kGrains.bulk_modulus())), b = stretch * stretch;
    particles.deformation_gradient[p] = {stretch, 0, 0, 0, stretch, 0, 0, 0, stretch};
    particles.elastic_left_cauchy_green[p] = {b, b, b, 0, 0, 0};
    particles.stress[p] = {-P, -P, -P, 0, 0, 0};
  }
  model.body_force = [=](const Vec3& X, double) {
    const double push = 2 * pressure(angle, X[1]) / (kGrains.density * 0.5 * h);
    return Vec3{X[0] < 0.5 * h ? push : -push, 0, 0};
  };
  return model;
}

TEST(GranularLayer, FlowsWithBagnoldsProfile) {
  const double fast = std::numbers::pi * 24 / 180, slow = std::numbers::pi * 20 / 180;
  for (double angle : {fast, slow}) {
    Model model = layer(angle);
    SolverOptions options = solver(0.3, {kGravity * std::sin(angle), 0, 0}, 0.4);
    options.gravity_ramp = 0.2;
    RecordingSink sink;
    const RunReport report = run(model, options, output(0.3, 0.3), sink, 1);
    ASSERT_FALSE(report.failed) << report.failure.what;
    double worst = 0, fastest = 0, friction = 0;
    const double surface = bagnold(fast, kDepth);
    for (std::size_t p = 0; p < model.particles.size(); ++p) {
      const double y = model.particles.reference_position[p][1], u = model.particles.velocity[p][0];
      const Sym6& s = model.particles.stress[p];
      worst = std::max(worst, std::abs(u - bagnold(angle, y)) / surface);
      fastest = std::max(fastest, std::abs(u) / surface);
      friction += s[3] / -(s[0] + s[1] + s[2]) * 3 / static_cast<double>(model.particles.size());
    }
    if (angle == fast) {
      validate_near("mu(I) layer at 24 degrees: largest error of the velocity / that of the surface", 0, worst, 0.01,
                    "Bagnold's profile; 32 cells, and the little shear of the column itself");
      validate_near("mu(I) layer at 24 degrees: mean of shear stress / pressure", std::tan(angle), friction, 0.005,
                    "balance of the steady flow");
      validate_near("mu(I) layer at 24 degrees: velocity of the surface, mm/s", 1e3 * surface, 1e3 * fastest * surface,
                    0.03 * 1e3 * surface, "the highest particles are a quarter of a cell below it");
    } else {
      validate_near("mu(I) layer at 20 degrees, below mu_s: velocity / that at 24 degrees", 0, fastest, 0.02,
                    "it stands; what is left is the ringing of the start");
    }
  }
}

}  // namespace
}  // namespace scarp

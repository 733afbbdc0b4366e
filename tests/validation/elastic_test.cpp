// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elastic solver against closed forms and converged references (method.md section 3).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/core/run.hpp"
#include "solver/core/step_total.hpp"
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

constexpr auto kFree = Condition::free;
constexpr auto kRoller = Condition::roller;
constexpr auto kFixed = Condition::fixed;

/// First mode of a fixed-free bar, L = 25, E = 100, rho = 1, v0 = 0.1: v_cm = (2 v0 / pi) cos(omega t), omega = pi c /
/// (2 L) = 2 pi / 10.
TEST(Bar, VibratesInItsFirstMode) {
  const double length = 25, v0 = 0.1, amplitude = 2 * v0 / pi;
  Model model = test::empty_model({0, 0, 0}, {length, 0.5, 0}, 0.5, {kFixed, kFree, kRoller, kRoller});
  test::seed_body(model, "bar", LinearElastic{{1, 100, 0}}, 2, test::everywhere, [&](const Vec3& X) {
    return Vec3{v0 * std::sin(pi * X[0] / (2 * length)), 0, 0};
  });
  RecordingSink sink;
  const RunReport report = run(model, solver(20, {0, 0, 0}), output(10, 0.1), sink, 1);
  ASSERT_FALSE(report.failed);
  const double mass = length * 0.5;
  double worst = 0, crossing = 0;
  for (std::size_t i = 1; i < sink.samples.size(); ++i) {
    const HistorySample &a = sink.samples[i - 1], &b = sink.samples[i];
    worst = std::max(worst, std::abs(b.momentum[0] / mass - amplitude * std::cos(2 * pi * b.time / 10)));
    if (a.momentum[0] < 0 && b.momentum[0] >= 0)
      crossing = a.time + (b.time - a.time) * a.momentum[0] / (a.momentum[0] - b.momentum[0]);
  }
  validate_near("bar: largest error of v_cm over two periods / amplitude", 0, worst / amplitude, 0.01,
                "O(h^2) dispersion at 50 cells, and the half step between v and x, omega dt / 2 = 0.6 %");
  validate_near("bar: period", 10, crossing - 7.5, 0.02, "second rise through zero, at 17.5; dt = 0.02");
}

/// sigma_yy = - rho0 g (H - Y) at any strain, and sigma_xx from the law at the F_yy that results.
TEST(Column, CarriesItsOwnWeightAtLargeStrain) {
  const double height = 10, rho = 1000, g = 10, E = 4e5;
  const NeoHookean law{{rho, E, 0.3}};
  Model model = test::empty_model({0, 0, 0}, {0.5, height, 0}, 0.5, {kRoller, kRoller, kFixed, kFree});
  test::seed_body(model, "column", law, 2, test::everywhere);
  SolverOptions options = solver(150, {0, -g, 0});
  options.flip = 0;  // pure PIC: viscous, so that the column comes to rest
  RecordingSink sink;
  const RunReport report = run(model, options, output(50, 10), sink, 1);
  ASSERT_FALSE(report.failed);
  double worst = 0, worst_lateral = 0, least_J = 1;
  const Particles& p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    // The strain of a linear cell is uniform along y, so the exact stress is met at the cell's centre.
    const double centre = (std::floor(p.reference_position[i][1] / 0.5) + 0.5) * 0.5;
    const double exact = -rho * g * (height - centre), J = p.deformation_gradient[i][4];
    worst = std::max(worst, std::abs(p.stress[i][1] - exact));
    const double lateral = law.lambda() * std::log(J) / J;
    worst_lateral = std::max(worst_lateral, std::abs(p.stress[i][0] - lateral));
    least_J = std::min(least_J, J);
  }
  const double scale = rho * g * height;
  validate_within("column: compression at the base, F_yy", 0.5, 0.9, least_J,
                  "large strain, so that the test means it");
  validate_near("column: largest error of sigma_yy / rho0 g H", 0, worst / scale, 1e-6,
                "nodal equilibrium is exact for a linear P(Y); what is left is the decayed oscillation");
  validate_near("column: largest error of sigma_xx / rho0 g H", 0, worst_lateral / scale, 1e-12, "the law itself");
}

/// K0: sigma_xx / sigma_yy = nu / (1 - nu) at small strain.
TEST(Column, HasTheElasticStressRatioAtRest) {
  const double nu = 0.3;
  Model model = test::empty_model({0, 0, 0}, {0.5, 5, 0}, 0.5, {kRoller, kRoller, kFixed, kFree});
  test::seed_body(model, "column", LinearElastic{{1000, 1e9, nu}}, 2, test::everywhere);
  SolverOptions options = solver(1, {0, -10, 0});
  options.flip = 0;
  RecordingSink sink;
  ASSERT_FALSE(run(model, options, output(1, 1), sink, 1).failed);
  double worst = 0;
  for (const Sym6& s : model.particles.stress) worst = std::max(worst, std::abs(s[0] / s[1] - nu / (1 - nu)));
  validate_near("column: sigma_xx / sigma_yy - nu / (1 - nu)", 0, worst, 1e-4, "strain 5e-5, that much non-linear");
}

/// Axis-aligned manufactured solution u_i = A sin(2 pi X_i) sin(c pi t) in a neo-Hookean unit square with rollers:
/// P_ii = mu (F - 1/F) + lambda ln J / F, b = a - dP/dX / rho0.
double manufactured_error(int cells, double courant) {
  const double A = 0.05, rho = 1000;
  const NeoHookean law{{rho, 1e7, 0.3}};
  const double mu = law.shear_modulus(), lambda = law.lambda(), rate = 100 * pi;
  Model model = test::empty_model({0, 0, 0}, {1, 1, 0}, 1.0 / cells, {kRoller, kRoller, kRoller, kRoller});
  test::seed_body(model, "square", law, 2, test::everywhere, [&](const Vec3& X) {
    return Vec3{A * rate * std::sin(2 * pi * X[0]), A * rate * std::sin(2 * pi * X[1]), 0};
  });
  const double end = 0.015;  // three quarters of a period
  TotalLagrangian method(model, solver(end, {0, 0, 0}, courant), 1);
  method.body_force = [&](const Vec3& X, double t) {
    const double s = std::sin(rate * t);
    const double Fx = 1 + 2 * pi * A * std::cos(2 * pi * X[0]) * s, Fy = 1 + 2 * pi * A * std::cos(2 * pi * X[1]) * s;
    const double log_J = std::log(Fx * Fy);
    Vec3 b{0, 0, 0};
    for (int i = 0; i < 2; ++i) {
      const double F = i ? Fy : Fx, u = A * std::sin(2 * pi * X[i]) * s;
      const double slope = -4 * pi * pi * u;  // dF/dX
      b[i] = -rate * rate * u - slope * (mu * (1 + 1 / (F * F)) + lambda * (1 - log_J) / (F * F)) / rho;
    }
    return b;
  };
  double worst = 0;
  while (method.time() < end) {
    EXPECT_EQ(method.step(std::min(method.stable_time_step(), end - method.time())), -1);
    method.write_particles();
    double square = 0;
    for (std::size_t p = 0; p < model.particles.size(); ++p) {
      const Vec3& X = model.particles.reference_position[p];
      for (int i = 0; i < 2; ++i) {
        const double exact = X[i] + A * std::sin(2 * pi * X[i]) * std::sin(rate * method.time());
        square += std::pow(model.particles.position[p][i] - exact, 2);
      }
    }
    worst = std::max(worst, std::sqrt(square / static_cast<double>(model.particles.size())));
  }
  return worst;
}

TEST(ManufacturedSolution, ConvergesAtSecondOrder) {
  // The step falls with the square of the cell, so that the error in space is what is seen.
  const double e16 = manufactured_error(16, 0.4), e32 = manufactured_error(32, 0.2), e64 = manufactured_error(64, 0.1);
  std::printf("manufactured solution: RMS errors %.3e %.3e %.3e\n", e16, e32, e64);
  const std::string why = "linear shape functions: second order in space";
  validate_within("manufactured solution: order, 16 to 32 cells", 1.85, 2.2, std::log2(e16 / e32), why);
  validate_within("manufactured solution: order, 32 to 64 cells", 1.85, 2.2, std::log2(e32 / e64), why);
}

struct Fall {
  double drop = 0, time = 0;  ///< of the lower corner at the free end, m, s
  double energy_error = 0;    ///< over the largest strain energy
};

/// A cantilever of length L and depth 1 m, rho = 1050, nu = 0.3, plane strain, under sudden gravity of 10 m/s2.
Fall fall(double length, double E, double end_time) {
  Model model = test::empty_model({0, -length, 0}, {length + 1, 2, 0}, 1.0 / 16, {kFixed, kFree, kFree, kFree});
  test::seed_body(model, "beam", NeoHookean{{1050, E, 0.3}}, 2,
                  [&](const Vec3& X) { return X[0] < length && X[1] > 0 && X[1] < 1; });
  RecordingSink sink;
  Fall result;
  sink.on_frame = [&](const Model& m, double time) {
    const double now = -test::carried(m.particles, {length, 0, 0})[1];
    if (now <= result.drop) return;
    result.drop = now;
    result.time = time;
  };
  const RunReport report = run(model, solver(end_time, {0, -10, 0}), output(0.005, 0.05), sink, 1);
  EXPECT_FALSE(report.failed);
  double largest_strain = 0;
  for (const HistorySample& s : sink.samples) largest_strain = std::max(largest_strain, s.strain);
  result.energy_error = report.largest_energy_error / largest_strain;
  return result;
}

TEST(Cantilever, SuddenGravityDropsTheCornerAsOtherMethodsSay) {
  const std::string why = "limit on which unrelated methods agree";
  const Fall fallen = fall(6, 5e6, 1.8);
  validate_near("cantilever, 6 m, E = 5 MPa: drop of the corner, m", 4.56, fallen.drop, 0.05, why);
  validate_near("cantilever, 6 m, E = 5 MPa: time of the drop, s", 1.44, fallen.time, 0.02, why);
  validate_near("cantilever, 6 m, E = 5 MPa: energy drift / largest strain energy", 0, fallen.energy_error, 1e-3,
                "nothing dissipates; what is left is symplectic Euler's O(dt) ripple");
}

TEST(Cantilever, SuddenGravityDropsTheCornerOfASofterOneToo) {
  const std::string why = "limit on which unrelated methods agree";
  const Fall fallen = fall(4, 1e6, 1.3);
  validate_near("cantilever, 4 m, E = 1 MPa: drop of the corner, m", 3.30, fallen.drop, 0.03, why);
  validate_near("cantilever, 4 m, E = 1 MPa: time of the drop, s", 1.05, fallen.time, 0.02, why);
}

TEST(FreeFall, IsExact) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, 1}, 0.25);
  test::seed_body(model, "block", NeoHookean{{1000, 1e6, 0.3}}, 2, test::everywhere, [](const Vec3&) {
    return Vec3{1, 2, 3};
  });
  RecordingSink sink;
  const RunReport report = run(model, solver(1, {0, 0, -9.81}), output(0.5, 0.1), sink, 1);
  ASSERT_FALSE(report.failed);
  double dv = 0, dx = 0, strain = 0;
  const Particles& p = model.particles;
  // x is stepped with the velocity at the end of each step: g dt / 2 per unit of time ahead of the parabola.
  double sum_of_squares = 0;
  for (double dt : sink.steps) sum_of_squares += dt * dt;
  for (std::size_t i = 0; i < p.size(); ++i) {
    dv = std::max(dv, norm(p.velocity[i] - Vec3{1, 2, 3 - 9.81}));
    const Vec3 fall{1, 2, 3 - 0.5 * 9.81 - 0.5 * 9.81 * sum_of_squares};
    dx = std::max(dx, norm(p.position[i] - p.reference_position[i] - fall));
    for (int k = 0; k < 9; ++k) strain = std::max(strain, std::abs(p.deformation_gradient[i][k] - kIdentity[k]));
  }
  validate_near("free fall: error of the velocity, m/s", 0, dv, 1e-11, "rounding over the steps");
  validate_near("free fall: error of the place, m", 0, dx, 1e-11, "rounding; symplectic Euler's known sum");
  validate_near("free fall: strain", 0, strain, 1e-12, "rounding");
}

TEST(Momentum, IsConservedInAFreeBodyThatSwingsAtLargeStrain) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, 1}, 0.125);
  test::seed_body(
      model, "ball", NeoHookean{{1000, 1e5, 0.3}}, 2,
      [](const Vec3& X) {
        return norm(X - Vec3{0.5, 0.5, 0.5}) < 0.45;
      },
      [](const Vec3& X) {
        return Vec3{3 * std::sin(5 * X[1]) + 1, 2 * std::cos(4 * X[2]), 2 * X[0] * X[1] - 0.5};
      });
  RecordingSink sink;
  const RunReport report = run(model, solver(0.3, {0, 0, 0}), output(0.1, 0.01), sink, 1);
  ASSERT_FALSE(report.failed);
  double worst = 0;
  for (const HistorySample& s : sink.samples) worst = std::max(worst, norm(s.momentum - report.first.momentum));
  validate_within("free body: largest strain energy / kinetic", 0.01, 1, report.last.strain / report.first.kinetic,
                  "so that the test means it");
  validate_near("free body: change of momentum / momentum", 0, worst / norm(report.first.momentum), 1e-12,
                "internal forces sum to nothing; rounding");
}

struct Spin {
  double turns = 0;  ///< by the rotation in F of a particle near the axis
  double energy_error = 0;
};

/// A square that spins freely for one turn, with n cells along its side.
Spin spin(int n) {
  const double omega = 2 * pi;
  Model model = test::empty_model({-1, -1, 0}, {1, 1, 0}, 1.0 / n);
  test::seed_body(
      model, "square", NeoHookean{{1000, 1e8, 0.3}}, 2,
      [](const Vec3& X) { return std::abs(X[0]) < 0.5 && std::abs(X[1]) < 0.5; },
      [&](const Vec3& X) {
        return Vec3{-omega * X[1], omega * X[0], 0};
      });
  RecordingSink sink;
  Spin result;
  double angle = 0, before = 0;
  sink.on_frame = [&](const Model& m, double) {
    const Mat3& F = m.particles.deformation_gradient[test::nearest(m.particles, {0.2, 0.1, 0})];
    const double now = std::atan2(F[3] - F[1], F[0] + F[4]);
    angle += std::remainder(now - before, 2 * pi);
    before = now;
    result.turns = angle / (2 * pi);
  };
  const RunReport report = run(model, solver(1, {0, 0, 0}), output(0.05, 0.01), sink, 1);
  EXPECT_FALSE(report.failed);
  result.energy_error = report.largest_energy_error / report.first.total;
  return result;
}

TEST(Rotation, KeepsItsEnergy) {
  const Spin coarse = spin(8), fine = spin(16);
  validate_near("rotation: energy error after a turn / energy, 16 cells", 0, fine.energy_error, 1e-3,
                "a rigid turn stores and dissipates nothing");
  validate_near("rotation: turns in the time of one, 16 cells", 1, fine.turns, 0.012,
                "lumped maps see border nodes at the centroid of their mass, inside the body: slow by O(h^2)");
  validate_within("rotation: order of that lag, 8 to 16 cells", 1.8, 2.3,
                  std::log2((1 - coarse.turns) / (1 - fine.turns)), "second order");
}

}  // namespace
}  // namespace scarp

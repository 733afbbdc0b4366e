// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shaken bases against closed forms of a shear column (Kramer 1996, chapter 7): rigid, |u(H)| / |u_g| = 1 / |cos(k H)|;
// compliant, a free surface moves with twice the incoming wave and what it sends back leaves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/core/make_frame.hpp"
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

constexpr double kHeight = 20, kShearSpeed = 100, kCell = 0.5;

/// Column one cell wide that can only shear, c_s = 100 m/s.
Model shear_column(FaceCondition base, Formulation formulation) {
  const double nu = 0.25, rho = 2000, G = rho * kShearSpeed * kShearSpeed;
  Model model = test::empty_model({0, 0, 0}, {kCell, kHeight, 0}, kCell);
  model.domain.faces[2] = base;
  test::seed_body(model, "column", LinearElastic{{rho, 2 * G * (1 + nu), nu}}, 2, test::everywhere);
  model.bodies[0].formulation = formulation;
  LoadOptions upright;
  upright.name = "upright";
  upright.where.box = BoxShape{{0, 0, 0}, {kCell, kHeight, 0}};
  upright.velocity = Vec3{0, 0, 0};
  upright.axes = "y";
  model.loads = {upright};
  return model;
}

GroundMotion motion(double duration, double interval, const std::function<double(double)>& acceleration) {
  AccelerationRecord record;
  for (int i = 0; i * interval <= duration; ++i) {
    record.time.push_back(i * interval);
    record.acceleration.push_back(acceleration(i * interval));
  }
  return GroundMotion(record, 0);
}

/// Displacement along x of a frame's particle, as frames hold it.
double displacement_x(const Model& model, double time, std::size_t p, bool absolute) {
  const Frame frame = make_frame(model, {OutputField::displacement}, time, 0, absolute);
  return std::get<std::vector<float>>(find_field(frame, "displacement")->values)[3 * p];
}

TEST(ShakenBase, AColumnOnARigidBaseAmplifiesByItsTransferFunction) {
  for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian})
    for (double kH : {1.0, 2.2}) {
      const std::string name = std::string(formulation == Formulation::total_lagrangian ? "TL" : "UL") +
                               " column on a rigid base, k H = " + (kH == 1 ? "1.0" : "2.2") + ": ";
      Model model = shear_column(FaceCondition::fixed, formulation);
      const double omega = kH * kShearSpeed / kHeight, period = 2 * pi / omega, ramp = 12 * period, end = 15 * period;
      const double amplitude = 1e-3;  // of the displacement, m
      // u = A r(t) sin(omega t) with a soft start, which leaves no free vibration behind.
      const auto u = [&](double t) {
        const double s = std::min(1.0, t / ramp);
        return amplitude * s * s * s * (10 - s * (15 - 6 * s)) * std::sin(omega * t);
      };
      const double d = 1e-3;
      model.shaking = {
          motion(end, 0.002, [&](double t) { return t == 0 ? 0 : (u(t + d) - 2 * u(t) + u(t - d)) / d / d; })};
      RecordingSink sink;
      double top = 0, base = 0, input = 0;
      sink.on_frame = [&](const Model& m, double time) {
        base = std::max(base, std::abs(base_displacement(m.shaking, time)[0] - u(time)));
        if (time < end - 2 * period) return;
        top = std::max(top, std::abs(displacement_x(m, time, test::nearest(m.particles, {0, kHeight, 0}), true)));
        input = std::max(input, std::abs(base_displacement(m.shaking, time)[0]));
      };
      ASSERT_FALSE(run(model, solver(end, {0, 0, 0}), output(period / 200, period / 50), sink, 1).failed);
      validate_near(name + "amplitude of the surface / of the base, times the size of cos(k H)", 1,
                    top / input * std::abs(std::cos(kH)), 0.01, "undamped; soft start over 12 periods, 40 cells");
      validate_near(name + "error of the base's displacement / its amplitude", 0, base / amplitude, 2e-4,
                    "double integral of the record, sampled at 0.002 s");
      double external = 0, drift = 0;
      for (const HistorySample& s : sink.samples) {
        external = std::max(external, s.kinetic + s.strain);
        drift = std::max(drift, std::abs(s.total));
      }
      validate_near(name + "balance of energy / largest energy", 0, drift / external, 0.01,
                    "O(dt) ripple of the scheme");
    }
}

TEST(ShakenBase, ACompliantBaseDoublesTheWaveAndLetsItOut) {
  for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    const std::string name =
        std::string(formulation == Formulation::total_lagrangian ? "TL" : "UL") + " column on a compliant base: ";
    Model model = shear_column(FaceCondition::absorbing, formulation);
    const double v0 = 1e-3, length = 0.2, start = 0.02;  // s: 40 cells per pulse
    const auto wave = [&](double t) {
      const double s = (t - start) / length;
      return s > 0 && s < 1 ? v0 * std::pow(std::sin(pi * s), 2) : 0;
    };
    const double d = 1e-5;
    model.shaking = {motion(0.5, 0.001, [&](double t) { return t == 0 ? 0 : (wave(t + d) - wave(t - d)) / (2 * d); })};
    model.shaking[0].base = ShakenBase::compliant;
    model.shaking[0].side = 2;
    RecordingSink sink;
    const double travel = kHeight / kShearSpeed, gone = start + length + 2 * travel + 0.02, end = gone + 2 * travel;
    double error = 0, left = 0;
    sink.on_frame = [&](const Model& m, double time) {
      const std::size_t top = test::nearest(m.particles, {0, kHeight, 0});
      error = std::max(error, std::abs(m.particles.velocity[top][0] - 2 * wave(time - travel)));
      for (std::size_t p = 0; time > gone && p < m.particles.size(); ++p)
        left = std::max(left, std::abs(m.particles.velocity[p][0]));
    };
    ASSERT_FALSE(run(model, solver(end, {0, 0, 0}), output(0.005, 0.005), sink, 1).failed);
    validate_near(name + "error of the surface's velocity 2 v_in(t - H / c_s) / 2 v0", 0, error / (2 * v0), 0.03,
                  "free surface of a half-space; 40 cells per pulse");
    validate_within(name + "velocity left after the wave has gone / v0", 0, 0.05, left / v0,
                    "nothing comes back from a transparent base");
    const HistorySample& last = sink.samples.back();
    double largest = 0, drift = 0;
    for (const HistorySample& s : sink.samples) {
      largest = std::max(largest, s.kinetic + s.strain);
      drift = std::max(drift, std::abs(s.total));
    }
    validate_near(name + "balance of energy / largest energy", 0, drift / largest, 0.02, "O(dt) ripple of the scheme");
    // Input 2 rho c v_in (v_in + reflected) and dashpots rho c v^2: both pulses pass the base one after the other.
    const double pulse = 2000 * kShearSpeed * kCell * v0 * v0 * length * 3 / 8;
    validate_near(name + "work of the base / (2 rho c int v_in^2)", 1, last.external / (2 * pulse), 0.02,
                  "the incoming wave alone moves the base while it enters");
    validate_near(name + "energy that left / (2 rho c int v_in^2)", 1, last.damping / (2 * pulse), 0.02,
                  "dashpots see the wave as it enters and as it leaves");
  }
}

/// A known trap: boundary velocities that are set in one of MUSL's two maps only grow over a long record.
TEST(ShakenBase, TwentySecondsOfAnEarthquakeStayStable) {
  for (Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    const std::string name =
        std::string(formulation == Formulation::total_lagrangian ? "TL" : "UL") + " column, 20 s of a record: ";
    Model model = shear_column(FaceCondition::fixed, formulation);
    model.shaking = {motion(20, 0.01, [](double t) {
      const double envelope = std::exp(-std::pow((t - 7) / 3, 2));
      return 0.3 * envelope * (std::sin(5.1 * t) + 0.7 * std::sin(11.3 * t + 1) + 0.4 * std::sin(29.7 * t + 2));
    })};
    SolverOptions options = solver(20, {0, 0, 0});
    options.pic_rate = 2;
    RecordingSink sink;
    ASSERT_FALSE(run(model, options, output(20, 0.02), sink, 1).failed);
    double largest = 0;
    for (const HistorySample& s : sink.samples) largest = std::max(largest, s.kinetic + s.strain);
    const HistorySample& last = sink.samples.back();
    validate_within(name + "energy at the end / largest", 0, 0.05, (last.kinetic + last.strain) / largest,
                    "10 s after the strong motion, PIC rate 2 / s");
  }
}

}  // namespace
}  // namespace scarp

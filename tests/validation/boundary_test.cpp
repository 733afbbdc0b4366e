// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces, damping and starts at rest against closed forms, and the balance of energy with all that they take.
#include <gtest/gtest.h>

#include <cmath>
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

/// The balance of energy over all samples, as a share of `scale`.
double drift(const RecordingSink& sink, double scale) {
  double worst = 0;
  for (const HistorySample& s : sink.samples) worst = std::max(worst, std::abs(s.total - sink.samples[0].total));
  return worst / scale;
}

/// The formulations and shapes that a boundary condition must work in.
struct Way {
  const char* name;
  Formulation formulation;
  ShapeFunction shape;
};
constexpr Way kTotal{"", Formulation::total_lagrangian, ShapeFunction::linear};
constexpr Way kWays[]{kTotal,
                      {"UL, linear: ", Formulation::updated_lagrangian, ShapeFunction::linear},
                      {"UL, B-spline: ", Formulation::updated_lagrangian, ShapeFunction::quadratic_bspline},
                      {"UL, GIMP: ", Formulation::updated_lagrangian, ShapeFunction::gimp}};

void go(const Way& way, Model& model, SolverOptions& options) {
  for (Body& body : model.bodies) body.formulation = way.formulation;
  options.shape = way.shape;
}

/// A block on a floor of friction mu, gravity turned by `degrees` instead of the floor.
struct Slide {
  double velocity = 0;  ///< m/s, of the centre, down the incline at the end
  RecordingSink sink;
};
Slide slide(int dimension, double degrees, double mu, double time) {
  const double g = 9.81, tilt = degrees * pi / 180;
  const double depth = dimension == 3 ? 1.0 : 0.0;
  Model model = test::empty_model({0, 0, 0}, {2, 1, depth}, 0.25);
  model.domain.faces[2] = Face(FaceCondition::friction, mu);
  test::seed_body(model, "block", NeoHookean{{2000, 5e6, 0.3}}, 2, [](const Vec3& X) { return X[0] < 1; });
  Slide result;
  SolverOptions options = solver(time, {g * std::sin(tilt), -g * std::cos(tilt), 0});
  options.gravity_ramp = 0.1;  // no bounce
  const RunReport report = run(model, options, output(time, time / 100), result.sink, 1);
  EXPECT_FALSE(report.failed);
  result.velocity = result.sink.samples.back().momentum[0] / 2000;  // of 1 m3, 2D per metre
  return result;
}

TEST(FrictionFace, ABlockSlidesAsCoulombSays) {
  for (int dimension : {2, 3}) {
    const std::string name = "friction face, " + std::to_string(dimension) + "D: ";
    const double mu = 0.3, tilt = pi / 6, time = 0.6;
    const Slide run = slide(dimension, 30, mu, time);
    // The ramp s^2 (3 - 2 s) of 0.1 s is worth half of its time.
    const double expected = 9.81 * (std::sin(tilt) - mu * std::cos(tilt)) * (time - 0.05);
    validate_near(name + "velocity at 30 deg, mu = 0.3 / closed form", 1, run.velocity / expected, 0.015,
                  "g (sin - mu cos) t; the block rocks on its elastic base");
    const HistorySample& last = run.sink.samples.back();
    validate_near(name + "energy lost to friction / (mu N s)", 1,
                  last.friction / (mu * 2000 * 9.81 * std::cos(tilt) * expected * (time - 0.05) / 2), 0.03,
                  "s = v t / 2, within the two errors above");
    validate_near(name + "balance of energy / friction", 0, drift(run.sink, last.friction), 0.01,
                  "symplectic Euler's O(dt) ripple, and impacts of rocking corners");
  }
}

TEST(FrictionFace, ABlockSticksBelowTheAngleOfFriction) {
  const double time = 1;
  const Slide run = slide(2, 30, 0.7, time);
  validate_near("friction face: creep at 30 deg, mu = 0.7 / (g sin t)", 0, run.velocity / (9.81 * 0.5 * time), 0.02,
                "tan 30 deg = 0.577 < 0.7; shear of the elastic block is what moves");
}

TEST(FrictionFace, ABlockMayLeaveAndIsCaughtAgain) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, 0}, 0.25);
  model.domain.faces[2] = Face(FaceCondition::friction, 0.5);
  const double g = 10, up = 2;
  test::seed_body(model, "block", NeoHookean{{1000, 1e7, 0.3}}, 2, test::everywhere, [&](const Vec3&) {
    return Vec3{0, up, 0};
  });
  RecordingSink sink;
  double highest = 0, lowest = 0;
  sink.on_frame = [&](const Model& m, double) {
    double mean = 0;
    for (std::size_t p = 0; p < m.particles.size(); ++p)
      mean += (m.particles.position[p][1] - m.particles.reference_position[p][1]) / 64;
    highest = std::max(highest, mean);
    lowest = std::min(lowest, mean);
  };
  ASSERT_FALSE(run(model, solver(0.6, {0, -g, 0}), output(0.002, 0.002), sink, 1).failed);
  validate_near("friction face: rise of a block thrown up, m", up * up / (2 * g), highest, 0.002, "v^2 / 2 g");
  validate_within("friction face: deepest fall below its place, m", -0.02, 0, lowest,
                  "v sqrt(rho H^2 / E) = 0.02: what a bar gives on impact");
}

/// A short pulse runs along a column of cells into an absorbing face; what comes back, as a share of its velocity.
double returned(int dimension, bool shear, FaceCondition far, const Way& way = kTotal) {
  const double length = 20, h = 0.125, pulse = 4;
  const LinearElastic law{{1000, 1e6, 0.25}};
  const double c = shear ? std::sqrt(law.shear_modulus() / law.density) : law.wave_speed();
  Model model = test::empty_model(
      {0, 0, 0}, {length, h, dimension == 3 ? h : 0.0}, h,
      {Condition::free, Condition::free, Condition::roller, Condition::roller, Condition::roller, Condition::roller});
  if (shear) model.domain.faces[2] = model.domain.faces[3] = Condition::free;
  model.domain.faces[1] = far;
  // A wave that runs to the right alone has v = f(x - c t) and du/dx = -f / c.
  const double v0 = 1e-3, centre = 10;
  const int axis = shear ? 1 : 0;
  const auto shape = [&](double x) {
    const double s = std::abs(x - centre) / pulse;
    return s < 0.5 ? std::pow(std::cos(pi * s), 2) : 0;
  };
  test::seed_body(model, "bar", law, 2, test::everywhere, [&](const Vec3& X) {
    Vec3 v{0, 0, 0};
    v[axis] = v0 * shape(X[0]);
    return v;
  });
  if (shear) {  // pure shear: no node moves along the bar
    NodeSet all{"all", Condition::roller, 0, {}};
    for (int i = 0; i <= 160; ++i)
      for (int j = 0; j <= 1; ++j) all.nodes.push_back({i, j, 0});
    model.bodies[0].held.push_back(all);
  }
  for (std::size_t p = 0; p < model.particles.size(); ++p) {
    Mat3& F = model.particles.deformation_gradient[p];
    F[3 * axis] -= v0 / c * shape(model.particles.reference_position[p][0]);
    PointHistory history;
    model.particles.stress[p] = LinearElastic::Law(law).stress(make_motion(F, F), history);
  }
  RecordingSink sink;
  double back = 0;
  const double end = 14 / c;
  sink.on_frame = [&](const Model& m, double time) {
    if (time < end) return;
    for (std::size_t p = 0; p < m.particles.size(); ++p)
      back = std::max(back, std::abs(m.particles.velocity[p][axis]) / v0);
  };
  SolverOptions options = solver(end, {0, 0, 0});
  go(way, model, options);
  EXPECT_FALSE(run(model, options, output(end, end / 100), sink, 1).failed);
  if (far == FaceCondition::absorbing) {
    const double kinetic = sink.samples[0].total;
    validate_near(way.name + std::string("absorbing face: balance of energy / that of the wave"), 0,
                  drift(sink, kinetic), 0.02, "O(dt) ripple of the scheme");
    validate_within(way.name + std::string("absorbing face: energy taken / that of the wave"), 0.97, 1.01,
                    sink.samples.back().damping / kinetic, "all of it leaves");
  }
  return back;
}

TEST(AbsorbingFace, LetsWavesOut) {
  for (int dimension : {2, 3}) {
    const std::string name = "absorbing face, " + std::to_string(dimension) + "D: ";
    validate_within(name + "P wave that comes back / sent", 0, 0.05,
                    returned(dimension, false, FaceCondition::absorbing), "32 cells per pulse, normal incidence");
    validate_within(name + "P wave that comes back from a fixed face / sent", 0.9, 1.1,
                    returned(dimension, false, FaceCondition::fixed), "so that the test means it");
  }
}

TEST(AbsorbingFace, LetsShearWavesOut) {
  validate_within("absorbing face: S wave that comes back / sent", 0, 0.05, returned(2, true, FaceCondition::absorbing),
                  "32 cells per pulse, normal incidence");
}

TEST(AbsorbingFace, LetsWavesOutOfUpdatedBodies) {
  for (const Way& way : kWays) {
    if (way.formulation == Formulation::total_lagrangian) continue;
    for (bool shear : {false, true})
      validate_within(way.name + std::string(shear ? "S" : "P") + " wave that comes back / sent", 0, 0.05,
                      returned(2, shear, FaceCondition::absorbing, way), "32 cells per pulse, normal incidence");
  }
}

TEST(Damping, EnergyIsAccountedFor) {
  const auto damped = [](double courant, double& left) {
    Model model = test::empty_model({0, 0, 0}, {0.5, 5, 0}, 0.25,
                                    {Condition::roller, Condition::roller, Condition::fixed, Condition::free});
    test::seed_body(model, "column", NeoHookean{{1000, 1e6, 0.3}}, 2, test::everywhere);
    SolverOptions options = solver(4, {0, -10, 0});
    options.damping = 0.2;
    options.courant = courant;
    RecordingSink sink;
    EXPECT_FALSE(run(model, options, output(4, 0.02), sink, 1).failed);
    left = sink.samples.back().kinetic / sink.samples.back().damping;
    return drift(sink, sink.samples.back().damping);
  };
  double left = 0;
  const double coarse = damped(0.4, left), fine = damped(0.1, left);
  validate_near("damping: kinetic energy left / lost", 0, left, 1e-3, "it has come to rest");
  validate_near("damping: balance of energy / lost", 0, coarse, 0.02, "symplectic Euler's O(dt) ripple");
  validate_within("damping: that of a quarter of the step", 0, 0.4, fine / coarse, "it is O(dt)");
}

TEST(GravityRamp, LoadsSoftlyAndItsWorkIsAccountedFor) {
  const auto column = [](double ramp, RecordingSink& sink) {
    Model model = test::empty_model({0, 0, 0}, {0.5, 5, 0}, 0.25,
                                    {Condition::roller, Condition::roller, Condition::fixed, Condition::free});
    test::seed_body(model, "column", NeoHookean{{1000, 1e7, 0.3}}, 2, test::everywhere);
    SolverOptions options = solver(2.5, {0, -10, 0});
    options.gravity_ramp = ramp;
    EXPECT_FALSE(run(model, options, output(2.5, 0.01), sink, 1).failed);
  };
  RecordingSink sudden, soft;
  column(0, sudden);
  column(2, soft);
  double kinetic = 0, kinetic_soft = 0;
  for (const HistorySample& s : sudden.samples) kinetic = std::max(kinetic, s.kinetic);
  for (const HistorySample& s : soft.samples) kinetic_soft = std::max(kinetic_soft, s.kinetic);
  validate_near("gravity ramp of 10 periods: largest kinetic energy / sudden", 0, kinetic_soft / kinetic, 0.01,
                "period 4 H / c = 0.17 s");
  validate_near("gravity ramp: balance of energy / strain energy", 0, drift(soft, soft.samples.back().strain), 0.01,
                "O(dt) ripple of the scheme");
  validate_near("gravity ramp: external work / half the potential energy", 1,
                soft.samples.back().external / (0.5 * soft.samples.back().potential), 0.02,
                "a linear spring loaded slowly: the missing gravity takes back half of what the steady one gives");
}

TEST(Relax, StartsAtRestWithTheStressOfItsWeight) {
  const double height = 10, rho = 1000, g = 10, nu = 0.3;
  for (const auto& [way, base] :
       {std::pair(kTotal, FaceCondition::fixed), std::pair(kTotal, FaceCondition::absorbing),
        std::pair(kWays[1], FaceCondition::absorbing), std::pair(kWays[3], FaceCondition::absorbing)}) {
    const std::string name = way.name + std::string("relaxed column on its ") + std::string(name_of(base)) + " base: ";
    Model model = test::empty_model({0, 0, 0}, {0.5, height, 0}, 0.5, {Condition::roller, Condition::roller});
    model.domain.faces[2] = base;
    test::seed_body(model, "column", LinearElastic{{rho, 1e9, nu}}, 2, test::everywhere);
    SolverOptions options = solver(0.5, {0, -g, 0});
    go(way, model, options);
    options.relax = RelaxOptions{};
    options.relax->until = 1e-10;
    RecordingSink sink;
    double worst = 0, ratio = 0;
    sink.on_frame = [&](const Model& m, double time) {
      const Particles& P = m.particles;
      for (std::size_t p = 0; time == 0 && p < P.size(); ++p) {
        EXPECT_EQ(P.position[p], P.reference_position[p]);
        EXPECT_EQ(norm(P.velocity[p]), 0);
        const double centre = (std::floor(P.reference_position[p][1] / 0.5) + 0.5) * 0.5;
        worst = std::max(worst, std::abs(P.stress[p][1] + rho * g * (height - centre)) / (rho * g * height));
        ratio = std::max(ratio, std::abs(P.stress[p][0] / P.stress[p][1] - nu / (1 - nu)));
      }
    };
    const RunReport report = run(model, options, output(0.5, 0.01), sink, 1);
    ASSERT_FALSE(report.failed);
    validate_near(name + "largest error of sigma_yy / rho g H", 0, worst, 1e-4, "until = 1e-10 of the kinetic energy");
    validate_near(name + "sigma_xx / sigma_yy - nu / (1 - nu)", 0, ratio, 1e-3, "small strain");
    validate_near(name + "displacement in 0.5 s / settlement", 0,
                  report.largest_displacement / (rho * g * height * height / 2 / 1.346e9), 5e-3,
                  "at rest stays at rest; dashpots creep");
    validate_near(name + "potential energy at the start, J", 0, report.first.potential, 0,
                  "displacements count from there");
  }
}

/// A column between rollers under a slow uniform load on its top: confined compression.
TEST(Loads, TractionAndVelocityCompressAColumnAlike) {
  const double height = 4, h = 0.25, pressure = 1e4;
  const LinearElastic law{{1000, 1e7, 0.25}};
  const double modulus = law.density * law.wave_speed() * law.wave_speed();  // confined
  const double settlement = pressure / modulus * height;
  for (const auto& [way, by_velocity] :
       {std::pair(kTotal, false), std::pair(kTotal, true), std::pair(kWays[1], false), std::pair(kWays[1], true),
        std::pair(kWays[2], false), std::pair(kWays[2], true), std::pair(kWays[3], false), std::pair(kWays[3], true)}) {
    const std::string name =
        way.name + std::string(by_velocity ? "column pressed by a velocity: " : "column pressed by a traction: ");
    Model model =
        test::empty_model({0, 0, 0}, {0.5, height, 0}, h, {Condition::roller, Condition::roller, Condition::fixed});
    test::seed_body(model, "column", law, 2, test::everywhere);
    LoadOptions load;
    load.where.box = BoxShape{{0, by_velocity ? height : height - h / 2, 0}, {0.5, height, 0}};
    const double ramp = 1;  // 25 periods of 4 H / c = 0.15 s in all
    if (by_velocity) {
      load.velocity = Vec3{0, -settlement / ramp, 0};
      load.axes = "y";
      load.table = {{0, 0}, {0.5, 1}, {1, 1}, {1.5, 0}};  // its area is the ramp
    } else {
      for (std::size_t p = 0; p < model.particles.size(); ++p)
        model.particles.surface[p] = model.particles.reference_position[p][1] > height - h / 2;
      load.traction = Vec3{0, -pressure, 0};
      load.table = {{0, 0}, {1.5, 1}};
    }
    model.loads = {load};
    RecordingSink sink;
    SolverOptions options = solver(2, {0, 0, 0});
    options.damping = 0.2;
    go(way, model, options);
    const RunReport report = run(model, options, output(2, 0.01), sink, 1);
    ASSERT_FALSE(report.failed);
    double worst = 0;
    const Particles& P = model.particles;
    const double reach = way.shape == ShapeFunction::quadratic_bspline ? 4 * h : 2 * h;  // of the functions at the top
    for (std::size_t p = 0; p < P.size(); ++p)
      if (P.reference_position[p][1] < height - reach)  // the load enters through them
        worst = std::max(worst, std::abs(P.stress[p][1] + pressure) / pressure);
    validate_near(name + "largest error of sigma_yy below the top cells / p", 0, worst, 0.01,
                  "closed form; waves of the ramp");
    validate_near(name + "settlement of the top / (p H / M)", 1,
                  (height - test::carried(P, {0.25, height, 0})[1]) / settlement, 0.03,
                  "the traction of particles enters half a spacing below the top");
    const HistorySample& last = sink.samples.back();
    validate_near(name + "external work / (p settlement / 2)", 1, last.external / (0.5 * pressure * 0.5 * settlement),
                  0.03, "slow loading of a linear spring");
    validate_near(name + "balance of energy / external work", 0, drift(sink, last.external), 0.01,
                  "O(dt) ripple of the scheme");
  }
}

}  // namespace
}  // namespace scarp

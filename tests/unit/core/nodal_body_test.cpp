// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nodal form and the particle-state form by packs of particles against their oracle, the particle-state form one by
// one, on every instruction set that this processor has.
#include "solver/core/nodal_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/core/formulations.hpp"
#include "solver/core/run.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/run_options.hpp"

namespace scarp {
namespace {

using kernels::Kernels;

/// A wedge of regular and cut cells between rollers on a fixed base, part of a second material; `n` points per axis and
/// cell.
Model wedge(int dimension, const Material& material, int n, bool whole_cells = false) {
  Model model = test::empty_model({0, 0, 0}, {1.9, 1.0, dimension == 3 ? 0.3 : 0}, 0.1,
                                  {Condition::free, Condition::roller, Condition::fixed, Condition::free});
  if (dimension == 3) model.domain.faces[4] = Condition::roller;
  test::seed_body(
      model, "wedge", material, n, [](const Vec3& X) { return X[1] < 0.21 + 0.37 * X[0]; },
      [dimension](const Vec3& X) {
        return Vec3{0.6 * std::sin(2 * X[1]), -0.8 * X[0] * X[1], dimension == 3 ? 0.5 * X[0] * X[2] : 0};
      });
  model.materials.push_back({"other", Hencky{{1500, 30e6, 0.25}}});
  for (std::size_t p = 0; p < model.particles.size(); ++p)
    if (model.particles.reference_position[p][0] > (whole_cells ? 1.3 : 1.33)) {
      model.particles.material[p] = 1;
      model.particles.mass[p] *= 1500 / 1900.0;
    }
  return model;
}

/// Stress over the P-wave modulus, and so over what F - I of one would make: F is rounded at one, some of the wedge's
/// strains are a thousandth, and no form of the method could know their stress to more digits than their strain.
double largest_difference(const Particles& a, const Particles& b) {
  constexpr double modulus = 27e6;
  double stress = 0, rest = 0;
  for (std::size_t p = 0; p < a.size(); ++p) {
    for (int i = 0; i < 6; ++i) stress = std::max(stress, std::abs(a.stress[p][i] - b.stress[p][i]));
    for (int i = 0; i < 9; ++i)
      rest = std::max(rest, std::abs(a.deformation_gradient[p][i] - b.deformation_gradient[p][i]));
    rest = std::max({rest, norm(a.position[p] - b.position[p]), norm(a.velocity[p] - b.velocity[p]),
                     std::abs(a.equivalent_plastic_strain[p] - b.equivalent_plastic_strain[p])});
  }
  return std::max(rest, stress / modulus);
}

struct Case {
  const char* name;
  Material law;
};

std::vector<Case> cases() {
  std::vector<Case> all{{"neo-Hookean", NeoHookean{{1900, 20e6, 0.3}}},
                        {"Hencky", Hencky{{1900, 20e6, 0.3}}},
                        {"von Mises", VonMises{{1900, 20e6, 0.3}, 20e3, 1e6}},
                        {"Drucker-Prager", DruckerPrager{{1900, 20e6, 0.3}, 10e3, 28, 5, 4e3}},
                        {"Mohr-Coulomb", MohrCoulomb{{1900, 20e6, 0.3}, 10e3, 28, 5}},
                        {"Mohr-Coulomb, cut off", MohrCoulomb{{1900, 20e6, 0.3}, 10e3, 28, 0, 2e3}}};
  return all;
}

struct Outcome {
  Particles particles;
  HistorySample sample;
  NodeWork work;
};

Outcome take_steps(Model model, const SolverOptions& options, const Kernels& kernels, int steps = 100,
                   int threads = 1) {
  Formulations method(model, options, threads, kernels);
  Diagnostics diagnostics(model);
  const bool nodal = options.back_end == BackEnd::nodal;
  for (const std::string& obstacle : method.obstacles()) EXPECT_EQ(obstacle.empty(), nodal) << obstacle;
  for (int step = 0; step < steps; ++step) method.step(2e-4);
  EXPECT_LT(method.bad_particle(), 0);
  const HistorySample sample = method.measure(diagnostics);
  method.write_particles();
  return {model.particles, sample, method.work()};
}

SolverOptions options_of(int dimension, BackEnd back_end, double flip) {
  SolverOptions options = test::solver(1, dimension == 2 ? Vec3{0, -9.81, 0} : Vec3{0, 0, -9.81});
  options.back_end = back_end;
  options.flip = flip;
  options.damping = flip < 1 ? 0.1 : 0;
  options.gravity_ramp = 0.01;
  return options;
}

void expect_equal(const Outcome& oracle, const Outcome& nodal) {
  EXPECT_LT(largest_difference(oracle.particles, nodal.particles), 1e-12);
  const double size = oracle.sample.kinetic + oracle.sample.strain;
  for (auto part : {&HistorySample::kinetic, &HistorySample::strain, &HistorySample::plastic, &HistorySample::potential,
                    &HistorySample::total})
    EXPECT_NEAR(nodal.sample.*part, oracle.sample.*part, 1e-12 * size);
  EXPECT_LT(norm(nodal.sample.momentum - oracle.sample.momentum), 1e-12 * 100);
  EXPECT_GT(norm(oracle.sample.angular_momentum), 1);
  EXPECT_LT(norm(nodal.sample.angular_momentum - oracle.sample.angular_momentum), 1e-12 * 100);
  EXPECT_LT(norm(nodal.sample.centre - oracle.sample.centre), 1e-13);
  EXPECT_NEAR(nodal.work.friction, oracle.work.friction, 1e-12 * size);
  EXPECT_NEAR(nodal.work.damping, oracle.work.damping, 1e-12 * size);
  EXPECT_NEAR(nodal.work.external, oracle.work.external, 1e-12 * size);
}

TEST(NodalBodyTest, AgreesWithTheParticleStateFormAfterAHundredSteps) {
  for (int dimension : {2, 3})
    for (const Case& c : cases())
      for (int n : dimension == 2 ? std::vector{2, 3} : std::vector{2}) {
        const double flip = n == 2 ? 1 : 0.97;
        const Model model = wedge(dimension, c.law, n);
        const auto oracle = take_steps(model, options_of(dimension, BackEnd::particle_state, flip), Kernels{});
        if (!std::holds_alternative<NeoHookean>(c.law) && !std::holds_alternative<Hencky>(c.law)) {
          double most = 0;
          for (double a : oracle.particles.equivalent_plastic_strain) most = std::max(most, a);
          EXPECT_GT(most, 1e-4) << c.name;
        }
        for (const Kernels& kernels : kernels::available_kernels()) {
          SCOPED_TRACE(std::string(c.name) + ", " + kernels.name + ", " + std::to_string(dimension) + "D");
          const auto nodal = take_steps(model, options_of(dimension, BackEnd::nodal, flip), kernels);
          expect_equal(oracle, nodal);
          const auto packs = take_steps(model, options_of(dimension, BackEnd::particle_state, flip), kernels);
          expect_equal(oracle, packs);
        }
      }
}

TEST(NodalBodyTest, PacksOfParticlesGiveTheSameBitsForAnyNumberOfThreads) {
  for (int dimension : {2, 3}) {
    const Model model = wedge(dimension, MohrCoulomb{{1900, 20e6, 0.3}, 10e3, 28, 5}, 2);
    const SolverOptions options = options_of(dimension, BackEnd::particle_state, 1);
    const auto one = take_steps(model, options, kernels::best_kernels());
    for (int threads : {2, 3})
      EXPECT_EQ(largest_difference(one.particles,
                                   take_steps(model, options, kernels::best_kernels(), 100, threads).particles),
                0);
  }
}

// A run whose sink takes blocks keeps no state of its particles: what it is shown must be what a run that does has.
TEST(NodalBodyTest, ShowsItsParticlesInBlocks) {
  struct Blocks : FrameSink {
    std::vector<Particles> frames;
    Particles last;
    StepLimit limit;
    bool takes_blocks() const override { return true; }
    void frame(const Model& model, const ParticleStates& states, double, std::int64_t) override {
      EXPECT_TRUE(model.particles.position.empty() && model.particles.stress.empty());
      frames.emplace_back();
      states.read(0, states.count, frames.back());
    }
    void sample(const HistorySample&) override {}
    void progress(double, double, std::int64_t, double) override {}
    void end(const Model&, const ParticleStates& states) override {
      // Ranges that begin and end within cells.
      for (std::size_t begin = 0; begin < states.count; begin += 13) {
        Particles block;
        states.read(begin, std::min(states.count, begin + 13), block);
        for (std::size_t p = 0; p < block.size(); ++p)
          EXPECT_EQ(block.position[p], frames.back().position[begin + p]) << begin + p;
      }
    }
  };
  for (int dimension : {2, 3})
    for (AntiLocking anti_locking : {AntiLocking::none, AntiLocking::f_bar}) {
      const Model start = wedge(dimension, MohrCoulomb{{1900, 20e6, 0.3}, 10e3, 28, 5}, 2, true);
      SolverOptions options = options_of(dimension, BackEnd::nodal, 1);
      options.end_time = 0.01;
      options.anti_locking = anti_locking;
      Model whole = start, lean = start;
      drop_state(lean.particles);
      lean.particles.velocity = start.particles.velocity;
      test::RecordingSink recording;
      Blocks blocks;
      std::vector<Particles> frames;
      recording.on_frame = [&](const Model& model, double) { frames.push_back(model.particles); };
      OutputOptions output;
      output.every = 0.005;
      const RunReport a = run(whole, options, output, recording, 1), b = run(lean, options, output, blocks, 1);
      ASSERT_EQ(blocks.frames.size(), frames.size());
      for (std::size_t f = 0; f < frames.size(); ++f) {
        EXPECT_EQ(largest_difference(frames[f], blocks.frames[f]), 0) << f;
        EXPECT_EQ(frames[f].id, blocks.frames[f].id);
        EXPECT_EQ(frames[f].elastic_left_cauchy_green, blocks.frames[f].elastic_left_cauchy_green);
      }
      EXPECT_EQ(a.largest_displacement, b.largest_displacement);
      EXPECT_GT(b.largest_displacement, 0);
      EXPECT_EQ(a.step_limit.particle, b.step_limit.particle);
      EXPECT_TRUE(lean.particles.position.empty());
    }
}

// The particle that sets the step is found from nodes alone.
TEST(NodalBodyTest, NamesTheSameStiffestParticle) {
  for (int dimension : {2, 3})
    for (const Case& c : cases()) {
      StepLimit limits[2];
      for (BackEnd back_end : {BackEnd::nodal, BackEnd::particle_state}) {
        Model model = wedge(dimension, c.law, 2, true);
        Formulations method(model, options_of(dimension, back_end, 1), 1);
        for (int step = 0; step < 40; ++step) method.step(2e-4);  // a look falls on the last
        limits[back_end == BackEnd::nodal] = method.step_limit();
      }
      EXPECT_EQ(limits[0].particle, limits[1].particle) << c.name;
      EXPECT_NEAR(limits[0].wave_speed, limits[1].wave_speed, 1e-9 * limits[1].wave_speed) << c.name;
      EXPECT_LT(norm(limits[0].position - limits[1].position), 1e-12);
    }
}

/// Two parts of a body fly through each other: the cells between them, which hold no points, turn inside out. So do
/// places without a point in cells that are cut.
TEST(NodalBodyTest, PlacesWithoutPointsMayTurnInsideOut) {
  for (int dimension : {2, 3})
    for (AntiLocking anti_locking : {AntiLocking::none, AntiLocking::f_bar})
      for (const Case& c : cases()) {
        Model model = test::empty_model({0, 0, 0}, {1.5, 0.5, dimension == 3 ? 0.2 : 0}, 0.1);
        test::seed_body(
            model, "parts", c.law, 2, [](const Vec3& X) { return X[0] < 0.56 + 0.3 * X[1] || X[0] > 0.9; },
            [](const Vec3& X) {
              return Vec3{X[0] < 0.9 ? 12.0 : -12.0, 0.5 * std::sin(9 * X[0]), 0};
            });
        SolverOptions options = options_of(dimension, BackEnd::particle_state, 1);
        options.anti_locking = anti_locking;
        const auto oracle = take_steps(model, options, Kernels{});
        options.back_end = BackEnd::nodal;
        for (const Kernels& kernels : kernels::available_kernels()) {
          SCOPED_TRACE(std::string(c.name) + ", " + kernels.name + ", " + std::to_string(dimension) + "D");
          expect_equal(oracle, take_steps(model, options, kernels));
        }
      }
}

/// Few steps: whether a node sticks is a question of the last digit sooner or later.
/// In cells of one material: those of two have two segments, each with a mean of its own, and are left to the oracle.
TEST(NodalBodyTest, SeesTheMeanVolumeRatioOfTheCell) {
  for (int dimension : {2, 3})
    for (const Case& c : cases()) {
      SCOPED_TRACE(std::string(c.name) + ", " + std::to_string(dimension) + "D");
      const Model model = wedge(dimension, c.law, 2, true);
      SolverOptions options = options_of(dimension, BackEnd::particle_state, 1);
      options.anti_locking = AntiLocking::f_bar;
      const auto oracle = take_steps(model, options, Kernels{});
      options.back_end = BackEnd::nodal;
      expect_equal(oracle, take_steps(model, options, kernels::best_kernels()));
      Model mixed = wedge(dimension, c.law, 2);
      EXPECT_NE(Formulations(mixed, options, 1).obstacles()[0], "");
    }
}

TEST(NodalBodyTest, LeavesNodesWithConditionsToThem) {
  Model model = test::empty_model({0, 0, 0}, {1.6, 0.8, 0}, 0.1, {});
  model.domain.faces[0] = Face(FaceCondition::friction, 0.4);
  model.domain.faces[3] = Face(FaceCondition::absorbing);
  test::seed_body(model, "block", NeoHookean{{1900, 20e6, 0.3}}, 2, test::everywhere, [](const Vec3& X) {
    return Vec3{-0.5 - 0.1 * X[1], 0.4 * X[0], 0};
  });
  LoadOptions pull, drive;
  pull.where.box = {{1, 0, 0}, {1.2, 0.4, 0}};
  pull.force = Vec3{2e3, -1e3, 0};
  pull.table = {{0, 0}, {1e-3, 1}};
  drive.where.box = {{1.55, 0, 0}, {1.65, 0.8, 0}};
  drive.velocity = Vec3{0.3, 0, 0};
  drive.axes = "x";
  model.loads = {pull, drive};
  const auto oracle = take_steps(model, options_of(2, BackEnd::particle_state, 0.99), Kernels{}, 12);
  const auto nodal = take_steps(model, options_of(2, BackEnd::nodal, 0.99), kernels::best_kernels(), 12);
  EXPECT_GT(std::abs(oracle.work.friction), 0);
  EXPECT_GT(std::abs(oracle.work.external), 0);
  expect_equal(oracle, nodal);
}

TEST(NodalBodyTest, HasTheSameBitsForAnyNumberOfThreads) {
  Model model = test::empty_model({0, 0, 0}, {3.2, 3.2, 3.2}, 0.1, {});
  test::seed_body(
      model, "ball", MohrCoulomb{{1900, 20e6, 0.3}, 1e3, 28, 5}, 2,
      [](const Vec3& X) {
        return norm(X - Vec3{1.6, 1.6, 1.6}) < 1.55;
      },
      [](const Vec3& X) {
        return Vec3{X[1] * X[2], -X[0], std::sin(X[0])};
      });
  const SolverOptions options = test::solver(1, {0, 0, -9.81});
  std::vector<Particles> states;
  for (int threads : {1, 2, 3, 7}) {
    Model copy = model;
    Formulations method(copy, options, threads);
    for (int step = 0; step < 5; ++step) method.step(2e-4);
    method.write_particles();
    states.push_back(copy.particles);
  }
  for (std::size_t i = 1; i < states.size(); ++i) {
    EXPECT_EQ(states[0].position, states[i].position);
    EXPECT_EQ(states[0].stress, states[i].stress);
  }
}

TEST(NodalBodyTest, SaysWhyABodyCannotBeInThisForm) {
  MohrCoulomb soft{{1900, 20e6, 0.3}, 10e3, 28, 0};
  soft.residual_cohesion = 1e3;
  soft.softening_strain = 0.1;
  Model model = wedge(2, soft, 2);
  EXPECT_NE(Formulations(model, test::solver(1, {0, -9.81, 0}), 1).obstacles()[0].find("'wedge'"), std::string::npos);
  model = wedge(2, NeoHookean{{1900, 20e6, 0.3}}, 2);
  model.particles.stress[3][0] = 100;
  EXPECT_NE(Formulations(model, test::solver(1, {0, -9.81, 0}), 1).obstacles()[0], "");
}

TEST(NodalBodyTest, NamesTheParticleThatIsTurnedInsideOut) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, 0}, 0.1, {});
  test::seed_body(model, "sheet", NeoHookean{{1000, 1e4, 0.3}}, 2, test::everywhere, [](const Vec3& X) {
    return Vec3{X[0] > 0.5 ? -400.0 : 400.0, 0, 0};
  });
  Formulations method(model, test::solver(1, {0, 0, 0}), 1);
  for (int step = 0; step < 10 && method.bad_particle() < 0; ++step) method.step(1e-4);
  const auto failure = method.failure();
  ASSERT_TRUE(failure.has_value());
  EXPECT_NE(failure->what.find("inside out"), std::string::npos) << failure->what;
  EXPECT_NEAR(failure->position[0], 0.5, 0.11);
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/core/run.hpp"

#include <gtest/gtest.h>

#include "solver/core/estimate.hpp"
#include "solver/core/make_frame.hpp"
#include "solver/core/output_clock.hpp"
#include "solver/model/error.hpp"
#include "tests/support/lattice_seed.hpp"
#include "tests/support/recording_sink.hpp"

namespace scarp {
namespace {

using test::RecordingSink;

const NeoHookean kRubber{{1000, 1e5, 0.3}};

Model block(int dimension, std::array<Condition, 6> faces = {}) {
  Model model = test::empty_model({0, 0, 0}, {1, 1, dimension == 3 ? 1.0 : 0.0}, 0.25, faces);
  test::seed_body(model, "block", kRubber, 2, test::everywhere);
  return model;
}

SolverOptions until(double end_time, Vec3 gravity = {0, 0, 0}) {
  SolverOptions options;
  options.end_time = end_time;
  options.gravity = gravity;
  return options;
}

TEST(Run, OutputTimesAreMetExactlyWithoutSlivers) {
  Model model = block(2);
  RecordingSink sink;
  OutputOptions output;
  output.every = 0.1;
  output.history_every = 0.03;
  const RunReport report = run(model, until(0.35), output, sink, 1);
  EXPECT_FALSE(report.failed);
  EXPECT_EQ(sink.frame_times, (std::vector<double>{0, 0.1, 2 * 0.1, 3 * 0.1, 0.35}));
  std::vector<double> times;
  for (const HistorySample& s : sink.samples) times.push_back(s.time);
  ASSERT_EQ(times.size(), 15u);  // 0, eleven multiples of 0.03 (0.3 is also a frame's), 0.1, 0.2, 0.35
  EXPECT_DOUBLE_EQ(times[1], 0.03);
  EXPECT_EQ(times[4], 0.1);
  EXPECT_EQ(times.back(), 0.35);
  EXPECT_EQ(report.end_time, 0.35);
  EXPECT_EQ(report.steps, static_cast<std::int64_t>(sink.steps.size()));
  EXPECT_EQ(report.particle_steps, report.steps * 64);
  const double stable = 0.4 * 0.25 / kRubber.wave_speed();
  for (double dt : sink.steps) {
    EXPECT_LE(dt, stable * (1 + 1e-12));
    EXPECT_GE(dt, 0.49 * stable);
  }
}

TEST(Run, DefaultIntervals) {
  Model model = block(2);
  RecordingSink sink;
  run(model, until(1), {}, sink, 1);
  EXPECT_EQ(sink.frame_times.size(), 21u);
  EXPECT_EQ(sink.samples.size(), 201u);
}

TEST(Run, DefaultGravityPointsDown) {
  for (int dimension : {2, 3}) {
    Model model = block(dimension);
    RecordingSink sink;
    SolverOptions options;
    options.end_time = 0.01;
    run(model, options, {}, sink, 1);
    EXPECT_NEAR(model.particles.velocity[0][dimension - 1], -0.0981, 1e-12);
  }
}

TEST(Run, SameBitsForAnyNumberOfThreads) {
  for (int dimension : {2, 3}) {
    Particles first;
    std::vector<HistorySample> samples;
    for (int threads : {1, 2, 3}) {
      Model model = test::empty_model({0, 0, 0}, {3, 2, dimension == 3 ? 1.0 : 0.0}, dimension == 3 ? 0.2 : 0.05,
                                      {Condition::roller, Condition::roller, Condition::fixed});
      test::seed_body(model, "soil", MohrCoulomb{{1900, 1e6, 0.3}, 500, 25, 5}, 2,
                      [](const Vec3& X) { return X[1] < 2 - 0.5 * X[0]; });
      // Every third particle is of another law: mixed cells.
      model.materials.push_back({"rubber", kRubber});
      for (std::size_t p = 0; p < model.particles.size(); p += 3) model.particles.material[p] = 1;
      RecordingSink sink;
      OutputOptions output;
      output.every = 0.01;
      output.history_every = 0.005;
      const RunReport report = run(model, until(0.03, {0.5, -9.81, 0}), output, sink, threads);
      EXPECT_FALSE(report.failed);
      if (threads == 1) {
        first = model.particles;
        samples = sink.samples;
        EXPECT_GT(sink.samples.back().plastic, 0);
        continue;
      }
      for_each_field(model.particles, [&](const char* name, const char*, const auto& values, const auto&) {
        for_each_field(first, [&](const char* other, const char*, const auto& expected, const auto&) {
          if constexpr (std::is_same_v<decltype(values), decltype(expected)>) {
            if (std::string(name) == other) {
              EXPECT_EQ(values, expected) << name;
            }
          }
        });
      });
      ASSERT_EQ(sink.samples.size(), samples.size());
      for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(sink.samples[i].total, samples[i].total);
    }
  }
}

TEST(Run, HeldNodesAndFacesKeepTheirVelocityAtZero) {
  Model model = block(3);
  Body& body = model.bodies[0];
  NodeSet base{"base", Condition::fixed, -1, {}}, side{"side", Condition::roller, 0, {}};
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j) {
      base.nodes.push_back({i, j, 0});
      side.nodes.push_back({0, i, j});
    }
  base.nodes.push_back({99, 0, 0});  // not a node of the grid: nothing to hold
  body.held = {base, side};
  Model by_faces = block(3, {Condition::roller, Condition::free, Condition::free, Condition::free, Condition::fixed});
  RecordingSink a, b;
  EXPECT_FALSE(run(model, until(0.1, {-3, 0, -9.81}), {}, a, 1).failed);
  EXPECT_FALSE(run(by_faces, until(0.1, {-3, 0, -9.81}), {}, b, 1).failed);
  EXPECT_EQ(model.particles.position, by_faces.particles.position);
  EXPECT_GT(model.particles.position[0][2], 0.9 * model.particles.reference_position[0][2]);
  body.held = {{"bad", Condition::roller, 3, {{0, 0, 0}}}};
  EXPECT_THROW(run(model, until(0.1), {}, a, 1), Error);
}

TEST(RunFailure, AnInvertedParticleIsNamedWithItsStepTimeAndPlace) {
  Model model = test::empty_model({0, 0, 0}, {2, 1, 0}, 0.25);
  // Two halves driven into each other at nine times the speed of sound.
  test::seed_body(model, "block", kRubber, 2, test::everywhere, [](const Vec3& X) {
    return Vec3{X[0] < 1 ? 100.0 : -100.0, 0, 0};
  });
  RecordingSink sink;
  const RunReport report = run(model, until(1), {}, sink, 1);
  EXPECT_TRUE(report.failed);
  EXPECT_EQ(report.failure.what, "a particle is turned inside out (J = det F <= 0)");
  EXPECT_GE(report.failure.particle, 0);
  EXPECT_NEAR(report.failure.position[0], 1, 0.5);
  EXPECT_EQ(report.failure.step, report.steps);
  EXPECT_GT(report.failure.time, 0);
  EXPECT_EQ(sink.frame_times, std::vector<double>{0});  // nothing after the failure
  const RunReport again = [] {
    Model m = test::empty_model({0, 0, 0}, {2, 1, 0}, 0.25);
    test::seed_body(m, "block", kRubber, 2, test::everywhere, [](const Vec3& X) {
      return Vec3{X[0] < 1 ? 100.0 : -100.0, 0, 0};
    });
    RecordingSink s;
    return run(m, until(1), {}, s, 3);
  }();
  EXPECT_EQ(again.failure.particle, report.failure.particle);
}

TEST(RunFailure, SomethingNotFiniteIsNamed) {
  Model model = block(2);
  model.particles.velocity[7] = {1e300, -1e300, 0};
  RecordingSink sink;
  const RunReport report = run(model, until(1e-3), {}, sink, 1);
  EXPECT_TRUE(report.failed);
  EXPECT_EQ(report.failure.what, "the deformation or the stress of a particle is not finite");
  EXPECT_GE(report.failure.particle, 0);
  EXPECT_EQ(report.failure.step, 1);
}

TEST(RunFailure, ARunWithoutEndIsRefusedBeforeItRelaxes) {
  Model model = block(2);
  std::get<NeoHookean>(model.materials[0].law).youngs_modulus = 1e300;
  SolverOptions options;
  options.end_time = 1;
  options.relax = RelaxOptions{};
  test::RecordingSink sink;
  try {
    run(model, options, {}, sink, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("too short for the end time"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(sink.frame_times.empty());
}

TEST(RunFailure, MaxStepsIsAFailureWithWhatWasReached) {
  Model model = block(2);
  RecordingSink sink;
  SolverOptions options = until(10);
  options.max_steps = 5;
  const RunReport report = run(model, options, {}, sink, 1);
  EXPECT_TRUE(report.failed);
  EXPECT_EQ(report.failure.what, "max_steps reached before the end time");
  EXPECT_EQ(report.failure.step, 5);
  EXPECT_EQ(report.failure.particle, -1);
  EXPECT_EQ(report.failure.time, report.end_time);
  EXPECT_GT(report.end_time, 0);
}

TEST(RunFailure, AnInvalidStartIsAFailureBeforeTheFirstFrame) {
  Model model = block(2);
  model.particles.deformation_gradient[3] = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
  RecordingSink sink;
  const RunReport report = run(model, until(1), {}, sink, 1);
  EXPECT_TRUE(report.failed);
  EXPECT_EQ(report.failure.step, 0);
  EXPECT_TRUE(sink.frame_times.empty());
  EXPECT_TRUE(sink.samples.empty());
}

/// A column of cells between plates that close at a tenth of the wave speed: the step falls with the gap.
TEST(RunFailure, ACollapsedTimeStepEndsTheRun) {
  const NeoHookean rubber{{1000, 1e6, 0.3}};
  for (BackEnd back_end : {BackEnd::nodal, BackEnd::particle_state}) {
    Model model = test::empty_model({0, 0, 0}, {1, 3, 0}, 1);
    test::seed_body(model, "column", rubber, 2, test::everywhere);
    LoadOptions plate;
    plate.where.box = {{0, 0, 0}, {0, 3, 0}};
    plate.velocity = Vec3{0, 0, 0};
    model.loads = {plate, plate};
    model.loads[1].where.box = {{1, 0, 0}, {1, 3, 0}};
    model.loads[1].velocity = Vec3{-0.1 * rubber.wave_speed(), 0, 0};
    SolverOptions options = until(1);
    options.back_end = back_end;
    RecordingSink sink;
    const RunReport report = run(model, options, {}, sink, 1);
    EXPECT_TRUE(report.failed);
    EXPECT_EQ(report.failure.what.rfind("the time step has collapsed", 0), 0u) << report.failure.what;
    EXPECT_GT(report.failure.step, 100);
    EXPECT_NEAR(report.end_time, 10 / rubber.wave_speed(), 1e-4);
  }
}

TEST(Run, RefusesModelsAndOptionsThatCannotRun) {
  RecordingSink sink;
  const auto refused = [&](auto change, const std::string& words) {
    Model model = block(2);
    SolverOptions options = until(1);
    OutputOptions output;
    change(model, options, output);
    try {
      run(model, options, output, sink, 1);
      ADD_FAILURE() << "not refused: " << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused([](Model& m, auto&, auto&) { m.particles.mass[2] = -1; }, "mass of particle 2 of body 'block': found -1");
  refused([](Model& m, auto&, auto&) { m.particles.material[2] = 4; }, "material of particle 2");
  refused([](Model& m, auto&, auto&) { m.particles.velocity[2] = {0, 0, 1}; }, "motion out of the plane");
  refused([](Model& m, auto&, auto&) { m.particles.velocity[2] = {NAN, 0, 0}; }, "velocity of particle 2");
  refused([](Model& m, auto&, auto&) { m.particles.stress.pop_back(); }, "particle field 'stress'");
  refused([](Model& m, auto&, auto&) { m.bodies[0].end -= 1; }, "belong to a body");
  refused([](Model& m, auto&, auto&) { std::get<NeoHookean>(m.materials[0].law).density = 0; }, "density");
  refused([](auto&, SolverOptions& o, auto&) { o.end_time = 0; }, "end_time");
  refused([](auto&, SolverOptions& o, auto&) { o.gravity = Vec3{0, 0, -9.81}; }, "gravity");
  refused([](auto&, auto&, OutputOptions& o) { o.every = -1; }, "every: found -1");
}

TEST(MakeFrame, CarriesWhatIsAskedAndWhatIsAlwaysThere) {
  Model model = block(3);
  model.site.origin = {500000, 4000000, 0};
  Particles& p = model.particles;
  p.deformation_gradient[0] = {2, 0, 0, 0, 1, 0, 0, 0, 1};
  p.stress[0] = {30, 0, 0, 0, 0, 4};
  p.position[0] = p.reference_position[0] + Vec3{0.5, 0, 0};
  p.colour[0] = {10, 20, 30};
  const Frame frame = make_frame(
      model,
      {OutputField::displacement, OutputField::stress, OutputField::mean_stress, OutputField::von_mises_stress,
       OutputField::volume_ratio, OutputField::density, OutputField::deformation_gradient, OutputField::stress},
      1.5, 12);
  EXPECT_EQ(frame.positions, p.position);
  EXPECT_EQ(frame.site.origin, model.site.origin);
  EXPECT_EQ(frame.fields.size(), 13u);
  const auto first = [&](const char* name) { return std::get<std::vector<float>>(find_field(frame, name)->values)[0]; };
  EXPECT_EQ(std::get<std::vector<std::int64_t>>(find_field(frame, "id")->values), p.id);
  EXPECT_EQ(find_field(frame, "colour")->components, 3);
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(find_field(frame, "colour")->values)[2], 30);
  EXPECT_EQ(first("displacement"), 0.5f);
  EXPECT_EQ(find_field(frame, "stress")->components, 6);
  EXPECT_EQ(first("stress"), 30.0f);
  EXPECT_EQ(first("mean_stress"), 10.0f);
  EXPECT_FLOAT_EQ(first("von_mises_stress"), std::sqrt(900.0f + 48.0f));
  EXPECT_EQ(first("volume_ratio"), 2.0f);
  EXPECT_EQ(first("volume"), static_cast<float>(2 * p.reference_volume[0])) << "in the current configuration";
  EXPECT_EQ(find_field(frame, "volume")->unit, model.domain.dimension == 2 ? "m3/m" : "m3");
  EXPECT_EQ(first("density"), 500.0f);
  EXPECT_EQ(find_field(frame, "density")->unit, "kg/m3");
  EXPECT_EQ(find_field(frame, "deformation_gradient")->components, 9);
}

TEST(Estimate, AgreesWithTheRun) {
  Model model = block(3);
  OutputOptions output;
  output.every = output.history_every = 0.25;
  const RunEstimate estimated = estimate(model, until(0.5), output);
  RecordingSink sink;
  const RunReport report = run(model, until(0.5), output, sink, 1);
  EXPECT_NEAR(estimated.time_step, report.largest_dt, 1e-9 * estimated.time_step);
  EXPECT_NEAR(estimated.steps, static_cast<double>(report.steps), 2);
  EXPECT_EQ(estimated.particle_steps, estimated.steps * 512);
  EXPECT_GT(estimated.memory_bytes, 512 * 60.0) << "a few nodes stand for the state of many particles";
  EXPECT_LT(estimated.memory_bytes, 512 * 120.0);
  SolverOptions stored = until(0.5);
  stored.back_end = BackEnd::particle_state;
  EXPECT_GT(estimate(model, stored, output).memory_bytes, 512 * 300.0);
  EXPECT_LT(estimate(model, stored, output).memory_bytes, 512 * 600.0);
}

}  // namespace
}  // namespace scarp

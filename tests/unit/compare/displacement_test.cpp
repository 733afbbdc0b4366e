// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/displacement.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>
#include <random>

#include "solver/model/error.hpp"
#include "tools/compare/block_motion.hpp"

namespace scarp {
namespace {

/// Ground with bumps of several sizes, m.
double bumps(double x, double y) {
  return 0.2 * x + 0.5 * std::sin(0.9 * x + 0.3 * y) * std::cos(0.7 * y) + 0.15 * std::sin(2.3 * x - 1.1 * y) +
         0.08 * std::cos(3.7 * y + 1.9 * x);
}

/// A rigid motion about a point.
struct Motion {
  Vec3 centre{0, 0, 0}, axis{0, 0, 1};
  double angle = 0;  ///< rad
  Vec3 shift{0, 0, 0};

  Vec3 of(const Vec3& p) const {  // Rodrigues
    const Vec3 d = p - centre;
    const double c = std::cos(angle), s = std::sin(angle);
    return centre + c * d + s * cross(axis, d) + ((1 - c) * dot(axis, d)) * axis + shift;
  }
};

/// A survey of ground of 2 half x 2 half metres that moved so, with noise across it; never the same points twice.
std::vector<Vec3> survey(const Motion& motion, double half, std::size_t count, double noise, unsigned seed,
                         const std::function<double(double, double)>& ground = bumps) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-half, half);
  std::normal_distribution<double> normal(0, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    const double x = unit(random), y = unit(random);
    p = motion.of({x, y, ground(x, y) + noise * normal(random)});
  }
  return points;
}

const MotionSettings kSettings{
    .reach = 2, .minimum_points = 30, .least_overlap = 0.8, .largest_residual = 0.1, .largest_sigma = 0.1};

std::vector<Vec3> within(const std::vector<Vec3>& points, double half) {
  std::vector<Vec3> inner;
  for (const Vec3& p : points)
    if (std::abs(p[0]) < half && std::abs(p[1]) < half) inner.push_back(p);
  return inner;
}

TEST(BlockMotion, FindsARigidMotionAndHowWellItIsKnown) {
  // The error over its standard deviation, of blocks that know nothing of each other.
  const Motion motion{{0, 0, 0}, (1 / std::sqrt(1.25)) * Vec3{0.5, 0, 1}, 0.06, {0.35, -0.2, -0.15}};
  double squares = 0, largest = 0, worst = 0;
  constexpr int kRepeats = 8;
  for (unsigned k = 0; k < kRepeats; ++k) {
    const std::vector<Vec3> before = within(survey({}, 8, 6000, 0.01, 2 * k + 1), 4);
    const MovedSurface after(survey(motion, 8, 6000, 0.01, 2 * k + 2), 1);
    const BlockMotion found = after.motion_of(before, kSettings);
    ASSERT_EQ(found.flags, 0) << int(found.flags);
    const Vec3 truth = motion.of(found.at) - found.at;
    for (std::size_t a = 0; a < 3; ++a) {
      const double error = found.displacement[a] - truth[a];
      squares += std::pow(error / found.sigma[a], 2) / (3 * kRepeats);
      largest = std::max(largest, std::abs(error));
    }
    worst = std::max(worst, std::abs(found.rotation - 0.06 * 180 / std::numbers::pi));
    EXPECT_GT(found.overlap, 0.99);
    // Noise of a point and a twelfth of it in the plane; planes 0.8 m wide also cut off bumps whose curvature is near
    // 1 / m, up to 0.4^2 / 8 m of them.
    EXPECT_GT(found.residual, 0.01);
    EXPECT_LT(found.residual, 0.01 * std::sqrt(13.0 / 12) + 0.02);
  }
  std::printf("| block of 8 m, noise 10 mm | largest error %.2f mm | error / sigma %.2f | rotation within %.3f deg |\n",
              1e3 * largest, std::sqrt(squares), worst);
  EXPECT_LT(largest, 0.005) << "half the noise of a single point";
  EXPECT_LT(worst, 0.1);
  // Errors of the planes are shared by the points that they are the nearest to: sigma is somewhat too small.
  EXPECT_LT(std::sqrt(squares), 2);
  EXPECT_GT(std::sqrt(squares), 0.5);
}

TEST(BlockMotion, OfAPlaceOffTheMiddleGoesWithTheTurn) {
  const Motion motion{{0, 0, 0}, {0, 0, 1}, 0.1, {0.1, 0, 0}};
  const std::vector<Vec3> before = within(survey({}, 8, 12000, 0, 1), 3);
  const MovedSurface after(survey(motion, 8, 12000, 0, 2), 1);
  const Vec3 place{2, -1, bumps(2, -1)};
  const BlockMotion found = after.motion_of(before, kSettings, &place);
  const Vec3 truth = motion.of(place) - place;
  EXPECT_EQ(found.at, place);
  EXPECT_GT(norm(truth), 0.2);
  for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(found.displacement[a], truth[a], 0.005);
}

TEST(BlockMotion, SaysWhyItIsNotKnown) {
  const auto flags_of = [](const std::vector<Vec3>& before, const std::vector<Vec3>& after) {
    const BlockMotion found = MovedSurface(after, 1).motion_of(before, kSettings);
    EXPECT_EQ(std::isnan(found.displacement[0]), found.flags != 0);
    return int(found.flags);
  };
  const std::vector<Vec3> block = within(survey({}, 8, 5000, 0.01, 1), 4);
  EXPECT_EQ(flags_of(block, survey({}, 8, 5000, 0.01, 2)), 0);
  EXPECT_EQ(flags_of({block.begin(), block.begin() + 20}, survey({}, 8, 5000, 0.01, 2)), kFewPoints);
  EXPECT_TRUE(flags_of(block, within(survey({}, 8, 5000, 0.01, 2), 2)) & kLittleOverlap);
  EXPECT_TRUE(flags_of(block, survey({{}, {0, 0, 1}, 0, {50, 0, 0}}, 8, 5000, 0.01, 2)) & kLittleOverlap);
  // A plane that slides in itself looks the same, and so does a cylinder along its axis.
  const auto plane = [](double x, double) { return 0.3 * x; };
  EXPECT_TRUE(flags_of(within(survey({}, 8, 5000, 0.01, 1, plane), 4), survey({}, 8, 5000, 0.01, 2, plane)) &
              kUndetermined);
  const auto ridges = [](double x, double) { return 0.5 * std::sin(x); };
  EXPECT_TRUE(flags_of(within(survey({}, 8, 5000, 0.01, 1, ridges), 4), survey({}, 8, 5000, 0.01, 2, ridges)) &
              kUndetermined);
  // Other ground is no moved ground.
  const auto other = [](double x, double y) { return 0.2 * x + std::sin(2.1 * x) * std::sin(2.9 * y); };
  EXPECT_TRUE(flags_of(block, survey({}, 8, 5000, 0.01, 2, other)) & kLargeResidual);
}

PointCloud cloud_of(std::vector<Vec3> positions, const Vec3& origin = {0, 0, 0}) {
  PointCloud cloud;
  cloud.positions = std::move(positions);
  cloud.site.origin = origin;
  return cloud;
}

/// A block of material points, 0.25 m apart, under the ground, that strained and turned evenly.
Frame frame_of(const std::function<Vec3(const Vec3&)>& displacement) {
  Frame frame;
  std::vector<float> u, volume;
  constexpr double h = 0.25;
  for (double x = -8 + h / 2; x < 8; x += h)
    for (double y = -8 + h / 2; y < 8; y += h)
      for (double z = bumps(x, y) - h / 2; z > bumps(x, y) - 4 * h; z -= h) {
        const Vec3 d = displacement({x, y, z});
        frame.positions.push_back(Vec3{x, y, z} + d);
        for (double c : d) u.push_back(static_cast<float>(c));
        volume.push_back(static_cast<float>(h * h * h));
      }
  frame.fields = {{"displacement", "m", 3, u}, {"volume", "m3", 1, volume}};
  return frame;
}

TEST(SimulatedDisplacements, AreExactWhereTheyAreLinear) {
  const auto linear = [](const Vec3& X) {
    return Vec3{0.3 + 0.02 * X[0] - 0.1 * X[1] + 0.05 * X[2], -0.2 + 0.1 * X[0], 0.04 * X[1] - 0.03 * X[2]};
  };
  const std::vector<Vec3> places{{1, 2, bumps(1, 2)}, {-3.3, 0.4, bumps(-3.3, 0.4)}, {100, 0, 0}};
  const std::vector<Vec3> found = simulated_displacements(frame_of(linear), places, 2);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(found[i][a], linear(places[i])[a], 2e-6) << "floats";
  EXPECT_TRUE(std::isnan(found[2][0])) << "no material there";
  Frame bare = frame_of(linear);
  bare.fields.erase(bare.fields.begin());
  EXPECT_THROW(simulated_displacements(bare, places, 1), Error);
}

CompareOptions options_for(double block) {
  CompareOptions options;
  options.name = "d";
  options.method = CompareMethod::displacement;
  options.max_distance = 2;
  options.displacement.block = block;
  return options;
}

double number(const ComparisonReport& report, const std::string& group, const std::string& name) {
  for (const MeasureGroup& g : report.groups)
    for (const Measure& m : g.measures)
      if (g.name == group && m.name == name) {
        if (const double* v = std::get_if<double>(&m.value)) return *v;
        if (const auto* v = std::get_if<std::int64_t>(&m.value)) return static_cast<double>(*v);
      }
  ADD_FAILURE() << group << "." << name;
  return 0;
}

const std::vector<double>& field(const Comparison& result, const std::string& name) {
  for (const PointScalar& scalar : result.cloud.scalars)
    if (scalar.name == name) return scalar.values;
  throw std::runtime_error("no field " + name);
}

TEST(CompareDisplacement, HoldsBlocksAgainstTheSimulation) {
  // What happened turned a little more than what was simulated.
  const Motion happened{{0, 0, 0}, {0, 0, 1}, 0.05, {0.4, 0, -0.1}},
      computed{{0, 0, 0}, {0, 0, 1}, 0.04, {0.4, 0, -0.1}};
  DisplacementSources sources;
  const Vec3 origin{500000, 4100000, 0};
  sources.before = cloud_of(survey({}, 8, 10000, 0.005, 1));
  sources.after = cloud_of(survey(happened, 8, 10000, 0.005, 2), origin);
  sources.before->site.origin = origin;
  sources.simulated = frame_of([&](const Vec3& X) { return computed.of(X) - X; });
  sources.simulated->site.origin = origin;
  const Comparison result = compare_displacement(sources, options_for(4), 2);
  ASSERT_EQ(result.cloud.size(), 16u);
  std::size_t known = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    const Vec3& at = result.cloud.positions[i];
    if (std::isnan(field(result, "dx")[i])) continue;
    ++known;
    const Vec3 truth = happened.of(at) - at, simulated = computed.of(at) - at;
    EXPECT_NEAR(field(result, "dy")[i], truth[1], 0.01);
    EXPECT_NEAR(field(result, "simulated_dx")[i], simulated[0], 1e-4);
    EXPECT_NEAR(field(result, "difference_dx")[i], truth[0] - simulated[0], 0.01);
    EXPECT_NEAR(field(result, "distance")[i], norm(truth - simulated), 0.015);
  }
  EXPECT_GE(known, 12u) << "at the corners ground went where no survey is";
  EXPECT_EQ(number(result.report, "vectors", "known"), static_cast<double>(known));
  EXPECT_EQ(number(result.report, "simulated_vectors", "both"), static_cast<double>(known));
  EXPECT_LT(number(result.report, "simulated_vectors", "median_angle"), 20);
  EXPECT_GT(number(result.report, "simulated_vectors", "significant"), 8) << "centimetres against millimetres";
  EXPECT_EQ(result.report.distances->matched, known);
}

TEST(CompareDisplacement, TakesMeasuredTargetsAsTheyAre) {
  DisplacementSources sources;
  sources.simulated = frame_of([](const Vec3&) { return Vec3{0.5, 0, 0}; });
  sources.targets = cloud_of({{1, 1, bumps(1, 1)}, {2, -3, bumps(2, -3)}, {99, 0, 0}});
  sources.targets->scalars = {{"dx", "m", {0.5, 0.7, 1}}, {"dy", "m", {0, 0, 0}}, {"dz", "m", {0, -0.1, 0}}};
  for (const char* name : {"sigma_x", "sigma_y", "sigma_z"})
    sources.targets->scalars.push_back({name, "m", {0.02, 0.02, 0.02}});
  CompareOptions options = options_for(0);
  options.max_distance = 0;
  const Comparison result = compare_displacement(sources, options, 1);
  EXPECT_NEAR(field(result, "distance")[0], 0, 1e-6);
  EXPECT_NEAR(field(result, "distance")[1], std::hypot(0.2, 0.1), 1e-6);
  EXPECT_TRUE(std::isnan(field(result, "distance")[2]));
  EXPECT_EQ(number(result.report, "simulated_vectors", "judged"), 2);
  EXPECT_EQ(number(result.report, "simulated_vectors", "significant"), 1);
  EXPECT_EQ(number(result.report, "vectors", "known"), 3);
}

TEST(CompareDisplacement, FindsVectorsAtTargetsBetweenSurveys) {
  const Motion motion{{0, 0, 0}, {0, 0, 1}, 0.05, {0.3, 0.1, 0}};
  DisplacementSources sources;
  sources.before = cloud_of(survey({}, 8, 10000, 0.005, 1));
  sources.after = cloud_of(survey(motion, 8, 10000, 0.005, 2));
  sources.targets = cloud_of({{1, 1, bumps(1, 1)}, {-2, 3, bumps(-2, 3)}, {50, 0, 0}});
  const Comparison result = compare_displacement(sources, options_for(5), 2);
  EXPECT_EQ(result.cloud.positions, sources.targets->positions);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 truth = motion.of(result.cloud.positions[i]) - result.cloud.positions[i];
    EXPECT_NEAR(field(result, "dx")[i], truth[0], 0.01);
    EXPECT_NEAR(field(result, "length")[i], norm(truth), 0.01);
    EXPECT_EQ(field(result, "distance")[i], field(result, "length")[i]) << "nothing is simulated";
  }
  EXPECT_EQ(field(result, "flags")[2], kFewPoints);
}

TEST(CompareDisplacement, TheSameBitsForAnyThreadsAndRefusals) {
  DisplacementSources sources;
  sources.before = cloud_of(survey({}, 4, 4000, 0.01, 1));
  sources.after = cloud_of(survey({{}, {0, 0, 1}, 0.02, {0.1, 0, 0}}, 4, 4000, 0.01, 2));
  const Comparison one = compare_displacement(sources, options_for(2), 1);
  const Comparison three = compare_displacement(sources, options_for(2), 3);
  for (std::size_t k = 0; k < one.cloud.scalars.size(); ++k)
    for (std::size_t i = 0; i < one.cloud.size(); ++i)
      EXPECT_TRUE(one.cloud.scalars[k].values[i] == three.cloud.scalars[k].values[i] ||
                  std::isnan(one.cloud.scalars[k].values[i]));
  EXPECT_THROW(compare_displacement(sources, options_for(0), 1), Error);
  CompareOptions options = options_for(2);
  options.max_distance = 0;
  EXPECT_THROW(compare_displacement(sources, options, 1), Error);
  sources.before.reset();
  EXPECT_THROW(compare_displacement(sources, options_for(2), 1), Error);
  sources.targets = cloud_of({{0, 0, 0}});
  EXPECT_THROW(compare_displacement(sources, options_for(2), 1), Error);
}

}  // namespace
}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/error_propagation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>
#include <numbers>
#include <random>

#include "solver/model/error.hpp"
#include "tools/compare/m3c2.hpp"

namespace scarp {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
using Random = std::mt19937_64;

double normal(Random& random) { return std::normal_distribution<double>()(random); }

/// Measures a point again with errors of range and angles: the oracle, which knows no derivative.
Vec3 measured(const Vec3& point, const Vec3& scanner, const ScannerOptions& options, Random& random) {
  const Vec3 d = point - scanner;
  const double r = norm(d), sigma = std::hypot(options.sigma_range, options.range_scale * r);
  const double range = r + sigma * normal(random);
  const double azimuth = std::atan2(d[1], d[0]) + kDegree * options.sigma_azimuth * normal(random);
  const double elevation = std::asin(d[2] / r) + kDegree * options.sigma_elevation * normal(random);
  return scanner + range * Vec3{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation)};
}

/// Twelve numbers with this covariance.
std::array<double, 12> transformation(const AlignmentCovariance& C, Random& random) {
  Eigen::Map<const Eigen::Matrix<double, 12, 12, Eigen::RowMajor>> covariance(C.data());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  Eigen::VectorXd z(12);
  for (int i = 0; i < 12; ++i) z[i] = normal(random) * std::sqrt(std::max(0.0, solver.eigenvalues()[i]));
  const Eigen::VectorXd drawn = solver.eigenvectors() * z;
  std::array<double, 12> change;
  for (int i = 0; i < 12; ++i) change[static_cast<std::size_t>(i)] = drawn[i];
  return change;
}

Vec3 moved(const Vec3& p, const Vec3& centre, const std::array<double, 12>& change) {
  const Vec3 d = p - centre;
  Vec3 result = p;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] += dot({change[3 * i], change[3 * i + 1], change[3 * i + 2]}, d) + change[9 + i];
  return result;
}

/// A patch of a slope that two scanners see from afar.
struct Scene {
  std::vector<Vec3> first, second;
  SurveyErrors errors;
  Vec3 n{-0.48, 0.2, 0.85};

  Scene() {
    n = (1 / norm(n)) * n;
    Random random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (auto* points : {&first, &second})
      for (int i = 0; i < (points == &first ? 23 : 31); ++i) {
        const double x = 40 + unit(random), y = 25 + unit(random);
        points->push_back({x, y, -(n[0] * (x - 40) + n[1] * (y - 25)) / n[2] + 3});
      }
    errors.simulated.scanner = {{{0, 0, 2}}, 0.004, 2e-5, 0.02, 0.01};
    errors.observed.scanner = {{{5, -3, 1}, {60, 70, 20}}, 0.006, 0, 0.004, 0.03};
    for (std::size_t i = 0; i < second.size(); ++i) errors.observed.scanner_of.push_back(i % 3 == 0);
    errors.centre = {20, 30, 0};
    errors.alignment = rigid_alignment(0.003, 1e-4);
    // Correlated as after an adjustment: a shift along x goes with one along z, and with a turn.
    const auto couple = [&](std::size_t i, std::size_t j, double v) {
      errors.alignment[12 * i + j] += v;
      errors.alignment[12 * j + i] += v;
    };
    couple(9, 11, 4e-6);
    couple(2, 9, 1e-7);
    couple(6, 9, -1e-7);
  }

  std::vector<std::uint32_t> all(const std::vector<Vec3>& points) const {
    std::vector<std::uint32_t> members(points.size());
    for (std::size_t i = 0; i < members.size(); ++i) members[i] = static_cast<std::uint32_t>(i);
    return members;
  }

  /// The distance found in one repetition of both surveys and of their alignment.
  double repeated(Random& random) const {
    const auto mean_along = [&](const std::vector<Vec3>& points, const SideErrors& side, bool observed) {
      const auto change = transformation(errors.alignment, random);
      double sum = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t scanner = side.scanner_of.empty() ? 0 : side.scanner_of[i];
        Vec3 p = measured(points[i], side.scanner.positions[scanner], side.scanner, random);
        if (observed) p = moved(p, errors.centre, change);
        sum += dot(p, n);
      }
      return sum / static_cast<double>(points.size());
    };
    return mean_along(second, errors.observed, true) - mean_along(first, errors.simulated, false);
  }

  Mat3 covariance() const {
    const PropagatedMean a = propagate(first, all(first), errors, false),
                         b = propagate(second, all(second), errors, true);
    Mat3 sum = a.measured;
    for (std::size_t k = 0; k < 9; ++k) sum[k] += b.measured[k] + b.aligned[k];
    return sum;
  }
};

TEST(ErrorPropagation, AgreesWithRepeatedSurveys) {
  const Scene scene;
  constexpr int kTrials = 20000;
  Random random(11);
  const double predicted = std::sqrt(variance_along(scene.covariance(), scene.n));
  const double level = propagated_detection(scene.covariance(), scene.n, 0, PropagationRule::mean);
  double sum = 0, squares = 0;
  const double truth = [&] {
    double d = 0;
    for (const Vec3& p : scene.second) d += dot(p, scene.n) / static_cast<double>(scene.second.size());
    for (const Vec3& p : scene.first) d -= dot(p, scene.n) / static_cast<double>(scene.first.size());
    return d;
  }();
  int alarms = 0;
  for (int k = 0; k < kTrials; ++k) {
    const double d = scene.repeated(random) - truth;
    sum += d;
    squares += d * d;
    alarms += std::abs(d) > level;
  }
  const double mean = sum / kTrials, spread = std::sqrt(squares / kTrials - mean * mean);
  std::printf("| repeated surveys | %.3f mm | propagated | %.3f mm | false alarms | %.2f %% |\n", 1e3 * spread,
              1e3 * predicted, 100.0 * alarms / kTrials);
  // A standard deviation of n trials is known to 1 / sqrt(2 n), a share of 5 % to sqrt(0.05 0.95 / n): four of these.
  EXPECT_NEAR(spread / predicted, 1, 4 / std::sqrt(2.0 * kTrials));
  EXPECT_NEAR(double(alarms) / kTrials, 0.05, 4 * std::sqrt(0.05 * 0.95 / kTrials));
  EXPECT_LT(std::abs(mean), 4 * predicted / std::sqrt(double(kTrials)) + 1e-5) << "second-order terms are micrometres";
}

TEST(ErrorPropagation, OfOnePointIsTheSpreadOfItsMeasurements) {
  const ScannerOptions options{{{3, 4, 5}}, 0.01, 1e-4, 0.03, 0.05};
  for (const Vec3& point : {Vec3{43, -26, 25}, Vec3{6, 4, -20}, Vec3{-30, 4, 5}}) {
    Random random(5);
    constexpr int kTrials = 20000;
    std::array<double, 9> sums{};
    for (int k = 0; k < kTrials; ++k) {
      const Vec3 d = measured(point, options.positions[0], options, random) - point;
      for (std::size_t i = 0; i < 9; ++i) sums[i] += d[i / 3] * d[i % 3] / kTrials;
    }
    const Mat3 C = point_covariance(options, options.positions[0], point, PropagationRule::mean);
    for (std::size_t i = 0; i < 9; ++i) {
      const double scale = std::sqrt(C[4 * (i / 3)] * C[4 * (i % 3)]);
      EXPECT_NEAR(sums[i], C[i], 4 * std::sqrt(2.0 / kTrials) * scale + 1e-12) << i;
    }
  }
}

TEST(ErrorPropagation, ARotationMovesWhatIsFarFromTheCentre) {
  const double turn = 1e-3;
  const AlignmentCovariance C = rigid_alignment(0.02, turn);
  const Mat3 here = alignment_covariance(C, {0, 0, 0}), far = alignment_covariance(C, {100, 0, 0});
  for (std::size_t a = 0; a < 3; ++a) EXPECT_DOUBLE_EQ(here[4 * a], 0.0004);
  EXPECT_DOUBLE_EQ(far[0], 0.0004) << "along the arm";
  EXPECT_DOUBLE_EQ(far[4], 0.0004 + 0.01) << "across it";
  EXPECT_DOUBLE_EQ(far[8], 0.0004 + 0.01);
  // |r|^2 1 - r r^T
  const Vec3 r{3, -2, 5};
  const Mat3 any = alignment_covariance(rigid_alignment(0, turn), r);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(any[3 * i + j], turn * turn * ((i == j ? dot(r, r) : 0) - r[i] * r[j]), 1e-18);
}

TEST(ErrorPropagation, OfASimulationIsItsSpacing) {
  SurveyErrors errors;
  errors.simulated.floor = 0.1;
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const PropagatedMean mean = propagate(points, {0, 1, 2}, errors, false);
  EXPECT_NEAR(mean.mean[0], 1.0 / 3, 1e-15);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_DOUBLE_EQ(mean.measured[i], i % 4 == 0 ? 0.01 : 0) << "not divided by n";
}

/// What py4dgeo's m3c2ep.py does, written with Eigen.
struct Published {
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;
};

Published published(const std::vector<Vec3>& points, const SideErrors& side, const SurveyErrors& errors, bool moving) {
  const auto n = static_cast<double>(points.size());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), N = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  const Eigen::Map<const Eigen::Matrix<double, 12, 12, Eigen::RowMajor>> Cxx(errors.alignment.data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p(points[i][0], points[i][1], points[i][2]);
    const Vec3& s = side.scanner.positions[side.scanner_of.empty() ? 0 : side.scanner_of[i]];
    const Eigen::Vector3d d = p - Eigen::Vector3d(s[0], s[1], s[2]);
    const double r = d.norm(), yaw = std::atan2(d[1], d[0]), scan = std::acos(d[2] / r), sr = side.scanner.sigma_range;
    Eigen::Matrix3d J;  // by range, yaw and scan angle from the zenith
    J << std::cos(yaw) * std::sin(scan), -r * std::sin(yaw) * std::sin(scan), r * std::cos(yaw) * std::cos(scan),
        std::sin(yaw) * std::sin(scan), r * std::cos(yaw) * std::sin(scan), r * std::sin(yaw) * std::cos(scan),
        std::cos(scan), 0, -r * std::sin(scan);
    const Eigen::Vector3d variances(sr * sr + 1e-6 * sr * r * r, std::pow(kDegree * side.scanner.sigma_azimuth, 2),
                                    std::pow(kDegree * side.scanner.sigma_elevation, 2));
    const Eigen::Matrix3d C = J * variances.asDiagonal() * J.transpose();
    sum += C;
    if (moving) {
      Eigen::Matrix<double, 3, 12> B = Eigen::Matrix<double, 3, 12>::Zero();
      for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < 3; ++k) B(row, 3 * row + k) = p[k] - errors.centre[static_cast<std::size_t>(k)];
        B(row, 9 + row) = 1;
      }
      sum += B * Cxx * B.transpose();
    }
    N += C.inverse();
    b += C.inverse() * p;
  }
  return {N.inverse() * b, sum / n};
}

TEST(ErrorPropagation, AsPublished) {
  Scene scene;
  scene.errors.rule = PropagationRule::py4dgeo;
  const Published a = published(scene.first, scene.errors.simulated, scene.errors, false);
  const Published b = published(scene.second, scene.errors.observed, scene.errors, true);
  const Eigen::Vector3d n(scene.n[0], scene.n[1], scene.n[2]);
  const double level = std::sqrt(7.814727903251179 / (n.dot((a.covariance + b.covariance).inverse() * n)));
  EXPECT_NEAR(propagated_detection(scene.covariance(), scene.n, 0, PropagationRule::py4dgeo), level, 1e-12);
  const PropagatedMean first = propagate(scene.first, scene.all(scene.first), scene.errors, false);
  const PropagatedMean second = propagate(scene.second, scene.all(scene.second), scene.errors, true);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(first.mean[static_cast<std::size_t>(k)], a.mean[k], 1e-9);
    EXPECT_NEAR(second.mean[static_cast<std::size_t>(k)], b.mean[k], 1e-9);
  }
}

PointCloud cloud_of(const std::vector<Vec3>& points) {
  PointCloud cloud;
  cloud.positions = points;
  return cloud;
}

CompareOptions options_for(const Scene& scene) {
  CompareOptions options;
  options.name = "ep";
  options.method = CompareMethod::m3c2;
  options.max_distance = 1;
  options.m3c2.cylinder_radius = 5;
  options.m3c2.detection = DetectionSource::errors;
  options.m3c2.scanner_simulated = scene.errors.simulated.scanner;
  options.m3c2.scanner_observed = scene.errors.observed.scanner;
  options.m3c2.alignment.covariance.assign(scene.errors.alignment.begin(), scene.errors.alignment.end());
  options.m3c2.alignment.centre = scene.errors.centre;
  return options;
}

double value(const Comparison& result, const std::string& name) {
  for (const PointScalar& scalar : result.cloud.scalars)
    if (scalar.name == name) return scalar.values[0];
  ADD_FAILURE() << "no field " << name;
  return 0;
}

TEST(ErrorPropagation, GivesTheLevelsOfDetectionOfAComparison) {
  const Scene scene;
  PointCloud first = cloud_of(scene.first), second = cloud_of(scene.second), core = cloud_of({{40, 25, 3}});
  core.normals = {scene.n};
  PointScalar seen{"scan_position", "1", {}};
  for (std::uint16_t s : scene.errors.observed.scanner_of) seen.values.push_back(s + 1.0);
  second.scalars = {seen};
  CompareOptions options = options_for(scene);
  options.m3c2.normals = NormalSource::core;
  const Comparison result = compare_m3c2(first, second, &core, options, 1);
  const double sigma = std::sqrt(variance_along(scene.covariance(), scene.n));
  EXPECT_NEAR(value(result, "lod"), 1.96 * sigma, 1e-12);
  EXPECT_NEAR(
      std::hypot(value(result, "sigma_simulated"), value(result, "sigma_observed"), value(result, "sigma_alignment")),
      sigma, 1e-12);
  options.registration_error = 0.01;
  EXPECT_NEAR(value(compare_m3c2(first, second, &core, options, 1), "lod"), 1.96 * (sigma + 0.01), 1e-12);
  // A simulation is known to its spacing, whatever was scanned.
  options.m3c2.scanner_simulated = {};
  options.simulated_spacing = 0.6;
  EXPECT_NEAR(value(compare_m3c2(first, second, &core, options, 1), "sigma_simulated"), 0.6 / std::sqrt(12.0), 1e-12);

  const auto refused = [&](auto&& change) {
    CompareOptions wrong = options;
    PointCloud observed = second;
    change(wrong, observed);
    EXPECT_THROW(compare_m3c2(first, observed, &core, wrong, 1), Error);
  };
  refused([](CompareOptions& o, PointCloud&) { o.simulated_spacing = 0; });
  refused([](CompareOptions& o, PointCloud&) { o.m3c2.scanner_observed.positions.clear(); });
  refused([](CompareOptions& o, PointCloud&) { o.m3c2.average = Average::median; });
  refused([](CompareOptions& o, PointCloud&) { o.convention = CompareConvention::pdal; });
  refused([](CompareOptions& o, PointCloud&) { o.m3c2.alignment.covariance.pop_back(); });
  refused([](CompareOptions& o, PointCloud&) { o.m3c2.alignment.covariance[1] += 1e-3; });
  refused([](CompareOptions& o, PointCloud&) { o.m3c2.alignment.sigma_rotation = 1; });
  refused([](CompareOptions&, PointCloud& c) { c.scalars.clear(); });
  refused([](CompareOptions&, PointCloud& c) { c.scalars[0].values[3] = 3; });
}

}  // namespace
}  // namespace scarp

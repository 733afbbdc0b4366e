// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/block_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "solver/model/parallel.hpp"

namespace scarp {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

constexpr std::size_t kPlane = 12;  ///< points of the plane through a counterpart
constexpr int kMostIterations = 100;
constexpr double kStill = 0.1;       ///< standard deviations: a smaller step ends the search
constexpr int kFull = 20;            ///< iterations with full steps; then shorter ones, lest counterparts alternate
constexpr double kExact = 1e-9;      ///< of the block's size: so does one that is nothing
constexpr double kSingular = 1e-12;  ///< eigenvalues below this share of the largest say nothing
constexpr double kOutlier = 3;       ///< robust standard deviations
constexpr double kLine = 1e-6;       ///< squared width over squared length of points on a line
constexpr double kSeen = 2;          ///< times what the noise of normals seems to see: less is nothing

Eigen::Vector3d eigen(const Vec3& v) { return {v[0], v[1], v[2]}; }
Vec3 plain(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

MovedSurface::MovedSurface(const std::vector<Vec3>& points, int threads)
    : points_(points), normals_(points.size()), radius_(points.size()), tilt_(points.size()), near_(points) {
  parallel_for(points.size(), threads, [&](std::size_t i) {
    const std::vector<Neighbour> around = near_.nearest(points_[i], kPlane);
    const auto n = static_cast<double>(around.size());
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Neighbour& k : around) middle += eigen(points_[k.index] - points_[i]) / n;
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const Neighbour& k : around) {
      const Eigen::Vector3d d = eigen(points_[k.index] - points_[i]) - middle;
      scatter += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    const Eigen::Vector3d l = solver.eigenvalues();
    const bool is_plane = n > 3 && l[1] > kLine * l[2] && l[1] > l[0];
    normals_[i] = is_plane ? plain(solver.eigenvectors().col(0)) : Vec3{NAN, NAN, NAN};
    radius_[i] = std::sqrt(around.back().squared_distance);
    tilt_[i] = std::max(0.0, l[0]) / (n - 3) / l[1];  // of a slope by least squares
  });
}

/// One block on its way.
class BlockFit {
 public:
  BlockFit(const MovedSurface& after, const std::vector<Vec3>& block, double reach) : after_(after), reach_(reach) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Vec3& p : block) sum += eigen(p) - eigen(block[0]);
    centre_ = eigen(block[0]) + sum / static_cast<double>(block.size());
    for (const Vec3& p : block) {
      arms_.push_back(eigen(p) - centre_);
      size_ = std::max(size_, arms_.back().norm());
    }
  }

  /// @returns whether the block came to rest
  bool settle(int& iterations) {
    for (iterations = 1; iterations <= kMostIterations; ++iterations) {
      match();
      if (pairs_.size() < 7) return false;
      sum_up();
      const Vector6 step = solve();
      const bool still =
          step.norm() < kExact * size_ || step.dot(information_ * step) < 6 * kStill * kStill * variance();
      move(std::min(1.0, static_cast<double>(kFull) / iterations) * step);
      if (still) return true;
    }
    return false;
  }

  void report(const Vec3* place, BlockMotion& motion) const {
    motion.at = place ? *place : plain(centre_);
    motion.overlap = static_cast<double>(found_) / static_cast<double>(arms_.size());
    if (pairs_.size() < 7) return;
    motion.residual = std::sqrt(squares_ / static_cast<double>(pairs_.size()));
    const Eigen::SelfAdjointEigenSolver<Matrix6> seen(information_ - kSeen * seeming_, Eigen::EigenvaluesOnly);
    if (!(seen.eigenvalues()[0] > kSingular * seen.eigenvalues()[5])) {
      motion.worst_sigma = INFINITY;
      return;
    }
    const Matrix6 inverse = (information_ - seeming_).inverse();
    // A place off the mean also goes with the turn: turn x arm + shift.
    const Eigen::Vector3d arm = eigen(motion.at) - centre_;
    Eigen::Matrix<double, 3, 6> at_place;
    at_place << 0, arm[2], -arm[1], size_, 0, 0, -arm[2], 0, arm[0], 0, size_, 0, arm[1], -arm[0], 0, 0, 0, size_;
    at_place /= size_;
    const Eigen::Matrix3d covariance = variance() * at_place * inverse * at_place.transpose();
    for (int a = 0; a < 3; ++a) motion.sigma[static_cast<std::size_t>(a)] = std::sqrt(covariance(a, a));
    motion.worst_sigma =
        std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly).eigenvalues()[2]);
    motion.displacement = plain(rotation_ * arm - arm + shift_);
    motion.rotation = Eigen::AngleAxisd(rotation_).angle() * 180 / std::numbers::pi;
  }

 private:
  struct Pair {
    Vector6 derivative;  ///< of the error, by the turn times the size and by the shift
    double error;        ///< from the plane, m
    std::size_t counterpart;
    Eigen::Vector3d turned;
  };

  void move(const Vector6& step) {
    const Eigen::Vector3d turn = step.head<3>() / size_;
    const double angle = turn.norm();
    if (angle > 0) rotation_ = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * rotation_;
    shift_ += step.tail<3>();
  }

  void match() {
    pairs_.clear();
    found_ = 0;
    for (const Eigen::Vector3d& arm : arms_) {
      const Eigen::Vector3d turned = rotation_ * arm;
      const Eigen::Vector3d p = centre_ + turned + shift_;
      const std::optional<Neighbour> nearest = after_.near_.closest(plain(p), reach_);
      if (!nearest || !is_finite(after_.normals_[nearest->index])) continue;
      const Eigen::Vector3d n = eigen(after_.normals_[nearest->index]);
      const Eigen::Vector3d d = p - eigen(after_.points_[nearest->index]);
      Pair pair{{}, n.dot(d), nearest->index, turned};
      if ((d - pair.error * n).norm() > after_.radius_[nearest->index]) continue;  // beside the survey, or a hole
      ++found_;
      pair.derivative << turned.cross(n) / size_, n;
      pairs_.push_back(pair);
    }
    leave_out_outliers();
  }

  void leave_out_outliers() {
    if (pairs_.empty()) return;
    std::vector<double> sizes;
    for (const Pair& pair : pairs_) sizes.push_back(std::abs(pair.error));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double limit = std::max(kOutlier * 1.4826 * *middle, kExact * size_);
    std::erase_if(pairs_, [&](const Pair& pair) { return std::abs(pair.error) > limit; });
  }

  void sum_up() {
    squares_ = 0;
    information_ = seeming_ = Matrix6::Zero();
    for (const Pair& pair : pairs_) {
      squares_ += pair.error * pair.error;
      information_ += pair.derivative * pair.derivative.transpose();
      // J = (arm x n / size, n): what a change of n across itself does to it.
      const Eigen::Vector3d n = pair.derivative.tail<3>(), r = pair.turned / size_;
      Eigen::Matrix<double, 6, 3> G;
      G << 0, -r[2], r[1], r[2], 0, -r[0], -r[1], r[0], 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
      G -= (G * n) * n.transpose();
      seeming_ += after_.tilt_[pair.counterpart] * G * G.transpose();
    }
  }

  double variance() const { return squares_ / static_cast<double>(pairs_.size() - 6); }

  /// In directions that the planes do not see nothing moves.
  Vector6 solve() const {
    Vector6 b = Vector6::Zero();
    for (const Pair& pair : pairs_) b -= pair.error * pair.derivative;
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(information_);
    Vector6 step = Vector6::Zero();
    for (int k = 0; k < 6; ++k)
      if (solver.eigenvalues()[k] > kSingular * solver.eigenvalues()[5])
        step += solver.eigenvectors().col(k) * (solver.eigenvectors().col(k).dot(b) / solver.eigenvalues()[k]);
    return step;
  }

  const MovedSurface& after_;
  double reach_;
  std::vector<Eigen::Vector3d> arms_;
  std::vector<Pair> pairs_;
  std::size_t found_ = 0;
  double size_ = 1e-300, squares_ = 0;
  Matrix6 information_ = Matrix6::Zero(), seeming_ = Matrix6::Zero();
  Eigen::Vector3d centre_, shift_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

BlockMotion MovedSurface::motion_of(const std::vector<Vec3>& block, const MotionSettings& settings,
                                    const Vec3* place) const {
  BlockMotion motion;
  motion.points = block.size();
  if (block.empty()) {
    if (place) motion.at = *place;
    motion.flags = kFewPoints;
    return motion;
  }
  BlockFit fit(*this, block, settings.reach);
  const bool enough = block.size() >= settings.minimum_points;
  const bool settled = enough && fit.settle(motion.iterations);
  fit.report(place, motion);
  motion.flags = static_cast<std::uint8_t>(
      !enough ? kFewPoints
              : (settled ? 0 : kNotConverged) + (motion.overlap < settings.least_overlap ? kLittleOverlap : 0) +
                    (motion.residual > settings.largest_residual ? kLargeResidual : 0) +
                    (motion.worst_sigma <= settings.largest_sigma ? 0 : kUndetermined));
  if (motion.flags != 0) motion.displacement = {BlockMotion::kNaN, BlockMotion::kNaN, BlockMotion::kNaN};
  return motion;
}

std::vector<std::vector<std::uint32_t>> blocks_in_plan(const std::vector<Vec3>& points, double edge) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::uint32_t>> squares;
  for (std::size_t i = 0; i < points.size(); ++i)
    squares[{static_cast<std::int64_t>(std::floor(points[i][1] / edge)),
             static_cast<std::int64_t>(std::floor(points[i][0] / edge))}]
        .push_back(static_cast<std::uint32_t>(i));
  std::vector<std::vector<std::uint32_t>> blocks;
  for (auto& [square, members] : squares) blocks.push_back(std::move(members));
  return blocks;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/m3c2.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ingest/neighbours/point_tree.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The length of the cylinder, and how py4dgeo cuts it.
struct Cylinder {
  double radius;
  double half_length;
  int segments;         ///< 0: closed, in one piece
  double half_segment;  ///< m

  Cylinder(const M3c2Settings& s) : radius(s.radius), half_length(s.half_length), segments(0), half_segment(0) {
    if (!s.rules.segments) return;
    segments = half_length > radius ? static_cast<int>(std::ceil(half_length / radius)) : 1;
    half_length = std::max(half_length, radius);
    half_segment = half_length / segments;
  }

  /// Strictly within one of the segments, each measured from its own middle.
  bool in_a_segment(const Vec3& d, const Vec3& n, double t) const {
    const auto likely = static_cast<int>((t + half_length) / (2 * half_segment));
    for (int i = std::max(0, likely - 1); i <= std::min(segments - 1, likely + 1); ++i) {
      const double middle = static_cast<double>(2 * i + 1 - segments) / segments * half_length;
      const Vec3 from_middle = d - middle * n;
      const double along = dot(from_middle, n);
      if (std::abs(along) < half_segment && dot(from_middle, from_middle) - along * along <= radius * radius)
        return true;
    }
    return false;
  }

  bool holds(const Vec3& d, const Vec3& n, double t) const {
    if (segments > 0) return in_a_segment(d, n, t);
    const Vec3 across = d - t * n;
    return std::abs(t) <= half_length && dot(across, across) <= radius * radius;
  }
};

/// Positions along n, from the core point, of the points in the cylinder, and which points these are if asked for.
void gather(const PointTree& tree, const Vec3& core, const Vec3& n, const Cylinder& cylinder,
            std::vector<double>& positions, std::vector<std::uint32_t>* members) {
  positions.clear();
  if (members) members->clear();
  tree.visit(
      [&](const PointTree::Box& box) {
        return may_touch_cylinder(box, core, n, cylinder.radius, cylinder.half_length);
      },
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Vec3 d = tree.points()[i] - core;
          const double t = dot(d, n);
          if (!cylinder.holds(d, n, t)) continue;
          positions.push_back(t);
          if (members) members->push_back(tree.indices()[i]);
        }
      });
}

/// Half the width of the 95 % interval of the distance.
double detection(const Level& simulated, const Level& observed, const M3c2Settings& s) {
  const auto squared_error = [](const Level& level) {
    return level.spread * level.spread / static_cast<double>(level.count);
  };
  const double floor = s.simulated_floor * s.simulated_floor;
  double first = squared_error(simulated);
  if (floor > 0 && !(first > floor)) first = floor;  // one material point has a floor, though no spread
  return 1.96 * (std::sqrt(first + squared_error(observed)) + s.registration_error);
}

class CoreMeasure {
 public:
  CoreMeasure(const M3c2Input& input, const M3c2Settings& settings)
      : input_(input),
        settings_(settings),
        cylinder_(settings),
        simulated_(input.simulated),
        observed_(input.observed) {
    const bool of_observed = settings.source == NormalSource::observed;
    if (of_observed || settings.source == NormalSource::simulated)
      normals_.emplace(of_observed ? observed_ : simulated_, settings.normals);
  }

  struct Scratch {
    std::vector<Vec3> offsets;
    std::vector<double> positions;
    std::vector<std::uint32_t> simulated, observed;  ///< members of the cylinder, for propagation
  };

  M3c2Row at(std::size_t i, Scratch& scratch) const {
    const Vec3& core = input_.cores[i];
    M3c2Row row{.normal = normal_at(i, scratch),
                .simulated = {kNaN, kNaN, 0},
                .observed = {kNaN, kNaN, 0},
                .distance = kNaN,
                .detection = kNaN,
                .flags = 0};
    const Vec3& n = row.normal.direction;
    if (!is_finite(n)) {
      row.flags = kNoNormal | kNoSimulated | kNoObserved | kNoDetection;
      return row;
    }
    const bool propagates = settings_.errors.has_value();
    gather(simulated_, core, n, cylinder_, scratch.positions, propagates ? &scratch.simulated : nullptr);
    row.simulated = level_of(scratch.positions, settings_.average, settings_.rules);
    gather(observed_, core, n, cylinder_, scratch.positions, propagates ? &scratch.observed : nullptr);
    row.observed = level_of(scratch.positions, settings_.average, settings_.rules);
    row.distance = row.observed.position - row.simulated.position;
    const std::size_t fewest = std::min(row.simulated.count, row.observed.count);
    if (fewest >= settings_.rules.minimum_points && propagates)
      propagate_errors(core, scratch, row);
    else if (fewest >= settings_.rules.minimum_points)
      row.detection = detection(row.simulated, row.observed, settings_);
    row.flags = static_cast<std::uint8_t>((row.simulated.count == 0 ? kNoSimulated : 0) |
                                          (row.observed.count == 0 ? kNoObserved : 0) |
                                          (std::isnan(row.detection) ? kNoDetection : 0));
    return row;
  }

 private:
  void propagate_errors(const Vec3& core, const Scratch& scratch, M3c2Row& row) const {
    const SurveyErrors& errors = *settings_.errors;
    const Vec3& n = row.normal.direction;
    const PropagatedMean first = propagate(input_.simulated, scratch.simulated, errors, false);
    const PropagatedMean second = propagate(input_.observed, scratch.observed, errors, true);
    row.sigma_simulated = std::sqrt(variance_along(first.measured, n));
    row.sigma_observed = std::sqrt(variance_along(second.measured, n));
    row.sigma_alignment = std::sqrt(variance_along(second.aligned, n));
    Mat3 covariance = first.measured;
    for (std::size_t k = 0; k < 9; ++k) covariance[k] += second.measured[k] + second.aligned[k];
    row.detection = propagated_detection(covariance, n, settings_.registration_error, errors.rule);
    if (errors.rule != PropagationRule::py4dgeo) return;
    row.simulated.position = dot(first.mean - core, n);
    row.observed.position = dot(second.mean - core, n);
    row.distance = row.observed.position - row.simulated.position;
  }

  Normal normal_at(std::size_t i, Scratch& scratch) const {
    if (normals_) return normals_->at(input_.cores[i], scratch.offsets);
    Normal normal;
    if (settings_.source == NormalSource::vertical) {
      normal.direction = oriented({0, 0, 1}, input_.cores[i], settings_.normals.side, settings_.normals.viewpoint);
      return normal;
    }
    const Vec3& given = input_.core_normals[i];
    const double length = norm(given);
    if (length > 0 && std::isfinite(length)) normal.direction = (1 / length) * given;
    return normal;
  }

  const M3c2Input& input_;
  const M3c2Settings& settings_;
  Cylinder cylinder_;
  PointTree simulated_, observed_;
  std::optional<NormalSearch> normals_;
};

}  // namespace

std::vector<M3c2Row> m3c2(const M3c2Input& input, const M3c2Settings& settings, int threads) {
  // Near core points one after the other: they read the same parts of the clouds.
  const PointTree order(input.cores);
  const CoreMeasure measure(input, settings);
  std::vector<M3c2Row> rows(input.cores.size());
  constexpr std::size_t kBlock = 256;
  parallel_for((rows.size() + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    CoreMeasure::Scratch scratch;
    const std::size_t end = std::min(rows.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) {
      const std::size_t core = order.indices()[i];
      rows[core] = measure.at(core, scratch);
    }
  });
  return rows;
}

}  // namespace scarp

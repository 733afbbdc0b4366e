// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "solver/model/compare_options.hpp"
#include "tools/compare/comparison.hpp"
#include "tools/compare/error_propagation.hpp"
#include "tools/compare/m3c2_rules.hpp"

namespace scarp {

/// What is wrong at a core point; a sum of these, 0 where nothing is.
enum M3c2Flag : std::uint8_t {
  kNoNormal = 1,     ///< too few neighbours, or on a line: nothing can be measured
  kNoSimulated = 2,  ///< no simulated point in the cylinder
  kNoObserved = 4,   ///< no observed point in the cylinder
  kNoDetection = 8   ///< too few points, or no spread, for a level of detection
};

/// One core point. What is not known is NaN, and where no point was found the count is 0.
struct M3c2Row {
  Normal normal;
  Level simulated, observed;  ///< along the normal from the core point
  double distance;            ///< observed.position - simulated.position, m
  double detection;           ///< level of detection at 95 %, m
  std::uint8_t flags;
  /// Standard deviations along the normal by propagated errors, m: of either mean by measurement, and of the observed
  /// one by alignment. NaN without propagation.
  double sigma_simulated = std::numeric_limits<double>::quiet_NaN();
  double sigma_observed = std::numeric_limits<double>::quiet_NaN();
  double sigma_alignment = std::numeric_limits<double>::quiet_NaN();
};

struct M3c2Input {
  std::vector<Vec3> simulated, observed, cores;
  std::vector<Vec3> core_normals;  ///< for NormalSource::core
};

/// Everything that decides a distance, resolved: no automatic values left.
struct M3c2Settings {
  M3c2Rules rules;
  NormalRules normals;
  NormalSource source = NormalSource::simulated;
  Average average = Average::mean;
  double radius = 0;              ///< of the cylinders, m
  double half_length = 0;         ///< m
  double registration_error = 0;  ///< m
  /// Of the simulated side, m: spacing / sqrt(12), or 0. What a lattice of material points cannot resolve shifts all
  /// points of a cylinder alike, so that the standard error of their mean is at least this.
  double simulated_floor = 0;
  std::optional<SurveyErrors> errors;  ///< in the frame of the points: levels of detection by propagation
};

/// M3C2 (Lague, Brodu & Leroux 2013) at every core point, in one frame:
///   distance = n . (mean of observed - mean of simulated),
///   detection = 1.96 (sqrt(max(s1^2 / n1, simulated_floor^2) + s2^2 / n2) + registration_error),
/// s the standard deviations along n, or the interquartile ranges for medians; with settings.errors the level of
/// detection is that of error_propagation.hpp, and so is the distance where its rule weights points. The same bits for
/// any number of threads.
std::vector<M3c2Row> m3c2(const M3c2Input& input, const M3c2Settings& settings, int threads);

/// The comparison of two clouds. Its cloud is the core points in their own frame, with normals and the scalars
/// "distance", "lod", "significant" (1 where |distance| > lod), "spread_simulated", "spread_observed",
/// "count_simulated", "count_observed", "normal_radius" and "flags".
/// @param cores where distances are measured; nullptr: at the simulated points
/// @throws Error for empty clouds, positions that are not finite, a max_distance that is not above zero, or core points
///   without normals where these are asked for
Comparison compare_m3c2(const PointCloud& simulated, const PointCloud& observed, const PointCloud* cores,
                        const CompareOptions& options, int threads);

}  // namespace scarp

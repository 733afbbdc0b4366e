// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/displacement.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "tools/compare/block_motion.hpp"
#include "tools/compare/common_frame.hpp"
#include "tools/compare/frame_values.hpp"
#include "tools/compare/material_points.hpp"
#include "tools/compare/statistics.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3 kNowhere{kNaN, kNaN, kNaN};
constexpr std::size_t kFitted = 20;  ///< material points of a linear fit
constexpr double kReach = 2;         ///< spacings to the nearest of them

/// Places and what was observed there.
struct Vectors {
  std::vector<Vec3> at, displacement, sigma;
  std::vector<BlockMotion> motions;  ///< empty for measured targets
};

/// Three scalars as vectors; empty where any is missing.
std::vector<Vec3> vectors_of(const PointCloud& cloud, const std::array<std::string, 3>& names) {
  std::vector<Vec3> vectors(cloud.size());
  for (std::size_t a = 0; a < 3; ++a) {
    const PointScalar* scalar = find_scalar(cloud, names[a]);
    if (!scalar) return {};
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i][a] = scalar->values[i];
  }
  return vectors;
}

MotionSettings settings_of(const CompareOptions& options) {
  const DisplacementOptions& d = options.displacement;
  if (!(d.block > 0)) throw Error("compare", "displacement.block (--block)", shortest(d.block), "above 0 m");
  require_max_distance(options);
  const double tenth = 0.1 * options.max_distance;
  return {options.max_distance, static_cast<std::size_t>(d.minimum_points), d.least_overlap,
          d.largest_residual > 0 ? d.largest_residual : tenth, d.largest_sigma > 0 ? d.largest_sigma : tenth};
}

/// Points within half a block of each target.
std::vector<std::vector<std::uint32_t>> patches(const std::vector<Vec3>& points, const std::vector<Vec3>& targets,
                                                double diameter) {
  const Neighbours near(points);
  std::vector<std::vector<std::uint32_t>> members(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i)
    for (const Neighbour& n : near.within(targets[i], 0.5 * diameter))
      members[i].push_back(static_cast<std::uint32_t>(n.index));
  return members;
}

Vectors found_by_blocks(const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                        const std::vector<Vec3>* targets, const CompareOptions& options, int threads) {
  const MotionSettings settings = settings_of(options);
  const auto blocks = targets ? patches(before, *targets, options.displacement.block)
                              : blocks_in_plan(before, options.displacement.block);
  const MovedSurface surface(after, threads);
  Vectors vectors;
  vectors.motions.resize(blocks.size());
  parallel_for(blocks.size(), threads, [&](std::size_t b) {
    std::vector<Vec3> points;
    for (std::uint32_t i : blocks[b]) points.push_back(before[i]);
    vectors.motions[b] = surface.motion_of(points, settings, targets ? &(*targets)[b] : nullptr);
  });
  for (const BlockMotion& motion : vectors.motions) {
    vectors.at.push_back(motion.at);
    vectors.displacement.push_back(motion.displacement);
    vectors.sigma.push_back(motion.sigma);
  }
  return vectors;
}

/// Measured ones, or such as are found between the surveys.
Vectors observed_vectors(const DisplacementSources& sources, const Vec3& origin, const CompareOptions& options,
                         int threads) {
  const auto local = [&](const PointCloud& cloud) { return moved(cloud.positions, cloud.site.origin, origin); };
  std::vector<Vec3> targets;
  if (sources.targets) {
    require_points(*sources.targets, "targets'");
    targets = local(*sources.targets);
    std::vector<Vec3> measured = vectors_of(*sources.targets, {"dx", "dy", "dz"});
    if (!measured.empty()) {
      std::vector<Vec3> sigma = vectors_of(*sources.targets, {"sigma_x", "sigma_y", "sigma_z"});
      if (sigma.empty()) sigma.assign(targets.size(), kNowhere);
      return {std::move(targets), std::move(measured), std::move(sigma), {}};
    }
  }
  if (!sources.before || !sources.after)
    throw Error("compare", "displacement vectors need two surveys, or targets that bring theirs",
                sources.targets ? "targets without dx, dy, dz" : "one survey",
                "before (--before) and observed, or displacement.targets with dx, dy, dz");
  require_points(*sources.before, "before");
  require_points(*sources.after, "observed");
  return found_by_blocks(local(*sources.before), local(*sources.after), sources.targets ? &targets : nullptr, options,
                         threads);
}

void add(std::vector<PointScalar>& scalars, const std::array<const char*, 3>& names, const std::vector<Vec3>& vectors) {
  for (std::size_t a = 0; a < 3; ++a) {
    PointScalar scalar{names[a], "m", {}};
    for (const Vec3& v : vectors) scalar.values.push_back(v[a]);
    scalars.push_back(std::move(scalar));
  }
}

template <class F>
void add(std::vector<PointScalar>& scalars, const char* name, const char* unit, const std::vector<BlockMotion>& motions,
         F&& value) {
  PointScalar scalar{name, unit, {}};
  for (const BlockMotion& motion : motions) scalar.values.push_back(static_cast<double>(value(motion)));
  scalars.push_back(std::move(scalar));
}

std::vector<double> lengths(const std::vector<Vec3>& vectors) {
  std::vector<double> result;
  for (const Vec3& v : vectors) result.push_back(norm(v));
  return result;
}

std::vector<PointScalar> scalars_of(const Vectors& observed, const std::vector<Vec3>& simulated,
                                    const std::vector<Vec3>& difference) {
  std::vector<PointScalar> scalars{{"distance", "m", lengths(simulated.empty() ? observed.displacement : difference)}};
  add(scalars, {"dx", "dy", "dz"}, observed.displacement);
  add(scalars, {"sigma_x", "sigma_y", "sigma_z"}, observed.sigma);
  scalars.push_back({"length", "m", lengths(observed.displacement)});
  if (!simulated.empty()) {
    add(scalars, {"simulated_dx", "simulated_dy", "simulated_dz"}, simulated);
    add(scalars, {"difference_dx", "difference_dy", "difference_dz"}, difference);
  }
  if (observed.motions.empty()) return scalars;
  add(scalars, "rotation", "deg", observed.motions, [](const BlockMotion& m) { return m.rotation; });
  add(scalars, "residual", "m", observed.motions, [](const BlockMotion& m) { return m.residual; });
  add(scalars, "overlap", "1", observed.motions, [](const BlockMotion& m) { return m.overlap; });
  add(scalars, "points", "1", observed.motions, [](const BlockMotion& m) { return m.points; });
  add(scalars, "flags", "1", observed.motions, [](const BlockMotion& m) { return m.flags; });
  return scalars;
}

std::vector<double> known(const std::vector<double>& values) {
  std::vector<double> result;
  for (double v : values)
    if (!std::isnan(v)) result.push_back(v);
  std::sort(result.begin(), result.end());
  return result;
}

Vec3 mean_of(const std::vector<Vec3>& vectors) {
  Vec3 sum{0, 0, 0};
  double count = 0;
  for (const Vec3& v : vectors)
    if (is_finite(v)) sum = sum + v, count += 1;
  return (1 / count) * sum;
}

std::vector<double> as_list(const Vec3& v) { return {v[0], v[1], v[2]}; }

MeasureGroup observed_group(const Vectors& vectors, const CompareOptions& options) {
  const std::vector<double> sizes = known(lengths(vectors.displacement));
  const auto flagged = [&](MotionFlag flag) {
    return std::int64_t{std::count_if(vectors.motions.begin(), vectors.motions.end(),
                                      [&](const BlockMotion& m) { return (m.flags & flag) != 0; })};
  };
  MeasureGroup group{"vectors",
                     "Observed displacement at places before the motion. ",
                     {{"places", static_cast<std::int64_t>(vectors.at.size())},
                      {"known", static_cast<std::int64_t>(sizes.size())},
                      {"mean_vector", as_list(mean_of(vectors.displacement)), "m"},
                      {"median_length", quantile(sizes, 0.5), "m"},
                      {"largest_length", quantile(sizes, 1), "m"}}};
  if (vectors.motions.empty()) {
    group.convention += "Measured at targets.";
    return group;
  }
  const MotionSettings settings = settings_of(options);
  group.convention +=
      "Rigid motion of each block by iterated closest points, point to plane: counterparts within reach, planes "
      "through "
      "12 neighbours, 3 robust standard deviations; covariance = sum e^2 / (m - 6) (J^T J)^-1 of m counterparts, "
      "errors "
      "independent. Not known (null, NaN) where flags, a sum, are not 0: 1 few_points, 2 little_overlap, 4 "
      "large_residual, 8 undetermined (worst standard deviation above largest_sigma), 16 not_converged.";
  for (const Measure& measure :
       {Measure{"block", options.displacement.block, "m"}, Measure{"reach", settings.reach, "m"},
        Measure{"minimum_points", static_cast<std::int64_t>(settings.minimum_points)},
        Measure{"least_overlap", settings.least_overlap}, Measure{"largest_residual", settings.largest_residual, "m"},
        Measure{"largest_sigma", settings.largest_sigma, "m"}, Measure{"few_points", flagged(kFewPoints)},
        Measure{"little_overlap", flagged(kLittleOverlap)}, Measure{"large_residual", flagged(kLargeResidual)},
        Measure{"undetermined", flagged(kUndetermined)}, Measure{"not_converged", flagged(kNotConverged)}})
    group.measures.push_back(measure);
  return group;
}

/// Angle between two vectors, degrees; NaN where one has no direction.
double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

MeasureGroup simulated_group(const Vectors& observed, const std::vector<Vec3>& simulated,
                             const std::vector<Vec3>& difference, const CompareOptions& options) {
  std::vector<double> lengthening, angles;
  std::int64_t both = 0, judged = 0, significant = 0;
  double observed_squares = 0, product = 0;
  for (std::size_t i = 0; i < difference.size(); ++i) {
    if (!is_finite(difference[i])) continue;
    ++both;
    const Vec3 &o = observed.displacement[i], &s = simulated[i], &d = difference[i], &sigma = observed.sigma[i];
    lengthening.push_back(norm(o) - norm(s));
    if (norm(o) > 0 && norm(s) > 0) angles.push_back(angle_between(o, s));
    observed_squares += dot(o, o);
    product += dot(o, s);
    if (!is_finite(sigma) || norm(d) == 0) continue;
    // Along the difference: of independent components, a bound where they are not.
    const double along = norm({sigma[0] * d[0], sigma[1] * d[1], sigma[2] * d[2]}) / norm(d);
    ++judged;
    significant += norm(d) > 1.96 * (along + options.registration_error);
  }
  const std::vector<double> sizes = known(lengths(difference));
  double squares = 0;
  for (double d : sizes) squares += d * d;
  std::sort(lengthening.begin(), lengthening.end());
  std::sort(angles.begin(), angles.end());
  return {
      "simulated_vectors",
      "Simulated displacement at the same places: linear in place through the 20 material points nearest by their "
      "reference positions; difference = observed - simulated. lengthening = |observed| - |simulated|; angle "
      "between the two; scale = sum(observed . simulated) / sum(observed^2), 1 where the simulation moves as much "
      "along the observed vectors. significant: |difference| > 1.96 (sigma along it + registration_error), of those "
      "whose sigma is known (judged).",
      {{"both", both},
       {"mean_difference", as_list(mean_of(difference)), "m"},
       {"root_mean_square", std::sqrt(squares / static_cast<double>(both)), "m"},
       {"median_length", quantile(sizes, 0.5), "m"},
       {"percentile_95", quantile(sizes, 0.95), "m"},
       {"largest_length", quantile(sizes, 1), "m"},
       {"median_lengthening", quantile(lengthening, 0.5), "m"},
       {"median_angle", quantile(angles, 0.5), "deg"},
       {"scale", product / observed_squares},
       {"judged", judged},
       {"significant", significant}}};
}

/// Of the row of components of a particle.
Vec3 vector_at(const std::vector<float>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

/// The linear function through vectors at points near a place, at the place; their mean where they span no space.
Vec3 linear_at(const Vec3& place, const std::vector<Vec3>& points, const std::vector<float>& vectors,
               const std::vector<Neighbour>& near) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto n = static_cast<double>(near.size());
  for (const Neighbour& k : near) {
    const Vec3 d = points[k.index] - place, u = vector_at(vectors, k.index);
    middle += Eigen::Vector3d(d[0], d[1], d[2]) / n;
    mean += Eigen::Vector3d(u[0], u[1], u[2]) / n;
  }
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero(), B = Eigen::Matrix3d::Zero();
  for (const Neighbour& k : near) {
    const Vec3 d = points[k.index] - place, u = vector_at(vectors, k.index);
    const Eigen::Vector3d x = Eigen::Vector3d(d[0], d[1], d[2]) - middle;
    A += x * x.transpose();
    B += (Eigen::Vector3d(u[0], u[1], u[2]) - mean) * x.transpose();
  }
  // In directions in which the points do not spread (plane strain) nothing varies.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(A);
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    if (solver.eigenvalues()[k] > 1e-6 * solver.eigenvalues()[2])
      slope += solver.eigenvectors().col(k) * (solver.eigenvectors().col(k).dot(middle) / solver.eigenvalues()[k]);
  const Eigen::Vector3d at = mean - B * slope;
  return {at[0], at[1], at[2]};
}

}  // namespace

std::vector<Vec3> simulated_displacements(const Frame& frame, const std::vector<Vec3>& places, int threads) {
  const auto* u = values_of<float>(frame, "displacement", "float32, m");
  if (!u || u->size() != 3 * frame.positions.size())
    throw Error("compare", "the frame does not say how its particles moved", u ? "one component" : "no field",
                "a float field \"displacement\" of three components");
  std::vector<Vec3> reference(frame.positions.size());
  for (std::size_t i = 0; i < reference.size(); ++i) reference[i] = frame.positions[i] - vector_at(*u, i);
  const double reach = kReach * spacing_of(frame);
  if (!(reach > 0))
    throw Error("compare", "the frame does not say how large its particles are", "no field",
                "a float field \"volume\"");
  const Neighbours near(reference);
  std::vector<Vec3> found(places.size(), kNowhere);
  parallel_for(places.size(), threads, [&](std::size_t i) {
    const std::vector<Neighbour> nearest = near.nearest(places[i], kFitted);
    if (nearest.empty() || nearest.front().squared_distance > reach * reach) return;
    found[i] = linear_at(places[i], reference, *u, nearest);
  });
  return found;
}

Comparison compare_displacement(const DisplacementSources& sources, const CompareOptions& options, int threads) {
  SiteFrame site = sources.targets ? sources.targets->site : SiteFrame{};
  for (const auto* cloud : {&sources.before, &sources.after})
    if (*cloud) site = {common_origin(site, (*cloud)->site), site.crs.empty() ? (*cloud)->site.crs : site.crs};
  if (sources.simulated) site.origin = common_origin(site, sources.simulated->site);
  const Vectors observed = observed_vectors(sources, site.origin, options, threads);
  std::vector<Vec3> simulated, difference;
  if (sources.simulated) {
    std::vector<Vec3> places = moved(observed.at, site.origin, sources.simulated->site.origin);
    simulated = simulated_displacements(*sources.simulated, places, threads);
    for (std::size_t i = 0; i < simulated.size(); ++i) difference.push_back(observed.displacement[i] - simulated[i]);
  }
  Comparison result{{}, {}, start_report(options)};
  std::vector<PointScalar> scalars = scalars_of(observed, simulated, difference);
  result.report.distances = distance_statistics(
      scalars[0].values, options.max_distance,
      sources.simulated ? "Length of the observed less the simulated displacement vector at each place."
                        : "Length of the displacement vector at each place.");
  result.report.groups = {observed_group(observed, options)};
  if (sources.simulated) result.report.groups.push_back(simulated_group(observed, simulated, difference, options));
  result.cloud.site = site;
  // Empty blocks do not occur, and targets are where they are: every place is known.
  result.cloud.positions = observed.at;
  result.cloud.scalars = std::move(scalars);
  return result;
}

}  // namespace scarp

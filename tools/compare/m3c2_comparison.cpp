// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From options and clouds to settings, and from rows to a cloud and a report.
#include <algorithm>
#include <cmath>

#include "ingest/neighbours/neighbours.hpp"
#include "solver/model/error.hpp"
#include "tools/compare/common_frame.hpp"
#include "tools/compare/detection.hpp"
#include "tools/compare/m3c2.hpp"
#include "tools/compare/statistics.hpp"
#include "tools/compare/survey_errors.hpp"

namespace scarp {
namespace {

/// Distance within which the sparser cloud has about 30 points, the usual number for a mean: the median over up to
/// a thousand core points, with two digits.
double usual_radius(const M3c2Input& input) {
  constexpr std::size_t kWanted = 30, kSamples = 1000;
  const Neighbours simulated(input.simulated), observed(input.observed);
  const std::size_t step = std::max<std::size_t>(1, input.cores.size() / kSamples);
  std::vector<double> distances;
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < input.cores.size(); i += step) {
    double widest = 0;
    for (const Neighbours* cloud : {&simulated, &observed}) {
      cloud->nearest(input.cores[i], kWanted, found);
      widest = std::max(widest, found.back().squared_distance);
    }
    distances.push_back(std::sqrt(widest));
  }
  std::sort(distances.begin(), distances.end());
  const double radius = quantile(distances, 0.5);
  if (!(radius > 0))
    throw Error("compare", "the radius of the cylinders cannot be guessed: the core points and the clouds coincide",
                "cylinder_radius = 0", "above 0 m");
  const double digit = std::pow(10, std::floor(std::log10(radius)) - 1);
  return std::ceil(radius / digit) * digit;
}

void require_normals(const PointCloud& cores) {
  if (cores.normals.size() != cores.size())
    throw Error("compare", "the core points bring no normals", "normals = \"core\"",
                "core points from a file with NormalX, NormalY, NormalZ, or normals of \"simulated\", \"observed\", "
                "\"vertical\"");
}

M3c2Settings settings_of(const CompareOptions& options, const M3c2Input& input, const Vec3& origin) {
  const M3c2Options& m = options.m3c2;
  M3c2Settings s;
  s.rules = rules_of(options.convention, m);
  s.source = m.normals;
  s.average = m.average;
  s.radius = m.cylinder_radius > 0 ? m.cylinder_radius : usual_radius(input);
  s.half_length = options.max_distance;
  s.registration_error = options.registration_error;
  s.simulated_floor = options.simulated_spacing / std::sqrt(12.0);
  const bool sided = m.orientation == NormalSide::towards || m.orientation == NormalSide::away;
  if (sided && !m.viewpoint)
    throw Error("compare", "orientation \"" + std::string(name_of(m.orientation)) + "\" needs a viewpoint");
  s.normals = {m.normal_radii, s.rules.closed_ball, s.rules.scale, m.orientation,
               m.viewpoint ? *m.viewpoint - origin : Vec3{0, 0, 0}};
  if (s.normals.radii.empty()) s.normals.radii = {s.radius, 2 * s.radius, 4 * s.radius};
  if (m.detection == DetectionSource::errors) {
    s.rules.segments = false;
    s.rules.minimum_points = static_cast<std::size_t>(std::max(1, m.minimum_points));
  }
  return s;
}

void check(const CompareOptions& options) {
  require_max_distance(options);
  const auto refuse_negative = [](const char* what, double value) {
    if (!(value >= 0)) throw Error("compare", what, shortest(value), "at least 0 m");
  };
  refuse_negative("cylinder_radius", options.m3c2.cylinder_radius);
  refuse_negative("registration_error", options.registration_error);
  refuse_negative("simulated_spacing", options.simulated_spacing);
  for (double radius : options.m3c2.normal_radii)
    if (!(radius > 0)) throw Error("compare", "a radius of normal_radii", shortest(radius), "above 0 m");
}

std::vector<PointScalar> scalars_of(const std::vector<M3c2Row>& rows, bool propagated) {
  std::vector<PointScalar> scalars;
  const auto add = [&](const char* name, const char* unit, auto&& value) {
    PointScalar scalar{name, unit, {}};
    scalar.values.reserve(rows.size());
    for (const M3c2Row& row : rows) scalar.values.push_back(static_cast<double>(value(row)));
    scalars.push_back(std::move(scalar));
  };
  add("distance", "m", [](const M3c2Row& r) { return r.distance; });
  add("lod", "m", [](const M3c2Row& r) { return r.detection; });
  scalars.push_back({"significant", "1", significant(scalars[0].values, scalars[1].values)});
  add("spread_simulated", "m", [](const M3c2Row& r) { return r.simulated.spread; });
  add("spread_observed", "m", [](const M3c2Row& r) { return r.observed.spread; });
  add("count_simulated", "1", [](const M3c2Row& r) { return r.simulated.count; });
  add("count_observed", "1", [](const M3c2Row& r) { return r.observed.count; });
  if (propagated) {
    add("sigma_simulated", "m", [](const M3c2Row& r) { return r.sigma_simulated; });
    add("sigma_observed", "m", [](const M3c2Row& r) { return r.sigma_observed; });
    add("sigma_alignment", "m", [](const M3c2Row& r) { return r.sigma_alignment; });
  }
  add("normal_radius", "m", [](const M3c2Row& r) { return r.normal.radius; });
  add("flags", "1", [](const M3c2Row& r) { return r.flags; });
  return scalars;
}

MeasureGroup parameters(const M3c2Settings& s, const CompareOptions& options, const std::vector<M3c2Row>& rows) {
  const auto flagged = [&](M3c2Flag flag) {
    return static_cast<std::int64_t>(
        std::count_if(rows.begin(), rows.end(), [&](const M3c2Row& row) { return (row.flags & flag) != 0; }));
  };
  std::string convention = in_words(options.convention, s.rules, s.average);
  if (s.errors)
    convention += in_words(*s.errors);
  else
    convention +=
        "lod = 1.96 (sqrt(max(s1^2/n1, simulated_floor^2) + s2^2/n2) + registration_error), s the spreads, n the "
        "counts, 1 the simulated and 2 the observed side. ";
  convention +=
      "lod is null for fewer than minimum_points. Where there is nothing to measure distance, lod and significant are "
      "NaN and counts 0. flags of a point: 1 no normal, 2 no simulated points, 4 no observed points, 8 no level of "
      "detection, or their sum.";
  return {"m3c2",
          convention,
          {{"cylinder_radius", s.radius, "m"},
           {"half_length", s.half_length, "m"},
           {"normal_radii", s.normals.radii, "m"},
           {"normals", std::string(name_of(s.source))},
           {"orientation", std::string(name_of(s.normals.side))},
           {"average", std::string(name_of(s.average))},
           {"minimum_points", static_cast<std::int64_t>(s.rules.minimum_points)},
           {"registration_error", s.registration_error, "m"},
           {"simulated_floor", s.simulated_floor, "m"},
           {"core_points", static_cast<std::int64_t>(rows.size())},
           {"without_normal", flagged(kNoNormal)},
           {"without_simulated_points", flagged(kNoSimulated)},
           {"without_observed_points", flagged(kNoObserved)},
           {"without_lod", flagged(kNoDetection)}}};
}

}  // namespace

Comparison compare_m3c2(const PointCloud& simulated, const PointCloud& observed, const PointCloud* cores,
                        const CompareOptions& options, int threads) {
  check(options);
  require_points(simulated, "simulated");
  require_points(observed, "observed");
  if (cores) require_points(*cores, "core");
  Comparison result{cores ? *cores : simulated, {}, start_report(options)};
  if (options.m3c2.normals == NormalSource::core) require_normals(result.cloud);
  const Vec3 origin = common_origin(simulated.site, observed.site);
  const M3c2Input input{moved(simulated.positions, simulated.site.origin, origin),
                        moved(observed.positions, observed.site.origin, origin),
                        moved(result.cloud.positions, result.cloud.site.origin, origin), result.cloud.normals};
  M3c2Settings settings = settings_of(options, input, origin);
  if (options.m3c2.detection == DetectionSource::errors)
    settings.errors = survey_errors(options, simulated, observed, input.observed, origin);
  const std::vector<M3c2Row> rows = m3c2(input, settings, threads);

  std::vector<PointScalar> scalars = scalars_of(rows, settings.errors.has_value());
  result.report.distances = distance_statistics(scalars[0].values, options.max_distance,
                                                "Distance from the simulated to the observed surface along the normal, "
                                                "positive where the observed one lies on the normal's side.");
  result.report.groups = {beyond_noise(scalars[0].values, scalars[1].values), parameters(settings, options, rows)};
  result.cloud.normals.clear();
  for (const M3c2Row& row : rows) result.cloud.normals.push_back(row.normal.direction);
  put_first(result.cloud, std::move(scalars));
  return result;
}

}  // namespace scarp

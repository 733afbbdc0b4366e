// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/survey_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

/// Which scanner saw each point, counted from 0; empty where there is at most one.
std::vector<std::uint16_t> scanners_of(const PointCloud& cloud, const ScannerOptions& scanner,
                                       const std::string& which) {
  const std::size_t count = scanner.positions.size();
  if (count < 2) return {};
  const PointScalar* field = find_scalar(cloud, "scan_position");
  if (!field)
    throw Error("compare", "which of several scanners saw a point of the " + which + " side",
                "no field \"scan_position\"", "a field \"scan_position\" of 1 to " + std::to_string(count));
  std::vector<std::uint16_t> scanners;
  scanners.reserve(cloud.size());
  for (double value : field->values) {
    if (!(value >= 1 && value <= static_cast<double>(count)) || value != std::floor(value))
      throw Error("compare", "scan_position of a point of the " + which + " side", shortest(value),
                  "1 to " + std::to_string(count));
    scanners.push_back(static_cast<std::uint16_t>(value - 1));
  }
  return scanners;
}

SideErrors side_errors(const PointCloud& cloud, const ScannerOptions& scanner, double floor, const Vec3& origin,
                       const std::string& which) {
  SideErrors side{scanner, scanners_of(cloud, scanner, which), scanner.positions.empty() ? floor : 0};
  if (scanner.positions.empty() && !(floor > 0))
    throw Error("compare", "nothing is known of the errors of the " + which + " side", "no scanner positions",
                "scanner_" + which + ".positions" + (which == "simulated" ? ", or simulated_spacing" : ""));
  for (Vec3& p : side.scanner.positions) p = p - origin;
  return side;
}

AlignmentCovariance alignment_of(const AlignmentOptions& options) {
  constexpr double kDegree = std::numbers::pi / 180;
  if (options.covariance.empty()) return rigid_alignment(options.sigma_translation, kDegree * options.sigma_rotation);
  AlignmentCovariance C{};
  if (options.covariance.size() != C.size() || options.sigma_translation > 0 || options.sigma_rotation > 0)
    throw Error("compare", "alignment.covariance", std::to_string(options.covariance.size()) + " numbers",
                "144, in place of sigma_translation and sigma_rotation");
  std::copy(options.covariance.begin(), options.covariance.end(), C.begin());
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < 12; ++j)
      if (!(C[13 * i] >= 0) || std::abs(C[12 * i + j] - C[12 * j + i]) > 1e-9 * std::sqrt(C[13 * i] * C[13 * j]))
        throw Error("compare", "alignment.covariance is no covariance", "row " + std::to_string(i + 1),
                    "symmetric, with a diagonal of at least 0");
  return C;
}

}  // namespace

SurveyErrors survey_errors(const CompareOptions& options, const PointCloud& simulated, const PointCloud& observed,
                           const std::vector<Vec3>& local, const Vec3& origin) {
  const M3c2Options& m = options.m3c2;
  const bool published = options.convention == CompareConvention::py4dgeo;
  if (!published && options.convention != CompareConvention::scarp)
    throw Error("compare", "detection = \"errors\" and a convention", std::string(name_of(options.convention)),
                "\"scarp\" or \"py4dgeo\"");
  if (m.average != Average::mean)
    throw Error("compare", "detection = \"errors\" and an average", std::string(name_of(m.average)), "\"mean\"");
  SurveyErrors errors;
  errors.rule = published ? PropagationRule::py4dgeo : PropagationRule::mean;
  errors.simulated =
      side_errors(simulated, m.scanner_simulated, options.simulated_spacing / std::sqrt(12.0), origin, "simulated");
  errors.observed = side_errors(observed, m.scanner_observed, 0, origin, "observed");
  errors.alignment = alignment_of(m.alignment);
  const Box3 box = bounds(local);
  errors.centre = m.alignment.centre ? *m.alignment.centre - origin : 0.5 * (box.min + box.max);
  return errors;
}

std::string in_words(const SurveyErrors& errors) {
  const std::string shared =
      "Levels of detection by propagated errors (M3C2-EP, Winiwarter et al. 2021): C_i the covariance of a point by "
      "range, "
      "azimuth and elevation, C_a that of the alignment of the observed side. The sign of a distance stays observed - "
      "simulated. ";
  if (errors.rule == PropagationRule::mean)
    return shared +
           "S = sum C_i / n^2 of either side + C_a at the observed mean; of a simulation spacing^2 / 12 along every "
           "axis "
           "in place of the first; lod = 1.96 (sqrt(n^T S n) + registration_error). sigma_*: sqrt(n^T . n) of each "
           "part. ";
  return shared +
         "As coded in py4dgeo, which has the opposite sign: S = sum C_i / n (not n^2) of either side + mean of C_a, "
         "means "
         "weighted by C_i^-1, variance of a range s^2 + 1e-6 s r^2, lod = sqrt(7.8147 / (n^T S^-1 n)), "
         "registration_error not used. ";
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a comparison of a simulation with an observation found: every number with its unit, every group of numbers
// with the convention that gives them their meaning. One structure for all methods, and one JSON made of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace scarp {

/// NaN and infinity mean "undefined" and become null in JSON.
using MeasureValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

struct Measure {
  std::string name;  ///< lower_case, without the unit
  MeasureValue value;
  std::string unit = "1";  ///< "1" when dimensionless; the JSON key is name_unit ("added_m3"), or the bare name
};

/// Numbers that share a convention: a table of the JSON.
struct MeasureGroup {
  std::string name;        ///< lower_case: "significance", "volumes", "footprint"
  std::string convention;  ///< formulas, signs and treatment of missing data, in whole sentences
  std::vector<Measure> measures;
};

/// Distances from simulated points to the observation, m. Statistics over matched points, NaN where nothing matched.
struct DistanceReport {
  std::string convention;   ///< what a distance is, and its sign
  std::size_t points = 0;   ///< of which a distance was asked
  std::size_t matched = 0;  ///< with a counterpart; the rest are NaN
  double max_distance = 0;
  double mean = 0;                ///< with sign, where distances have one
  double median = 0;              ///< with sign
  double standard_deviation = 0;  ///< n - 1
  double nmad = 0;                ///< see robust_spread: the standard deviation of a normal core
  double root_mean_square = 0;
  double mean_absolute = 0;
  double percentile_95 = 0;  ///< of |d|
  double largest = 0;        ///< of |d|
};

/// What the two sides are called where a person reads: two surveys are neither simulated nor observed.
struct SideNames {
  std::string simulated = "simulated", observed = "observed";
};

struct ComparisonReport {
  std::string name;
  std::string method;      ///< "c2c", "m3c2", ...
  std::string convention;  ///< whose rules, where programs differ
  SideNames sides;
  std::optional<DistanceReport> distances;  ///< of methods that measure per point
  std::vector<MeasureGroup> groups;         ///< everything else
  std::vector<std::string> warnings;        ///< whole sentences
};

}  // namespace scarp

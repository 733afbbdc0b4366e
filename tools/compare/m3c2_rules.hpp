// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the programs of the field differ in M3C2, and what each convention decides.
#pragma once

#include <string>
#include <vector>

#include "solver/model/compare_options.hpp"
#include "tools/compare/normals.hpp"

namespace scarp {

/// How a quartile of n sorted values is taken.
enum class QuartileRule {
  floor_rank,  ///< the value at floor(p n); where p n is whole the mean of it and the one before
  half_median  ///< medians of the lower and the upper half, each of (n + 1) / 2 values
};

struct M3c2Rules {
  /// Cylinders in ceil(half length / radius) segments with open ends, at least as long as wide, as py4dgeo searches
  /// them: points on a plane between two segments are in neither. Else one closed cylinder, |t| <= half length.
  bool segments = false;
  bool closed_ball = false;   ///< neighbourhoods of normals hold their border
  bool sample_spread = true;  ///< variance with n - 1; else with n
  bool half_medians = false;  ///< QuartileRule
  ScaleChoice scale = ScaleChoice::planarity;
  std::size_t minimum_points = 1;  ///< of both clouds for a level of detection
};

M3c2Rules rules_of(CompareConvention convention, const M3c2Options& options);

/// The rules in whole sentences, for the report.
std::string in_words(CompareConvention convention, const M3c2Rules& rules, Average average);

/// What stands for the points of a cloud in a cylinder.
struct Level {
  double position;  ///< mean or median along the normal, m; NaN of none
  double spread;    ///< standard deviation or interquartile range, m; NaN where undefined
  std::size_t count;
};

/// Of positions along the normal (m), which are sorted for the median. Undefined: the spread of none, and the sample
/// standard deviation of one.
Level level_of(std::vector<double>& positions, Average average, const M3c2Rules& rules);

}  // namespace scarp

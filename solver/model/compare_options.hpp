// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "solver/model/schema.hpp"

namespace scarp {

/// Which frame is held against the scan.
enum class SimulatedFrame { last, first };
template <>
struct enum_names<SimulatedFrame> {
  static constexpr std::array<std::pair<std::string_view, SimulatedFrame>, 2> value{
      {{"last", SimulatedFrame::last}, {"first", SimulatedFrame::first}}};
};

/// How two surfaces are held against each other.
enum class CompareMethod { c2c };
template <>
struct enum_names<CompareMethod> {
  static constexpr std::array<std::pair<std::string_view, CompareMethod>, 1> value{{{"c2c", CompareMethod::c2c}}};
};

/// Whose rules decide where programs of the field differ.
enum class CompareConvention { scarp };
template <>
struct enum_names<CompareConvention> {
  static constexpr std::array<std::pair<std::string_view, CompareConvention>, 1> value{
      {{"scarp", CompareConvention::scarp}}};
};

struct CompareTolerance {
  std::optional<double> mean;
  std::optional<double> median;
  std::optional<double> percentile_95;
  std::optional<double> largest;

  template <class V>
  void describe(V&& v) {
    v("mean", mean, Spec{.text = "largest mean distance, whatever its sign", .unit = "m", .at_least = 0});
    v("median", median, Spec{.text = "largest median distance, whatever its sign", .unit = "m", .at_least = 0});
    v("percentile_95", percentile_95,
      Spec{.text = "largest 95th percentile of the distances' absolute values", .unit = "m", .at_least = 0});
    v("largest", largest, Spec{.text = "largest single distance", .unit = "m", .at_least = 0});
  }
};

struct CompareOptions {
  std::string name;
  SimulatedFrame simulated = SimulatedFrame::last;
  std::string observed;
  CompareMethod method = CompareMethod::c2c;
  CompareConvention convention = CompareConvention::scarp;
  double max_distance = 0;
  CompareTolerance tolerance;

  template <class V>
  void describe(V&& v) {
    v("name", name, Spec{.text = "stem of the result files; default: SIMULATED_OBSERVED"});
    v("simulated", simulated, Spec{.text = "frame that is held against the scan"});
    v("observed", observed, Spec{.text = "name of a scan", .required = true});
    v("method", method, Spec{.text = "c2c: distance to the nearest point"});
    v("convention", convention, Spec{.text = "whose rules decide where programs differ"});
    v("max_distance", max_distance,
      Spec{.text = "beyond it a point has no counterpart (NaN); 0 means ten cells", .unit = "m", .at_least = 0});
    v("tolerance", tolerance, Spec{.text = "limits whose excess ends the program with exit code 4"});
  }
};

}  // namespace scarp

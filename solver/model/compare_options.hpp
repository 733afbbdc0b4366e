// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "solver/model/c2c_options.hpp"
#include "solver/model/displacement_options.hpp"
#include "solver/model/dod_options.hpp"
#include "solver/model/m3c2_options.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// Names in CompareOptions::simulated that mean a frame of the run; any other is a scan.
inline constexpr std::string_view kLastFrame = "last", kFirstFrame = "first";

/// How two surfaces are held against each other.
enum class CompareMethod { c2c, m3c2, c2m, dod, footprint, displacement };
template <>
struct enum_names<CompareMethod> {
  static constexpr std::array<std::pair<std::string_view, CompareMethod>, 6> value{
      {{"c2c", CompareMethod::c2c},
       {"m3c2", CompareMethod::m3c2},
       {"c2m", CompareMethod::c2m},
       {"dod", CompareMethod::dod},
       {"footprint", CompareMethod::footprint},
       {"displacement", CompareMethod::displacement}}};
};

/// Whose rules decide where programs of the field differ.
enum class CompareConvention { scarp, py4dgeo, cloudcompare, pdal };
template <>
struct enum_names<CompareConvention> {
  static constexpr std::array<std::pair<std::string_view, CompareConvention>, 4> value{
      {{"scarp", CompareConvention::scarp},
       {"py4dgeo", CompareConvention::py4dgeo},
       {"cloudcompare", CompareConvention::cloudcompare},
       {"pdal", CompareConvention::pdal}}};
};

struct CompareTolerance {
  std::optional<double> mean;
  std::optional<double> median;
  std::optional<double> percentile_95;
  std::optional<double> largest;
  std::optional<double> net_volume;
  std::optional<double> iou;

  template <class V>
  void describe(V&& v) {
    v("mean", mean, Spec{.text = "largest mean distance, whatever its sign", .unit = "m", .at_least = 0});
    v("median", median, Spec{.text = "largest median distance, whatever its sign", .unit = "m", .at_least = 0});
    v("percentile_95", percentile_95,
      Spec{.text = "largest 95th percentile of the distances' absolute values", .unit = "m", .at_least = 0});
    v("largest", largest, Spec{.text = "largest single distance", .unit = "m", .at_least = 0});
    v("net_volume", net_volume,
      Spec{.text = "method dod: largest net volume of difference, whatever its sign", .unit = "m3", .at_least = 0});
    v("iou", iou,
      Spec{.text = "least overlap of the footprints, intersection over union (footprint, or dod with before)",
           .at_least = 0,
           .at_most = 1});
  }
};

struct CompareOptions {
  std::string name;
  std::string simulated{kLastFrame};
  std::string observed;
  CompareMethod method = CompareMethod::c2c;
  CompareConvention convention = CompareConvention::scarp;
  double max_distance = 0;
  double registration_error = 0;
  double simulated_spacing = 0;
  C2cOptions c2c;
  M3c2Options m3c2;
  DodOptions dod;
  std::optional<std::string> before;
  FootprintOptions footprint;
  DisplacementOptions displacement;
  std::vector<Vec2> section;
  bool pictures = true;
  CompareTolerance tolerance;

  bool of_frame() const { return simulated == kLastFrame || simulated == kFirstFrame; }

  template <class V>
  void describe(V&& v) {
    v("name", name, Spec{.text = "stem of the result files; default: SIMULATED_OBSERVED"});
    v("simulated", simulated,
      Spec{.text =
               "what is held against the scan: the \"last\" or \"first\" frame, or, to compare two surveys, the name "
               "of another scan"});
    v("observed", observed, Spec{.text = "name of a scan", .required = true});
    v("method", method,
      Spec{.text =
               "c2c: distance to the nearest point; m3c2: distance along normals between local averages, with a level "
               "of detection; dod: difference of the two as rasters, with volumes; footprint: overlap and run-out of "
               "two rasters of thickness; displacement: vectors at targets or of blocks that moved from one survey to "
               "the "
               "next, against those of the simulation"});
    v("convention", convention, Spec{.text = "whose rules decide where programs differ"});
    v("max_distance", max_distance,
      Spec{.text = "beyond it a point has no counterpart (NaN); 0 means ten cells of the domain",
           .unit = "m",
           .at_least = 0});
    v("registration_error", registration_error,
      Spec{.text = "standard deviation of a shift between the two sides that all points share; in practice that of "
                   "distances on stable ground",
           .unit = "m",
           .at_least = 0});
    v("simulated_spacing", simulated_spacing,
      Spec{.text = "distance between material points: what is finer the simulation does not resolve, so that its "
                   "standard error is at least this / sqrt(12); 0: that of the coarsest body, of other files than "
                   "frames none",
           .unit = "m",
           .at_least = 0});
    v("c2c", c2c, Spec{.text = "what method c2c measures to"});
    v("m3c2", m3c2, Spec{.text = "how method m3c2 takes normals and averages"});
    v("dod", dod, Spec{.text = "the difference of two rasters"});
    v("before", before,
      Spec{.text =
               "the ground before, a scan (of two files: a file). dod: where a surface differs from it by more than "
               "footprint.threshold is its footprint; footprint: the terrain, for the drop; displacement: the survey "
               "that "
               "blocks moved from, where the simulated side is a frame"});
    v("footprint", footprint, Spec{.text = "footprint and run-out"});
    v("displacement", displacement, Spec{.text = "displacement vectors"});
    v("section", section,
      Spec{.text = "corners of a line in plan along which both surfaces are cut; dod only",
           .unit = "m",
           .role = Role::position});
    v("pictures", pictures,
      Spec{.text = "also draw the results: map and histogram of the differences, footprints, section"});
    v("tolerance", tolerance, Spec{.text = "limits whose excess ends the program with exit code 4"});
  }
};

}  // namespace scarp

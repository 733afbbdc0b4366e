// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"
#include "solver/model/survey_error_options.hpp"

namespace scarp {

/// Of which surface the normals are taken.
enum class NormalSource { simulated, observed, core, vertical };
template <>
struct enum_names<NormalSource> {
  static constexpr std::array<std::pair<std::string_view, NormalSource>, 4> value{
      {{"simulated", NormalSource::simulated},
       {"observed", NormalSource::observed},
       {"core", NormalSource::core},
       {"vertical", NormalSource::vertical}}};
};

/// To which side normals point; without a preference the sign is arbitrary.
enum class NormalSide { up, down, east, west, north, south, towards, away, none };
template <>
struct enum_names<NormalSide> {
  static constexpr std::array<std::pair<std::string_view, NormalSide>, 9> value{{{"+z", NormalSide::up},
                                                                                 {"-z", NormalSide::down},
                                                                                 {"+x", NormalSide::east},
                                                                                 {"-x", NormalSide::west},
                                                                                 {"+y", NormalSide::north},
                                                                                 {"-y", NormalSide::south},
                                                                                 {"towards", NormalSide::towards},
                                                                                 {"away", NormalSide::away},
                                                                                 {"none", NormalSide::none}}};
};

/// What stands for the points in a cylinder: mean and standard deviation, or median and interquartile range.
enum class Average { mean, median };
template <>
struct enum_names<Average> {
  static constexpr std::array<std::pair<std::string_view, Average>, 2> value{
      {{"mean", Average::mean}, {"median", Average::median}}};
};

/// What a level of detection is made of.
enum class DetectionSource { spread, errors };
template <>
struct enum_names<DetectionSource> {
  static constexpr std::array<std::pair<std::string_view, DetectionSource>, 2> value{
      {{"spread", DetectionSource::spread}, {"errors", DetectionSource::errors}}};
};

/// Distances between two clouds along the normals of the first (M3C2: Lague, Brodu & Leroux 2013). All lengths are
/// radii, never diameters; the half length of the cylinders is the comparison's max_distance.
struct M3c2Options {
  std::vector<double> normal_radii;
  double cylinder_radius = 0;
  NormalSource normals = NormalSource::simulated;
  NormalSide orientation = NormalSide::up;
  std::optional<Vec3> viewpoint;
  Average average = Average::mean;
  int minimum_points = 5;
  std::optional<InputFile> core_points;
  double core_spacing = 0;
  DetectionSource detection = DetectionSource::spread;
  ScannerOptions scanner_simulated, scanner_observed;
  AlignmentOptions alignment;

  template <class V>
  void describe(V&& v) {
    v("normal_radii", normal_radii,
      Spec{.text = "radii of the neighbourhoods of a normal; of several the flattest wins; default: 1, 2 and 4 times "
                   "cylinder_radius",
           .unit = "m",
           .above = 0});
    v("cylinder_radius", cylinder_radius,
      Spec{.text = "radius of the cylinders in which the two clouds are averaged; 0: so that about 30 points of the "
                   "sparser cloud are in one",
           .unit = "m",
           .at_least = 0});
    v("normals", normals,
      Spec{.text =
               "what the normals are of: the simulated or the observed points around a core point, the normals that "
               "the core points bring, or the vertical"});
    v("orientation", orientation,
      Spec{.text = "side to which normals point: along an axis, towards the viewpoint, away from it, or as they come"});
    v("viewpoint", viewpoint,
      Spec{.text = "point for orientation = \"towards\" or \"away\"", .unit = "m", .role = Role::position});
    v("average", average,
      Spec{.text = "mean and standard deviation, or median and interquartile range, of the points in a cylinder"});
    v("minimum_points", minimum_points,
      Spec{.text = "of either cloud in a cylinder, for a level of detection (conventions scarp and cloudcompare)",
           .at_least = 1,
           .at_most = 1e6});
    v("core_points", core_points,
      Spec{.text = "cloud of the points at which distances are measured; default: the simulated points"});
    v("core_spacing", core_spacing,
      Spec{.text = "thins the core points to one per cube of this edge; 0 keeps all", .unit = "m", .at_least = 0});
    v("detection", detection,
      Spec{.text =
               "what the level of detection is made of: the spread of the points in a cylinder, or the errors of their "
               "measurement and alignment, propagated (M3C2-EP)"});
    v("scanner_simulated", scanner_simulated,
      Spec{.text = "of the simulated side, where that is a survey too; a simulation has simulated_spacing / sqrt(12) "
                   "along every axis"});
    v("scanner_observed", scanner_observed, Spec{.text = "errors of the observed side's measurements"});
    v("alignment", alignment, Spec{.text = "errors of the observed side's registration"});
  }
};

}  // namespace scarp

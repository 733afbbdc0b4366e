// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"
#include "solver/model/synth_options.hpp"

namespace scarp {

struct Crop {
  static constexpr std::string_view name = "crop";
  Vec3 min{-INFINITY, -INFINITY, -INFINITY};
  Vec3 max{INFINITY, INFINITY, INFINITY};

  template <class V>
  void describe(V&& v) {
    v("min", min,
      Spec{.text = "lower corner of the box that is kept, site coordinates",
           .unit = "m",
           .required = true,
           .role = Role::position});
    v("max", max,
      Spec{.text = "upper corner of the box that is kept, site coordinates",
           .unit = "m",
           .required = true,
           .role = Role::position});
  }
};

struct StatisticalOutlier {
  static constexpr std::string_view name = "statistical-outlier";
  int neighbours = 16;
  double deviations = 2.0;

  template <class V>
  void describe(V&& v) {
    v("neighbours", neighbours,
      Spec{
          .text = "how many nearest neighbours a point's mean distance is taken over", .at_least = 1, .at_most = 1000});
    v("deviations", deviations,
      Spec{.text = "points farther than mean + this many standard deviations are dropped", .at_least = 0});
  }
};

struct VoxelThin {
  static constexpr std::string_view name = "voxel-thin";
  double size = 0;

  template <class V>
  void describe(V&& v) {
    v("size", size,
      Spec{.text = "edge of a voxel; of its points the one nearest their centroid is kept",
           .unit = "m",
           .above = 0,
           .required = true});
  }
};

using CleanFilter = std::variant<Crop, StatisticalOutlier, VoxelThin>;
template <>
struct choice_key<CleanFilter> {
  static constexpr std::string_view value = "filter";
};

/// Unit of a file's heights, where it is not that of x and y.
enum class HeightUnit { metre, foot, us_survey_foot };
template <>
struct enum_names<HeightUnit> {
  static constexpr std::array<std::pair<std::string_view, HeightUnit>, 3> value{
      {{"m", HeightUnit::metre}, {"ft", HeightUnit::foot}, {"us-ft", HeightUnit::us_survey_foot}}};
};

/// One observed cloud: a file, or the virtual scanner's.
struct ScanOptions {
  std::string name;
  std::optional<InputFile> file;
  std::optional<SyntheticScan> synthetic;
  HeightUnit height_unit = HeightUnit::metre;
  Vec3 shift{0, 0, 0};
  std::vector<CleanFilter> clean;

  template <class V>
  void describe(V&& v) {
    v("name", name, Spec{.text = "how bodies and comparisons refer to this scan", .required = true});
    v("file", file, Spec{.text = "LAS, LAZ, COPC, PLY, PCD, XYZ/CSV/TXT, ESRI ASCII grid or GeoTIFF"});
    v("synthetic", synthetic, Spec{.text = "make the scan with the virtual scanner instead of reading a file"});
    v("height_unit", height_unit, Spec{.text = "unit of the file's heights"});
    v("shift", shift,
      Spec{.text = "added to the file's coordinates, in their units, as they are read: for a file that counts from a "
                   "place of its own"});
    v("clean", clean, Spec{.text = "cleaning steps, in this order"});
  }
};

}  // namespace scarp

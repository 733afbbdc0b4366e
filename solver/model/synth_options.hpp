// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// A slide that has happened: a scar cut out of the slope and a lobe of the same volume below it, 1.3 times as
/// wide (x) and 1.5 times as long (y) as the scar. Both must lie within the scan's extent.
struct SyntheticSlide {
  Vec2 scar_centre{0, 0};
  double scar_radius = 0;
  double depth = 0;
  double travel = 0;

  template <class V>
  void describe(V&& v) {
    v("scar_centre", scar_centre, Spec{.text = "centre of the scar in plan", .unit = "m", .required = true});
    v("scar_radius", scar_radius,
      Spec{.text = "radius of the scar in plan", .unit = "m", .above = 0, .required = true});
    v("depth", depth, Spec{.text = "largest depth of the scar, vertical", .unit = "m", .above = 0, .required = true});
    v("travel", travel,
      Spec{.text = "distance in plan from the scar's centre down to the lobe's",
           .unit = "m",
           .above = 0,
           .required = true});
  }
};

/// The virtual scanner: a procedural slope, seen from one position, with the faults of a real scan.
///
/// The slope rises along +y from a flat toe to a flat crest, with fractal roughness.
struct SyntheticScan {
  std::int64_t seed = 1;
  std::int64_t survey = 0;
  Vec2 size{100, 100};
  double toe_length = 20;
  double crest_length = 20;
  double height = 40;
  double roughness = 0.5;
  double roughness_length = 15;
  Vec3 scanner{50, -30, 25};
  double density = 25;
  double reference_range = 100;
  double range_noise = 0.01;
  bool occlusion = true;
  double vegetation = 0.05;
  double vegetation_height = 1.5;
  double outliers = 0.001;
  double truth_cell = 0.25;
  Vec3 site_offset{0, 0, 0};
  std::optional<SyntheticSlide> slide;

  template <class V>
  void describe(V&& v) {
    v("seed", seed, Spec{.text = "seed of everything random", .at_least = 0});
    v("survey", survey,
      Spec{
          .text = "which survey of the same ground: another draw of the rays, the noise, the vegetation and the strays",
          .at_least = 0});
    v("size", size, Spec{.text = "extent in x and y", .unit = "m", .above = 0});
    v("toe_length", toe_length, Spec{.text = "length in y of the flat ground at the toe", .unit = "m", .at_least = 0});
    v("crest_length", crest_length,
      Spec{.text = "length in y of the flat ground behind the crest", .unit = "m", .at_least = 0});
    v("height", height, Spec{.text = "height from toe to crest", .unit = "m", .at_least = 0});
    v("roughness", roughness,
      Spec{.text = "standard deviation of the terrain's fractal roughness", .unit = "m", .at_least = 0});
    v("roughness_length", roughness_length,
      Spec{.text = "wavelength of the coarsest roughness", .unit = "m", .above = 0});
    v("scanner", scanner, Spec{.text = "position of the scanner, before site_offset", .unit = "m"});
    v("density", density,
      Spec{.text = "points per square metre of a surface that faces the scanner at the reference range",
           .unit = "1/m2",
           .above = 0});
    v("reference_range", reference_range,
      Spec{.text = "range at which the density holds; it falls with the square of the range", .unit = "m", .above = 0});
    v("range_noise", range_noise, Spec{.text = "standard deviation of the range", .unit = "m", .at_least = 0});
    v("occlusion", occlusion, Spec{.text = "drop what the scanner cannot see"});
    v("vegetation", vegetation,
      Spec{.text = "share of the points that hit vegetation above the ground", .at_least = 0, .at_most = 1});
    v("vegetation_height", vegetation_height,
      Spec{.text = "height of the tallest vegetation", .unit = "m", .at_least = 0});
    v("outliers", outliers, Spec{.text = "share of the points that are stray returns", .at_least = 0, .at_most = 0.5});
    v("truth_cell", truth_cell, Spec{.text = "cell of the raster of the bare ground", .unit = "m", .above = 0});
    v("site_offset", site_offset,
      Spec{.text = "whole metres added to all coordinates, to mimic a national grid", .unit = "m"});
    v("slide", slide, Spec{.text = "a slide that has happened before the scan"});
  }
};

}  // namespace scarp

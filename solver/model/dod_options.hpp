// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/schema.hpp"

namespace scarp {

/// Height of a raster cell made of the points in it.
enum class CellPolicy { mean, median, min, max, tin };
template <>
struct enum_names<CellPolicy> {
  static constexpr std::array<std::pair<std::string_view, CellPolicy>, 5> value{{{"mean", CellPolicy::mean},
                                                                                 {"median", CellPolicy::median},
                                                                                 {"min", CellPolicy::min},
                                                                                 {"max", CellPolicy::max},
                                                                                 {"tin", CellPolicy::tin}}};
};

/// Where ground is taken to have stayed.
enum class StableGround { none, automatic, polygon, mask };
template <>
struct enum_names<StableGround> {
  static constexpr std::array<std::pair<std::string_view, StableGround>, 4> value{
      {{"none", StableGround::none},
       {"automatic", StableGround::automatic},
       {"polygon", StableGround::polygon},
       {"mask", StableGround::mask}}};
};

struct StableOptions {
  StableGround ground = StableGround::none;
  std::vector<Vec2> polygon;
  std::optional<InputFile> mask;
  double steepest = 20;
  double clip = 3;
  bool remove_bias = false;

  template <class V>
  void describe(V&& v) {
    v("ground", ground,
      Spec{.text = "where ground is taken to have stayed: nowhere; found by clipping the differences on gentle slopes; "
                   "inside a polygon; where a mask raster is not 0"});
    v("polygon", polygon,
      Spec{.text = "corners of the stable ground in plan, for ground = \"polygon\"",
           .unit = "m",
           .role = Role::position});
    v("mask", mask, Spec{.text = "raster that is not 0 on stable ground, for ground = \"mask\""});
    v("steepest", steepest,
      Spec{.text = "steeper ground of the observed surface is never stable", .unit = "deg", .above = 0, .at_most = 90});
    v("clip", clip,
      Spec{.text = "automatic: differences farther from the median than this many robust standard deviations (1.4826 x "
                   "median absolute deviation) are left out, until none is",
           .at_least = 1,
           .at_most = 100});
    v("remove_bias", remove_bias,
      Spec{.text = "subtract the median difference on stable ground (the datum bias) everywhere"});
  }
};

/// How two surfaces are held against each other as rasters (DEM of difference).
struct DodOptions {
  double cell = 0;
  CellPolicy policy = CellPolicy::mean;
  double longest_edge = 0;
  double fill_distance = 0;
  double confidence = 0.95;
  std::optional<double> uncertainty_simulated;
  std::optional<double> uncertainty_observed;
  double correlation_range = 0;
  StableOptions stable;

  template <class V>
  void describe(V&& v) {
    v("cell", cell,
      Spec{.text = "edge of a raster cell; 0: that of the observed raster, or, without one, of the simulated",
           .unit = "m",
           .at_least = 0});
    v("policy", policy,
      Spec{.text = "height of a cell: mean, median, lowest or highest of the points in it, or a triangulation of all "
                   "points at its centre"});
    v("longest_edge", longest_edge,
      Spec{.text = "triangulation: triangles at the border with longer edges are left out; 0 keeps all",
           .unit = "m",
           .at_least = 0});
    v("fill_distance", fill_distance,
      Spec{.text = "cells without data take the mean of the data within this distance, weighted by its inverse square; "
                   "0 leaves them empty",
           .unit = "m",
           .at_least = 0});
    v("confidence", confidence, Spec{.text = "of the level of detection, two-sided", .at_least = 0.5, .below = 1});
    v("uncertainty_simulated", uncertainty_simulated,
      Spec{.text = "standard deviation of a simulated height; default: of a frame's free surface what its spread says, "
                   "of other data 0",
           .unit = "m",
           .at_least = 0});
    v("uncertainty_observed", uncertainty_observed,
      Spec{.text = "standard deviation of an observed height; default: what the spread of the differences on stable "
                   "ground leaves over, or 0 without stable ground",
           .unit = "m",
           .at_least = 0});
    v("correlation_range", correlation_range,
      Spec{.text = "distance at which errors of heights are no longer correlated (range of a spherical variogram); 0: "
                   "not known, no correlated uncertainty is given",
           .unit = "m",
           .at_least = 0});
    v("stable", stable, Spec{.text = "stable ground, for the datum bias and the spread of the differences"});
  }
};

/// What of a flow counts, and along what it is measured.
struct FootprintOptions {
  double threshold = 0.1;
  std::vector<Vec2> path;
  double width_limit = 0;

  template <class V>
  void describe(V&& v) {
    v("threshold", threshold,
      Spec{.text = "a cell belongs to the footprint where its thickness or change of height is above this",
           .unit = "m",
           .at_least = 0});
    v("path", path,
      Spec{.text = "corners of the line in plan along which run-out is measured; default: the line of steepest descent "
                   "from the highest ground of the observed footprint",
           .unit = "m",
           .role = Role::position});
    v("width_limit", width_limit,
      Spec{.text = "run-out leaves out what is farther than half of this from the path; 0: nothing",
           .unit = "m",
           .at_least = 0});
  }
};

}  // namespace scarp

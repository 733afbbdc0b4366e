// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/synth/synth.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "tools/synth/ground.hpp"
#include "tools/synth/returns.hpp"
#include "tools/synth/sweep.hpp"

namespace scarp {
namespace {

/// Holds each number against its own Spec.
struct CheckRanges {
  void number(const std::string& key, double value, const Spec& spec) const {
    if (!std::isfinite(value)) throw Error("synth", key, shortest(value), "a finite number");
    if (value < spec.at_least) throw Error("synth", key, shortest(value), "at least " + shortest(spec.at_least));
    if (value <= spec.above) throw Error("synth", key, shortest(value), "above " + shortest(spec.above));
    if (value > spec.at_most) throw Error("synth", key, shortest(value), "at most " + shortest(spec.at_most));
    if (value >= spec.below) throw Error("synth", key, shortest(value), "below " + shortest(spec.below));
  }
  template <class T>
  void operator()(std::string_view key, T& value, const Spec& spec) const {
    const std::string name(key);
    if constexpr (std::is_arithmetic_v<T>) {
      number(name, static_cast<double>(value), spec);
    } else if constexpr (std::is_same_v<T, std::optional<SyntheticSlide>>) {
      if (value) value->describe(*this);
    } else {
      for (const double component : value) number(name, component, spec);
    }
  }
};

void check_slide(const SyntheticScan& scan, const SyntheticSlide& slide) {
  // The lobe's half axes are 1.3 and 1.5 radii; what falls off the extent would be missing from the volume.
  const double x = slide.scar_centre[0], y = slide.scar_centre[1], r = slide.scar_radius;
  const bool inside = x - 1.3 * r >= 0 && x + 1.3 * r <= scan.size[0] && y + r <= scan.size[1] &&
                      std::min(y - r, y - slide.travel - 1.5 * r) >= 0;
  if (!inside)
    throw Error("synth", "slide: the scar or the lobe reaches beyond the scan", {},
                "1.3 radii beside the scar's centre, travel + 1.5 radii below and 1 radius above it within the size");
}

void check_scan(SyntheticScan scan) {
  scan.describe(CheckRanges{});
  const double level = scan.toe_length + scan.crest_length;
  if (scan.height > 0 && level >= scan.size[1])
    throw Error("synth", "toe_length + crest_length leave no room for the slope", shortest(level) + " m",
                "below the size in y, " + shortest(scan.size[1]) + " m");
  if (scan.vegetation + scan.outliers > 1)
    throw Error("synth", "vegetation + outliers", shortest(scan.vegetation + scan.outliers), "at most 1");
  for (const double offset : scan.site_offset)
    if (offset != std::floor(offset) || std::abs(offset) > 1e9)
      throw Error("synth", "site_offset", shortest(offset), "whole metres, at most 1e9");
  for (const double extent : scan.size)
    if (extent > 1e5) throw Error("synth", "size", shortest(extent) + " m", "at most 1e5 m");
  constexpr double most_cells = 1e8;
  const double cells = (scan.size[0] / scan.truth_cell + 2) * (scan.size[1] / scan.truth_cell + 2);
  if (cells > most_cells)
    throw Error("synth", "truth_cell makes too many cells", shortest(std::round(cells)), "at most 1e8");
  if (scan.slide) check_slide(scan, *scan.slide);

  const Vec3& eye = scan.scanner;
  const bool over_ground = eye[0] >= 0 && eye[0] <= scan.size[0] && eye[1] >= 0 && eye[1] <= scan.size[1];
  if (over_ground && eye[2] <= ground_height(scan, eye[0], eye[1]))
    throw Error("synth", "the scanner stands below the ground", shortest(eye[2]) + " m",
                "above " + shortest(ground_height(scan, eye[0], eye[1])) + " m");
}

Heightfield make_truth(const SyntheticScan& scan, const Terrain& terrain, int threads) {
  Heightfield truth;
  truth.cell = scan.truth_cell;
  truth.columns = static_cast<int>(std::ceil(scan.size[0] / truth.cell)) + 1;
  truth.rows = static_cast<int>(std::ceil(scan.size[1] / truth.cell)) + 1;
  truth.x0 = scan.site_offset[0];
  truth.y0 = scan.site_offset[1];
  truth.z.resize(static_cast<std::size_t>(truth.columns) * static_cast<std::size_t>(truth.rows));
  parallel_for(static_cast<std::size_t>(truth.rows), threads, [&](std::size_t row) {
    for (int column = 0; column < truth.columns; ++column)
      truth.at(column, static_cast<int>(row)) =
          terrain.height(column * truth.cell, static_cast<double>(row) * truth.cell) + scan.site_offset[2];
  });
  return truth;
}

}  // namespace

SyntheticResult synthesize(const SyntheticScan& scan, int threads) {
  check_scan(scan);
  const Terrain terrain(scan);
  const Ground ground(terrain, scan.size, threads);
  const std::vector<Hit> hits = sweep(scan, ground, threads);
  if (hits.empty())
    throw Error("synth", "the scanner sees nothing of the ground", {}, "another position or more density");
  return {make_returns(scan, ground, hits, threads), make_truth(scan, terrain, threads)};
}

double ground_height(const SyntheticScan& scan, double x, double y) { return Terrain(scan).height(x, y); }

double slide_change(const SyntheticScan& scan, double x, double y) { return Terrain(scan).slide_change(x, y); }

}  // namespace scarp

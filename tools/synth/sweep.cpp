// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/synth/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "tools/synth/random.hpp"

namespace scarp {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kMostRays = 3e8, kMostRows = 1e7;

/// The part of the sphere of directions that the ground can fill, rad.
struct Window {
  double azimuth_begin = -kPi, azimuth_end = kPi;
  double elevation_begin = -kPi / 2, elevation_end = kPi / 2;

  double solid_angle() const {
    return (azimuth_end - azimuth_begin) * (std::sin(elevation_end) - std::sin(elevation_begin));
  }
};

Window window_of(const SyntheticScan& scan, const Ground& ground) {
  const Vec3& eye = scan.scanner;
  Window window;
  const double gap_x = std::max({-eye[0], eye[0] - scan.size[0], 0.0});
  const double gap_y = std::max({-eye[1], eye[1] - scan.size[1], 0.0});
  const double near = std::hypot(gap_x, gap_y);
  const double far = std::hypot(std::max(std::abs(eye[0]), std::abs(scan.size[0] - eye[0])),
                                std::max(std::abs(eye[1]), std::abs(scan.size[1] - eye[1])));
  const double up = ground.highest() - eye[2], down = ground.lowest() - eye[2];
  window.elevation_end = std::atan2(up, up > 0 ? near : far);
  window.elevation_begin = std::atan2(down, down < 0 ? near : far);
  if (near == 0) return window;

  // From outside, the extent spans less than half a turn about the direction of its middle.
  const double middle = std::atan2(scan.size[1] / 2 - eye[1], scan.size[0] / 2 - eye[0]);
  double left = 0, right = 0;
  for (const double x : {0.0, scan.size[0]})
    for (const double y : {0.0, scan.size[1]}) {
      const double turn = std::remainder(std::atan2(y - eye[1], x - eye[0]) - middle, 2 * kPi);
      left = std::max(left, turn);
      right = std::min(right, turn);
    }
  window.azimuth_begin = middle + right;
  window.azimuth_end = middle + left;
  return window;
}

void look_along(const SyntheticScan& scan, const Ground& ground, const Ray& ray, std::uint64_t key,
                std::vector<Hit>& hits) {
  if (scan.occlusion) {
    if (const auto range = ground.first_hit(ray)) hits.push_back({ray.direction, *range, key});
    return;
  }
  double from = 0;
  for (std::uint64_t n = 0; const auto crossing = ground.next_crossing(ray, from); ++n) {
    hits.push_back({ray.direction, crossing->range, join_keys(key, n)});
    from = crossing->resume;
  }
}

}  // namespace

std::vector<Hit> sweep(const SyntheticScan& scan, const Ground& ground, int threads) {
  const Window window = window_of(scan, ground);
  const double step = 1 / (std::sqrt(scan.density) * scan.reference_range);
  const double rays = window.solid_angle() / (step * step);
  const double row_span = (window.elevation_end - window.elevation_begin) / step;
  if (!(row_span <= kMostRows))
    throw Error("synth", "density and reference_range ask for too many rows of rays", shortest(std::round(row_span)),
                "at most " + shortest(kMostRows));
  if (!(rays <= kMostRays))
    throw Error("synth", "density and reference_range ask for too many rays", shortest(std::round(rays)),
                "at most " + shortest(kMostRays));

  // Each survey has its own grid of rays: two scans of one slope never meet the same points.
  const std::uint64_t key =
      join_keys(join_keys(static_cast<std::uint64_t>(scan.seed), 2), static_cast<std::uint64_t>(scan.survey));
  const double phase = unit_interval(scatter(key));
  const auto row_count = static_cast<std::size_t>(std::ceil(row_span)) + 1;
  std::vector<std::vector<Hit>> rows(row_count);
  parallel_for(row_count, threads, [&](std::size_t row) {
    const std::uint64_t row_key = join_keys(key, row);
    const double elevation = window.elevation_begin + (static_cast<double>(row) + phase - 0.5) * step;
    if (std::abs(elevation) >= kPi / 2) return;
    const double cosine = std::cos(elevation), sine = std::sin(elevation);
    const double turn = step / cosine;
    const double row_phase = unit_interval(scatter(row_key));
    for (std::uint64_t column = 0;; ++column) {
      const double azimuth = window.azimuth_begin + (static_cast<double>(column) + row_phase) * turn;
      if (azimuth >= window.azimuth_end) break;
      const Ray ray{scan.scanner, {cosine * std::cos(azimuth), cosine * std::sin(azimuth), sine}};
      look_along(scan, ground, ray, join_keys(row_key, column), rows[row]);
    }
  });

  std::vector<Hit> hits;
  for (std::vector<Hit>& row : rows) {
    hits.insert(hits.end(), row.begin(), row.end());
    std::vector<Hit>().swap(row);
  }
  return hits;
}

}  // namespace scarp

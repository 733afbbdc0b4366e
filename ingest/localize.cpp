// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/localize.hpp"

#include <algorithm>

#include "ingest/crs_text.hpp"
#include "ingest/same_crs.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr double kNearZero = 10000;  // m: below it a file is local already
constexpr double kOriginStep = 100;  // m

double metres_in(HeightUnit unit) {
  switch (unit) {
    case HeightUnit::metre:
      return 1;
    case HeightUnit::foot:
      return 0.3048;
    case HeightUnit::us_survey_foot:
      return 1200.0 / 3937.0;
  }
  return 1;
}

bool is_metre(double unit) { return std::abs(unit - 1) < 1e-9; }

std::string in_words(const Vec3& p) {
  return "(" + shortest(p[0]) + ", " + shortest(p[1]) + ", " + shortest(p[2]) + ")";
}

/// The start of a CRS text, which is what tells it from another.
std::string in_short(const std::string& crs) {
  constexpr std::size_t kShown = 80;
  std::string shown = crs.size() <= kShown ? crs : crs.substr(0, kShown) + "...";
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return shown;
}

double farthest(const Box3& box, int axis) { return std::max(std::abs(box.min[axis]), std::abs(box.max[axis])); }

bool looks_like_degrees(const Box3& box) {
  if (box.empty() || farthest(box, 0) > 180 || farthest(box, 1) > 90) return false;
  if (farthest(box, 0) <= 10 && farthest(box, 1) <= 10) return false;
  const double width = std::max(box.max[0] - box.min[0], box.max[1] - box.min[1]);
  return width < 1 && box.max[2] - box.min[2] > 10 * width;
}

/// The part of a CRS that still holds once the heights are metres.
std::string metric_crs(const std::string& crs) {
  const CrsFacts facts = read_crs(crs);
  return facts.vertical_unit > 0 && !is_metre(facts.vertical_unit) ? facts.horizontal_part : crs;
}

}  // namespace

Box3 site_bounds(const PointCloud& cloud, HeightUnit height_unit) {
  const double factor = metres_in(height_unit);
  Box3 box;
  for (const Vec3& p : cloud.positions) {
    const Vec3 site = p + cloud.site.origin;
    if (is_finite(site)) box.extend({site[0], site[1], site[2] * factor});
  }
  return box;
}

Vec3 project_origin(const Box3& site_bounds) {
  if (site_bounds.empty()) return {0, 0, 0};
  for (int axis = 0; axis < 3; ++axis)
    if (!(farthest(site_bounds, axis) <= kFarthestCoordinate))
      throw Error("ingest", "the bounds of the site are not a place on Earth",
                  in_words(site_bounds.min) + " to " + in_words(site_bounds.max), "coordinates within 1e9 m");
  const auto rounded = [&](int axis) { return std::floor(site_bounds.min[axis] / kOriginStep) * kOriginStep; };
  Vec3 origin{0, 0, 0};
  if (farthest(site_bounds, 0) >= kNearZero || farthest(site_bounds, 1) >= kNearZero)
    origin = {rounded(0), rounded(1), 0};
  if (farthest(site_bounds, 2) >= kNearZero) origin[2] = rounded(2);
  return origin + Vec3{0, 0, 0};  // no negative zero
}

void localize(PointCloud& cloud, const Vec3& origin) {
  for (double c : origin)
    if (!(std::abs(c) <= kFarthestCoordinate) || c != std::floor(c))
      throw Error("ingest", "the project origin cannot be subtracted exactly", in_words(origin),
                  "whole metres within 1e9 m");
  const Vec3 shift = origin - cloud.site.origin;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 site = cloud.positions[i] + cloud.site.origin;
    for (double c : site)
      if (!(std::abs(c) <= kFarthestCoordinate))
        throw Error("ingest", "point " + std::to_string(i) + " is not a place on Earth", in_words(site),
                    "finite coordinates within 1e9 m");
  }
  for (Vec3& p : cloud.positions) p = p - shift;
  cloud.site.origin = origin;
}

void heights_to_metres(PointCloud& cloud, HeightUnit unit, const std::string& source) {
  const CrsFacts facts = read_crs(cloud.site.crs);
  if (unit == HeightUnit::metre) {
    if (facts.vertical_unit > 0 && !is_metre(facts.vertical_unit))
      throw Error("ingest", source + " states heights in units of " + shortest(facts.vertical_unit) + " m",
                  "height_unit = \"m\"", "height_unit = \"ft\" (0.3048 m) or \"us-ft\" (1200/3937 m)");
    return;
  }
  const double factor = metres_in(unit);
  const double base = cloud.site.origin[2];
  for (Vec3& p : cloud.positions) p[2] = (p[2] + base) * factor - base;
  cloud.site.crs = metric_crs(cloud.site.crs);
}

void require_projected_metres(const PointCloud& cloud, const std::string& file) {
  const char* allowed = "projected coordinates in metres, z up (reproject the file, for instance to UTM)";
  const CrsFacts facts = read_crs(cloud.site.crs);
  const std::string crs = in_short(cloud.site.crs);
  if (facts.kind == CrsKind::geographic)
    throw Error("ingest", file + " has geographic coordinates (degrees)", crs, allowed);
  if (facts.kind == CrsKind::geocentric)
    throw Error("ingest", file + " has geocentric coordinates, whose z is not up", crs, allowed);
  if (facts.horizontal_unit > 0 && !is_metre(facts.horizontal_unit))
    throw Error("ingest", file + " has horizontal coordinates in units of " + shortest(facts.horizontal_unit) + " m",
                crs, allowed);
  const bool silent = cloud.site.crs.empty() || facts.epsg > 0;  // a code says nothing of its unit
  if (facts.kind != CrsKind::unknown || !silent) return;
  const Box3 box = site_bounds(cloud);
  if (looks_like_degrees(box))
    throw Error("ingest", file + " looks like degrees", "bounds " + in_words(box.min) + " to " + in_words(box.max),
                allowed);
}

void require_same_crs(const std::vector<std::string>& names, const std::vector<std::string>& crs) {
  std::size_t first = crs.size();
  for (std::size_t i = 0; i < crs.size(); ++i) {
    if (crs[i].empty()) continue;
    if (first == crs.size()) first = i;
    if (!same_crs(metric_crs(crs[first]), metric_crs(crs[i])))
      throw Error("ingest", names.at(i) + " has another coordinate reference system than " + names.at(first),
                  in_short(crs[i]), in_short(crs[first]));
  }
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/site.hpp"

namespace scarp {

/// A named value per point, e.g. "distance" in m. NaN means "no data".
struct PointScalar {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

/// Points of a scan with whatever the file said about them.
///
/// `positions` are metres minus `site.origin`; straight from a reader the origin is zero. Every attribute
/// vector is either empty (the file did not have it) or has one entry per point.
struct PointCloud {
  std::vector<Vec3> positions;
  std::vector<Rgb16> colour;  ///< 16 bits per channel; 8-bit sources are multiplied by 257
  std::vector<std::uint16_t> intensity;
  std::vector<std::uint8_t> classification;  ///< ASPRS codes
  std::vector<std::uint8_t> return_number;
  std::vector<std::uint8_t> number_of_returns;
  std::vector<double> gps_time;
  std::vector<Vec3> normals;  ///< unit vectors
  std::vector<PointScalar> scalars;
  SiteFrame site;

  std::size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
};

/// The scalar of that name, or null.
inline const PointScalar* find_scalar(const PointCloud& cloud, std::string_view name) {
  const auto found =
      std::find_if(cloud.scalars.begin(), cloud.scalars.end(), [&](const PointScalar& s) { return s.name == name; });
  return found == cloud.scalars.end() ? nullptr : &*found;
}

/// THE attribute list: calls f(vector) for every per-point vector, scalars included. Copying, selecting and
/// appending go through here, so that a new attribute is added in one place.
template <class Cloud, class F>
void for_each_attribute(Cloud& cloud, F&& f) {
  f(cloud.positions);
  f(cloud.colour);
  f(cloud.intensity);
  f(cloud.classification);
  f(cloud.return_number);
  f(cloud.number_of_returns);
  f(cloud.gps_time);
  f(cloud.normals);
  for (auto& scalar : cloud.scalars) f(scalar.values);
}

/// Keeps the points at `indices` (0-based, in this order), with all their attributes.
inline void select_points(PointCloud& cloud, const std::vector<std::size_t>& indices) {
  for_each_attribute(cloud, [&](auto& values) {
    if (values.empty()) return;
    std::remove_reference_t<decltype(values)> kept;
    kept.reserve(indices.size());
    for (std::size_t i : indices) kept.push_back(values[i]);
    values = std::move(kept);
  });
}

inline Box3 bounds(const std::vector<Vec3>& positions) {
  Box3 box;
  for (const Vec3& p : positions) box.extend(p);
  return box;
}

}  // namespace scarp

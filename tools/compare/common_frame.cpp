// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare/common_frame.hpp"

#include <algorithm>
#include <iterator>

#include "solver/model/error.hpp"

namespace scarp {

Vec3 common_origin(const SiteFrame& a, const SiteFrame& b) {
  return norm(a.origin) >= norm(b.origin) ? a.origin : b.origin;
}

std::vector<Vec3> moved(std::vector<Vec3> positions, const Vec3& from, const Vec3& origin) {
  const Vec3 shift = from - origin;
  if (shift != Vec3{0, 0, 0})
    for (Vec3& p : positions) p = p + shift;
  return positions;
}

void require_points(const PointCloud& cloud, const std::string& which) {
  if (cloud.empty()) throw Error("compare", "the " + which + " cloud is empty", "0 points", "at least 1");
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (!is_finite(cloud.positions[i]))
      throw Error("compare", "point " + std::to_string(i) + " of the " + which + " cloud is not finite");
}

void put_first(PointCloud& cloud, std::vector<PointScalar> scalars) {
  std::erase_if(cloud.scalars, [&](const PointScalar& old) {
    return std::any_of(scalars.begin(), scalars.end(), [&](const PointScalar& s) { return s.name == old.name; });
  });
  cloud.scalars.insert(cloud.scalars.begin(), std::make_move_iterator(scalars.begin()),
                       std::make_move_iterator(scalars.end()));
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "discretize/axis.hpp"
#include "solver/model/math.hpp"

namespace scarp {

namespace raster_detail {

/// Where the edge p-q meets the line y: (x, z). The ends are put in one order first, so that the two triangles of
/// an edge get the same bits.
inline Vec2 cross_row(const Vec3& p, const Vec3& q, double y) {
  const bool swap = p[1] > q[1] || (p[1] == q[1] && p[0] > q[0]);
  const Vec3& a = swap ? q : p;
  const Vec3& b = swap ? p : q;
  const double t = (y - a[1]) / (b[1] - a[1]);
  return {a[0] + t * (b[0] - a[0]), a[2] + t * (b[2] - a[2])};
}

}  // namespace raster_detail

/// Vertical lines through the samples (x, y) meet a triangle: calls hit(i, j, z) for each that does, for rows j in
/// [row_begin, row_end).
///
/// A triangle owns its lower and left border, not its upper and right one (in plan), and neighbours see the same
/// bits at a shared edge. So a line through a closed mesh is hit an even number of times, whatever vertex or edge
/// it runs through; a line through a TIN misses no seam. z is interpolated along the row between the two
/// edges, which keeps it between the corners' heights for the thinnest sliver.
template <class F>
void raster_triangle(const std::array<Vec3, 3>& corner, const Axis& x, const Axis& y, std::int32_t row_begin,
                     std::int32_t row_end, F&& hit) {
  const double low = std::min({corner[0][1], corner[1][1], corner[2][1]});
  const double high = std::max({corner[0][1], corner[1][1], corner[2][1]});
  const std::int32_t begin = std::max(row_begin, y.first_at_or_above(low));
  for (std::int32_t j = begin; j < row_end; ++j) {
    const double row = y.at(j);
    if (row >= high) break;
    Vec2 met[2];
    int count = 0;
    for (int e = 0; e < 3; ++e) {
      const Vec3& p = corner[e];
      const Vec3& q = corner[(e + 1) % 3];
      if ((p[1] <= row) != (q[1] <= row) && count < 2) met[count++] = raster_detail::cross_row(p, q, row);
    }
    if (count < 2) continue;
    if (met[0][0] > met[1][0]) std::swap(met[0], met[1]);
    const double width = met[1][0] - met[0][0];
    const std::int32_t last = x.first_at_or_above(met[1][0]);
    for (std::int32_t i = x.first_at_or_above(met[0][0]); i < last; ++i)
      hit(i, j, met[0][1] + (x.at(i) - met[0][0]) / width * (met[1][1] - met[0][1]));
  }
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace scarp {

/// Evenly spaced sample positions along one axis: the nodes of a row of cells, or the centres of its sub-cells.
///
/// Every position in the room comes from `at`, and every question "which samples lie beyond v" is settled by
/// comparing with `at`, so that counting, filling and seeding can never disagree by a rounding.
struct Axis {
  double origin = 0;  ///< coordinate of the first node, m
  double cell = 0;    ///< m
  int per_cell = 1;   ///< samples in a cell
  bool centred = false;
  std::int32_t count = 0;

  static Axis nodes(double origin, double cell, std::int32_t cells) { return {origin, cell, 1, false, cells + 1}; }
  static Axis centres(double origin, double cell, std::int32_t cells, int per_cell) {
    return {origin, cell, per_cell, true, cells * per_cell};
  }
  /// One sample at zero: the flat axis of plane strain.
  static Axis flat() { return {0, 0, 1, false, 1}; }

  double step() const { return cell / per_cell; }

  double at(std::int64_t i) const {
    return origin + static_cast<double>(2 * i + (centred ? 1 : 0)) * cell / (2.0 * per_cell);
  }

  /// Smallest index in [0, count] whose position is >= v; so samples in [lower, upper) are
  /// [first_at_or_above(lower), first_at_or_above(upper)), and intervals that share an end share no sample.
  std::int32_t first_at_or_above(double v) const {
    const double guess = (v - origin) * per_cell / cell - (centred ? 0.5 : 0.0);
    if (!(guess > -1)) return at(0) >= v ? 0 : std::min<std::int32_t>(1, count);
    if (guess > count) return count;
    auto i = std::clamp<std::int32_t>(static_cast<std::int32_t>(std::ceil(guess)), 0, count);
    while (i > 0 && at(i - 1) >= v) --i;
    while (i < count && at(i) < v) ++i;
    return i;
  }

  /// Index of the sample nearest to v, within [0, count).
  std::int32_t nearest(double v) const {
    if (count <= 1) return 0;
    const double guess = (v - origin) * per_cell / cell - (centred ? 0.5 : 0.0);
    return static_cast<std::int32_t>(std::clamp(std::round(guess), 0.0, count - 1.0));
  }
};

}  // namespace scarp

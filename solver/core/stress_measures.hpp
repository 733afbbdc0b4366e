// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "solver/model/math.hpp"

namespace scarp {

inline double mean_stress(const Sym6& s) { return (s[0] + s[1] + s[2]) / 3; }

/// sqrt(3/2 s:s) with s the deviator.
inline double von_mises_stress(const Sym6& s) {
  const double x = s[0] - s[1], y = s[1] - s[2], z = s[2] - s[0];
  return std::sqrt(0.5 * (x * x + y * y + z * z) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

}  // namespace scarp

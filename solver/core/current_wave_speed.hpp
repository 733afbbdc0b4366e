// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/materials/law.hpp"

namespace scarp {

/// Upper bound of lambda_max^2, the largest eigenvalue of C = F^T F (Laguerre-Samuelson, as in motion.hpp).
inline double square_of_largest_stretch(const Motion& motion) {
  const double trace = square_norm(motion.F);
  return (trace + 2 * std::sqrt(std::max(0.0, trace * trace - 3 * square_norm(motion.cofactor)))) * (1.0 / 3);
}

/// A lower triangular F with F F^T = b.
inline Mat3 triangular_root(const Sym6& b) {
  const double xx = std::sqrt(b[0]), yx = b[3] / xx, zx = b[5] / xx;
  const double yy = std::sqrt(b[1] - yx * yx), zy = (b[4] - zx * yx) / yy;
  return {xx, 0, 0, yx, yy, 0, zx, zy, std::sqrt(b[2] - zx * zx - zy * zy)};
}

/// Upper bound of c^2, (m/s)^2, in the current configuration, from the law's in the reference configuration. A wave
/// (m x n) exp(i k n.x) has the reference wave vector k F^T n, and the factors J of volume and density cancel:
/// c_current(m, n)^2 = |F^T n|^2 c_reference(m, N)^2 <= lambda_max^2 c_reference^2.
///
/// Isotropic laws with a history know their elastic state by b_e alone. Their reference may be the unloaded state of
/// the material as it lies now, any F_e with F_e F_e^T = b_e: the bound then does not grow with plastic flow.
/// A law for which both bounds are poor (a fluid, which flows but has no b_e) may state its own,
/// current_wave_speed_squared(motion, history).
template <class Law>
double current_wave_speed_squared(const Law& law, const Motion& motion, const PointHistory& history) {
  if constexpr (requires { law.current_wave_speed_squared(motion, history); }) {
    return law.current_wave_speed_squared(motion, history);
  } else if constexpr (Law::has_history) {
    const Mat3 F_e = triangular_root(history.elastic_left_cauchy_green);
    const Motion elastic = make_motion(F_e, F_e);
    return square_of_largest_stretch(elastic) * law.wave_speed_squared(elastic, history);
  } else {
    return square_of_largest_stretch(motion) * law.wave_speed_squared(motion, history);
  }
}

}  // namespace scarp

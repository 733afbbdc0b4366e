// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The volumetric part of deformation and stress in D dimensions: plane strain (D = 2) averages in its plane only.
#pragma once

#include <cmath>

#include "solver/model/math.hpp"

namespace scarp {

/// The stretch in D directions that changes the volume by `ratio`.
template <int D>
double dilation(double ratio) {
  return D == 2 ? std::sqrt(ratio) : std::cbrt(ratio);
}

/// F with its D x D part scaled.
template <int D>
Mat3 dilated(const Mat3& F, double scale) {
  Mat3 scaled = F;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) scaled[3 * i + j] *= scale;
  return scaled;
}

/// Mean of the D normal components.
template <int D>
double mean_stress(const Sym6& sigma) {
  return D == 2 ? 0.5 * (sigma[0] + sigma[1]) : (sigma[0] + sigma[1] + sigma[2]) * (1.0 / 3);
}

/// The same stress with another mean.
template <int D>
Sym6 with_mean_stress(const Sym6& sigma, double mean) {
  const double change = mean - mean_stress<D>(sigma);
  Sym6 s = sigma;
  for (int i = 0; i < D; ++i) s[i] += change;
  return s;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/materials/motion.hpp"

namespace scarp {

/// Mean rate of deformation of a step, deviatoric, 1/s: D = ln(f f^T) / (2 dt) with f = F F_old^-1, by the Pade
/// approximant ln B = 2 (B - I) (B + I)^-1, whose error is of third order in the step's strain. A rotation gives
/// nothing, and f -> Q f gives Q D Q^T, exactly and at any angle.
inline Sym6 deviatoric_rate(const Motion& motion) {
  const Mat3 c = cofactor(motion.F_old);
  const double per_J = 1 / determinant(motion.F_old, c);
  Mat3 g;  // f - I: the difference first, so that small steps keep their digits
  for (int i = 0; i < 9; ++i) g[i] = motion.F[i] - motion.F_old[i];
  g = multiply_transposed(g, c);
  for (double& entry : g) entry *= per_J;
  const Mat3 square = multiply_transposed(g, g);
  Mat3 H, S;  // B - I and B + I, which commute
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      H[3 * i + j] = g[3 * i + j] + g[3 * j + i] + square[3 * i + j];
      S[3 * i + j] = H[3 * i + j] + (i == j ? 2 : 0);
    }
  const Mat3 cofactor_of_S = cofactor(S);
  const double scale = motion.per_dt * (1 / determinant(S, cofactor_of_S));
  const Mat3 D = multiply_transposed(H, cofactor_of_S);
  const double mean = (D[0] + D[4] + D[8]) / 3;
  return {scale * (D[0] - mean), scale * (D[4] - mean), scale * (D[8] - mean),
          scale * D[1],          scale * D[5],          scale * D[2]};
}

}  // namespace scarp

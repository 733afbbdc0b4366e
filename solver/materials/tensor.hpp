// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The few operations on Mat3 (row-major) and Sym6 (xx, yy, zz, xy, yz, xz) that laws and sweeps share.
#pragma once

#include <cmath>

#include "solver/model/math.hpp"

namespace scarp {

/// cof F = det(F) F^-T.
inline Mat3 cofactor(const Mat3& F) {
  return {F[4] * F[8] - F[5] * F[7], F[5] * F[6] - F[3] * F[8], F[3] * F[7] - F[4] * F[6],
          F[2] * F[7] - F[1] * F[8], F[0] * F[8] - F[2] * F[6], F[1] * F[6] - F[0] * F[7],
          F[1] * F[5] - F[2] * F[4], F[2] * F[3] - F[0] * F[5], F[0] * F[4] - F[1] * F[3]};
}

/// det F, given cof F.
inline double determinant(const Mat3& F, const Mat3& cofactor_of_F) {
  return F[0] * cofactor_of_F[0] + F[1] * cofactor_of_F[1] + F[2] * cofactor_of_F[2];
}
inline double determinant(const Mat3& F) { return determinant(F, cofactor(F)); }

/// A B.
inline Mat3 multiply(const Mat3& A, const Mat3& B) {
  Mat3 C;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
  return C;
}

/// A B^T.
inline Mat3 multiply_transposed(const Mat3& A, const Mat3& B) {
  Mat3 C;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j)
      C[3 * i + j] = A[3 * i] * B[3 * j] + A[3 * i + 1] * B[3 * j + 1] + A[3 * i + 2] * B[3 * j + 2];
  return C;
}

inline Mat3 transpose(const Mat3& A) { return {A[0], A[3], A[6], A[1], A[4], A[7], A[2], A[5], A[8]}; }

/// Sum of the squares of all entries.
inline double square_norm(const Mat3& A) {
  return (A[0] * A[0] + A[1] * A[1] + A[2] * A[2]) + (A[3] * A[3] + A[4] * A[4] + A[5] * A[5]) +
         (A[6] * A[6] + A[7] * A[7] + A[8] * A[8]);
}

/// F F^T.
inline Sym6 left_product(const Mat3& F) {
  return {F[0] * F[0] + F[1] * F[1] + F[2] * F[2], F[3] * F[3] + F[4] * F[4] + F[5] * F[5],
          F[6] * F[6] + F[7] * F[7] + F[8] * F[8], F[0] * F[3] + F[1] * F[4] + F[2] * F[5],
          F[3] * F[6] + F[4] * F[7] + F[5] * F[8], F[0] * F[6] + F[1] * F[7] + F[2] * F[8]};
}

/// F s F^T.
inline Sym6 push_forward(const Mat3& F, const Sym6& s) {
  const Mat3 A = multiply(F, {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]});
  return {A[0] * F[0] + A[1] * F[1] + A[2] * F[2], A[3] * F[3] + A[4] * F[4] + A[5] * F[5],
          A[6] * F[6] + A[7] * F[7] + A[8] * F[8], A[0] * F[3] + A[1] * F[4] + A[2] * F[5],
          A[3] * F[6] + A[4] * F[7] + A[5] * F[8], A[0] * F[6] + A[1] * F[7] + A[2] * F[8]};
}

/// First Piola-Kirchhoff stress P = J sigma F^-T = sigma cof(F).
inline Mat3 first_piola(const Sym6& s, const Mat3& c) {
  return {s[0] * c[0] + s[3] * c[3] + s[5] * c[6], s[0] * c[1] + s[3] * c[4] + s[5] * c[7],
          s[0] * c[2] + s[3] * c[5] + s[5] * c[8], s[3] * c[0] + s[1] * c[3] + s[4] * c[6],
          s[3] * c[1] + s[1] * c[4] + s[4] * c[7], s[3] * c[2] + s[1] * c[5] + s[4] * c[8],
          s[5] * c[0] + s[4] * c[3] + s[2] * c[6], s[5] * c[1] + s[4] * c[4] + s[2] * c[7],
          s[5] * c[2] + s[4] * c[5] + s[2] * c[8]};
}

/// The rotation R of the polar decomposition F = R U, for det F > 0: Newton iteration X <- (X + X^-T) / 2
/// (Higham 1986). Quadratic, so that a change below 1e-8 leaves an error below 1e-16.
inline Mat3 polar_rotation(const Mat3& F) {
  Mat3 R = F;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Mat3 c = cofactor(R);
    const double half_inverse = 0.5 / determinant(R, c);
    double change = 0;
#pragma GCC unroll 9
    for (int i = 0; i < 9; ++i) {
      const double next = 0.5 * R[i] + half_inverse * c[i];
      change += (next - R[i]) * (next - R[i]);
      R[i] = next;
    }
    if (change <= 1e-16) break;
  }
  return R;
}

}  // namespace scarp

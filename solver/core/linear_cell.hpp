// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/math.hpp"

namespace scarp {

/// Linear shape functions on a cell, D = 2 (4 corners) or 3 (8). Corner k stands at (bit 0, bit 1, bit 2 of k);
/// xi in [0, 1]^D is the place in the cell.
///
/// A field is taken in its monomials: u(xi) = sum_k a_k m_k(xi), where m_k is the product of the coordinates
/// whose bits are set in k, and a = S u with the corner values u (method.md 1.1: phi_I = sum_k S_kI m_k). The
/// change is made once per cell; then a value costs 2^D - 1 products and a gradient D 2^(D-1), instead of as many
/// per corner. P2G is the exact transpose: sums of w m_k per particle, S^T once per cell.
template <int D>
struct LinearCell {
  static constexpr int N = 1 << D;
  using Values = double[N];

  static void monomials(const Vec3& xi, Values& m) {
    m[0] = 1;
#pragma GCC unroll 3
    for (int axis = 0; axis < D; ++axis)
#pragma GCC unroll 4
      for (int k = 0; k < (1 << axis); ++k) m[k | (1 << axis)] = k ? m[k] * xi[axis] : xi[axis];
  }

  /// a = S u, in place.
  static void to_monomials(Values& u) {
#pragma GCC unroll 3
    for (int bit = 1; bit < N; bit *= 2)
#pragma GCC unroll 8
      for (int k = 0; k < N; ++k)
        if (k & bit) u[k] -= u[k ^ bit];
  }

  /// S^T, in place: from sums over monomials to sums over corners.
  static void to_corners(Values& sums) {
#pragma GCC unroll 3
    for (int bit = 1; bit < N; bit *= 2)
#pragma GCC unroll 8
      for (int k = 0; k < N; ++k)
        if (k & bit) sums[k ^ bit] -= sums[k];
  }

  static double value(const Values& a, const Values& m) {
    double sum = a[0];
#pragma GCC unroll 8
    for (int k = 1; k < N; ++k) sum += a[k] * m[k];
    return sum;
  }

  /// d u / d xi_axis.
  template <int axis>
  static double derivative(const Values& a, const Values& m) {
    double sum = a[1 << axis];
#pragma GCC unroll 8
    for (int k = 0; k < N; ++k)
      if ((k & (1 << axis)) && k != (1 << axis)) sum += a[k] * m[k ^ (1 << axis)];
    return sum;
  }

  /// Adds w phi_I, as monomial sums.
  static void add_value(Values& sums, const Values& m, double w) {
    sums[0] += w;
#pragma GCC unroll 8
    for (int k = 1; k < N; ++k) sums[k] += w * m[k];
  }

  /// Adds w d phi_I / d xi_axis, as monomial sums.
  template <int axis>
  static void add_derivative(Values& sums, const Values& m, double w) {
    sums[1 << axis] += w;
#pragma GCC unroll 8
    for (int k = 0; k < N; ++k)
      if ((k & (1 << axis)) && k != (1 << axis)) sums[k] += w * m[k ^ (1 << axis)];
  }
};

}  // namespace scarp

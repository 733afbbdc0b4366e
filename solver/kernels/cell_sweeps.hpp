// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear cells of D dimensions, a pack of neighbouring cells at once. Corner k stands at (bit 0, bit 1, bit 2 of k).
// Regular cells have their points at a quarter and three quarters: the weights are constants, derivatives do not
// depend on the place along their own axis, and sums over corners are taken axis by axis (sum factorisation). In cut
// cells points stand anywhere, and fields are taken in their monomials, see solver/core/linear_cell.hpp.
#pragma once

#include "solver/kernels/nodal.hpp"
#include "solver/kernels/pack.hpp"

namespace SCARP_KERNELS {
namespace {

template <int D>
constexpr int kCorners = 1 << D;
template <int D>
constexpr int kRows = 1 << (D - 1);

/// One component of a nodal field at the corners of the cells whose first nodes are `lane` after the rows' beginnings.
template <int D>
SCARP_INLINE void gather(const double* field, const scarp::kernels::Segment& segment, int lane,
                         Pack (&u)[kCorners<D>]) {
#pragma GCC unroll 4
  for (int row = 0; row < kRows<D>; ++row) {
    const double* p = field + segment.read[row] + lane;
    u[2 * row] = load(p);
    u[2 * row + 1] = load(p + 1);
  }
}

/// Adds what cells give to their corners to the rows of nodes: a node gets from the cells on its left and on its right
/// in one addition, for which the right corners' share of the last cell is carried along. Twice the memory traffic
/// would be the least loss: loads that overlap a store just made stall.
template <int D>
class RowSums {
 public:
  SCARP_INLINE explicit RowSums(double* const (&sum)[3]) {
    for (int c = 0; c < D; ++c) sum_[c] = sum[c];
  }

  SCARP_INLINE void begin(const scarp::kernels::Segment& segment) {
    if (!segment.follows) flush();
    for (int row = 0; row < kRows<D>; ++row) at_[row] = segment.add[row];
    pending_ = true;
  }

  SCARP_INLINE void give(int c, int lane, const Pack (&corners)[kCorners<D>]) {
#pragma GCC unroll 4
    for (int row = 0; row < kRows<D>; ++row) {
      add(sum_[c] + at_[row] + lane, corners[2 * row] + shift_in(carry_[c][row], corners[2 * row + 1]));
      carry_[c][row] = corners[2 * row + 1];
    }
  }

  /// What is still carried goes to the node after the last segment.
  void flush() {
    if (!pending_) return;
    for (int c = 0; c < D; ++c)
      for (int row = 0; row < kRows<D>; ++row) {
        sum_[c][at_[row] + scarp::kernels::kSegment] += carry_[c][row][kLanes - 1];
        carry_[c][row] = Pack{};
      }
    pending_ = false;
  }

 private:
  double* sum_[D];
  std::uint32_t at_[kRows<D>] = {};
  Pack carry_[D][kRows<D>] = {};
  bool pending_ = false;
};

/// 4/3 of the values at a quarter and at three quarters of the way from a to b, in place; it is its own transpose.
/// The factor is made good once for all, see kRegularFactor.
SCARP_INLINE void quarters(Pack& a, Pack& b) {
  const Pack first = a + (1.0 / 3) * b;
  b += (1.0 / 3) * a;
  a = first;
}

/// Of what `quarters` leaves out of a derivative, once for each axis across.
template <int D>
constexpr double kRegularFactor = D == 2 ? 3.0 / 4 : 9.0 / 16;

template <int D>
constexpr int kHalf = 1 << (D - 1);

/// Derivatives along each axis at the points of regular cells, from corner values times kRegularFactor / cell:
/// [axis][place across].
template <int D>
SCARP_INLINE void regular_gradient(const Pack (&u)[kCorners<D>], Pack (&g)[D][kHalf<D>]) {
  if constexpr (D == 2) {
    for (int j = 0; j < 2; ++j) {
      g[0][j] = u[1 + 2 * j] - u[2 * j];
      g[1][j] = u[j + 2] - u[j];
    }
    for (int axis = 0; axis < 2; ++axis) quarters(g[axis][0], g[axis][1]);
  } else {
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < 2; ++j) {
        g[0][j + 2 * k] = u[1 + 2 * j + 4 * k] - u[2 * j + 4 * k];
        g[1][j + 2 * k] = u[j + 2 + 4 * k] - u[j + 4 * k];
        g[2][j + 2 * k] = u[j + 2 * k + 4] - u[j + 2 * k];
      }
    for (int axis = 0; axis < 3; ++axis) {
      quarters(g[axis][0], g[axis][1]);
      quarters(g[axis][2], g[axis][3]);
      quarters(g[axis][0], g[axis][2]);
      quarters(g[axis][1], g[axis][3]);
    }
  }
}

/// The transpose: sums over points of w d phi / d xi over kRegularFactor, into `u`; `g` is used up.
template <int D>
SCARP_INLINE void regular_divergence(Pack (&g)[D][kHalf<D>], Pack (&u)[kCorners<D>]) {
  if constexpr (D == 2) {
    for (int axis = 0; axis < 2; ++axis) quarters(g[axis][0], g[axis][1]);
    u[0] = -g[0][0] - g[1][0];
    u[1] = g[0][0] - g[1][1];
    u[2] = g[1][0] - g[0][1];
    u[3] = g[0][1] + g[1][1];
  } else {
    for (int axis = 0; axis < 3; ++axis) {
      quarters(g[axis][0], g[axis][1]);
      quarters(g[axis][2], g[axis][3]);
      quarters(g[axis][0], g[axis][2]);
      quarters(g[axis][1], g[axis][3]);
    }
#pragma GCC unroll 8
    for (int k = 0; k < 8; ++k) {
      const int i = k & 1, j = k >> 1 & 1, l = k >> 2;
      Pack t = i ? g[0][j + 2 * l] : -g[0][j + 2 * l];
      t = j ? t + g[1][i + 2 * l] : t - g[1][i + 2 * l];
      u[k] = l ? t + g[2][i + 2 * j] : t - g[2][i + 2 * j];
    }
  }
}

/// Where a point of a regular cell finds its derivative along `axis`.
template <int D>
constexpr int across(int axis, int point) {
  const int x = point & 1, y = point >> 1 & 1, z = point >> 2;
  if (D == 2) return axis == 0 ? y : x;
  return axis == 0 ? y + 2 * z : axis == 1 ? x + 2 * z : x + 2 * y;
}

/// sum_J M_IJ u_J over kRegularMass times the points' mass, for regular cells: [1 3/5; 3/5 1] axis by axis.
template <int D>
SCARP_INLINE void regular_mass(Pack (&u)[kCorners<D>]) {
#pragma GCC unroll 3
  for (int bit = 1; bit < kCorners<D>; bit *= 2)
#pragma GCC unroll 8
    for (int k = 0; k < kCorners<D>; ++k) {
      if (k & bit) continue;
      const Pack a = u[k], b = u[k | bit];
      u[k] = a + 0.6 * b;
      u[k | bit] = b + 0.6 * a;
    }
}
template <int D>
constexpr double kRegularMass = D == 2 ? 25.0 / 64 : 125.0 / 512;

template <int D>
SCARP_INLINE void to_monomials(Pack (&u)[kCorners<D>]) {
#pragma GCC unroll 3
  for (int bit = 1; bit < kCorners<D>; bit *= 2)
#pragma GCC unroll 8
    for (int k = 0; k < kCorners<D>; ++k)
      if (k & bit) u[k] -= u[k ^ bit];
}

template <int D>
SCARP_INLINE void to_corners(Pack (&u)[kCorners<D>]) {
#pragma GCC unroll 3
  for (int bit = 1; bit < kCorners<D>; bit *= 2)
#pragma GCC unroll 8
    for (int k = 0; k < kCorners<D>; ++k)
      if (k & bit) u[k ^ bit] -= u[k];
}

/// The monomials at a point of a cut cell: 1, x, y, xy, z, xz, yz, xyz.
template <int D>
SCARP_INLINE void monomials(const double* xi, Pack (&m)[kCorners<D>]) {
  using scarp::kernels::kSegment;
  m[0] = all(1.0);
  m[1] = load(xi);
  m[2] = load(xi + kSegment);
  m[3] = m[1] * m[2];
  if constexpr (D == 3) {
    m[4] = load(xi + 2 * kSegment);
    m[5] = m[1] * m[4];
    m[6] = m[2] * m[4];
    m[7] = m[3] * m[4];
  }
}

template <int D>
SCARP_INLINE Pack value(const Pack (&a)[kCorners<D>], const Pack (&m)[kCorners<D>]) {
  Pack sum = a[0];
#pragma GCC unroll 8
  for (int k = 1; k < kCorners<D>; ++k) sum += a[k] * m[k];
  return sum;
}

/// Derivative along an axis of the field with the monomial coefficients a.
template <int D>
SCARP_INLINE Pack derivative(const Pack (&a)[kCorners<D>], const Pack (&m)[kCorners<D>], int axis) {
  Pack sum = a[1 << axis];
#pragma GCC unroll 8
  for (int k = 0; k < kCorners<D>; ++k)
    if ((k & (1 << axis)) && k != (1 << axis)) sum += a[k] * m[k ^ (1 << axis)];
  return sum;
}

/// Adds w d phi / d xi_axis as sums over monomials.
template <int D>
SCARP_INLINE void add_derivative(Pack (&a)[kCorners<D>], const Pack (&m)[kCorners<D>], int axis, Pack w) {
  a[1 << axis] += w;
#pragma GCC unroll 8
  for (int k = 0; k < kCorners<D>; ++k)
    if ((k & (1 << axis)) && k != (1 << axis)) a[k] += w * m[k ^ (1 << axis)];
}

}  // namespace
}  // namespace SCARP_KERNELS

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lanes that are particles: their fields into packs and back, and sums over them.
#pragma once

#include "solver/kernels/pack.hpp"

namespace SCARP_KERNELS {
namespace {

/// The particles of a pack. Lanes beyond `count` repeat the last one; they count for nothing and are never stored.
struct Lanes {
  const std::uint32_t* particle;
  int count;
  std::uint32_t repeated[kLanes];

  explicit SCARP_INLINE Lanes(const std::uint32_t* members, int left) : particle(members), count(left) {
    if (left >= kLanes) {
      count = kLanes;
      return;
    }
    for (int l = 0; l < kLanes; ++l) repeated[l] = members[l < count ? l : count - 1];
    particle = repeated;
  }
  Lanes(const Lanes&) = delete;

  SCARP_INLINE bool full() const { return count == kLanes; }
  /// Of particles that stand in rising order.
  SCARP_INLINE bool side_by_side() const { return full() && particle[kLanes - 1] - particle[0] == kLanes - 1; }
  SCARP_INLINE Mask valid() const {
#if SCARP_LANES == 8
    return Mask{0, 1, 2, 3, 4, 5, 6, 7} < static_cast<long long>(count);
#elif SCARP_LANES == 4
    return Mask{0, 1, 2, 3} < static_cast<long long>(count);
#else
    return Mask{0, 1} < static_cast<long long>(count);
#endif
  }
};

/// base[stride * particle[l]] in lane l.
SCARP_INLINE Pack gather_lanes(const double* base, int stride, const Lanes& lanes) {
  const auto at = [&](int l) __attribute__((always_inline)) {
    return base[static_cast<std::size_t>(lanes.particle[l]) * stride];
  };
#if SCARP_LANES == 8
  return Pack{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
#elif SCARP_LANES == 4
  return Pack{at(0), at(1), at(2), at(3)};
#else
  return Pack{at(0), at(1)};
#endif
}

SCARP_INLINE void scatter_lanes(double* base, int stride, const Lanes& lanes, Pack a) {
  if (lanes.full()) {
#pragma GCC unroll 8
    for (int l = 0; l < kLanes; ++l) base[static_cast<std::size_t>(lanes.particle[l]) * stride] = a[l];
  } else {
    for (int l = 0; l < lanes.count; ++l) base[static_cast<std::size_t>(lanes.particle[l]) * stride] = a[l];
  }
}

/// Rows to columns.
SCARP_INLINE void transpose(Pack (&a)[kLanes]) {
#if SCARP_LANES == 8
  Pack b[8], c[8];
#pragma GCC unroll 4
  for (int i = 0; i < 8; i += 2) {
    b[i] = __builtin_shuffle(a[i], a[i + 1], Mask{0, 8, 2, 10, 4, 12, 6, 14});
    b[i + 1] = __builtin_shuffle(a[i], a[i + 1], Mask{1, 9, 3, 11, 5, 13, 7, 15});
  }
#pragma GCC unroll 2
  for (int i = 0; i < 8; i += 4)
#pragma GCC unroll 2
    for (int j = 0; j < 2; ++j) {
      c[i + j] = __builtin_shuffle(b[i + j], b[i + j + 2], Mask{0, 1, 8, 9, 4, 5, 12, 13});
      c[i + j + 2] = __builtin_shuffle(b[i + j], b[i + j + 2], Mask{2, 3, 10, 11, 6, 7, 14, 15});
    }
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) {
    a[i] = __builtin_shuffle(c[i], c[i + 4], Mask{0, 1, 2, 3, 8, 9, 10, 11});
    a[i + 4] = __builtin_shuffle(c[i], c[i + 4], Mask{4, 5, 6, 7, 12, 13, 14, 15});
  }
#elif SCARP_LANES == 4
  Pack b[4];
#pragma GCC unroll 2
  for (int i = 0; i < 4; i += 2) {
    b[i] = __builtin_shuffle(a[i], a[i + 1], Mask{0, 4, 2, 6});
    b[i + 1] = __builtin_shuffle(a[i], a[i + 1], Mask{1, 5, 3, 7});
  }
#pragma GCC unroll 2
  for (int i = 0; i < 2; ++i) {
    a[i] = __builtin_shuffle(b[i], b[i + 2], Mask{0, 1, 4, 5});
    a[i + 2] = __builtin_shuffle(b[i], b[i + 2], Mask{2, 3, 6, 7});
  }
#else
  const Pack low = __builtin_shuffle(a[0], a[1], Mask{0, 2}), high = __builtin_shuffle(a[0], a[1], Mask{1, 3});
  a[0] = low;
  a[1] = high;
#endif
}

/// Components [0, N) of a field of `stride` doubles per particle.
template <int N>
SCARP_INLINE void load_field(const double* base, int stride, const Lanes& lanes, Pack* out) {
  int i = 0;
  if constexpr (N >= kLanes && kLanes > 1) {
    for (; i + kLanes <= N; i += kLanes) {
      Pack rows[kLanes];
#pragma GCC unroll 8
      for (int l = 0; l < kLanes; ++l) rows[l] = load(base + static_cast<std::size_t>(lanes.particle[l]) * stride + i);
      transpose(rows);
#pragma GCC unroll 8
      for (int l = 0; l < kLanes; ++l) out[i + l] = rows[l];
    }
  }
#pragma GCC unroll 9
  for (; i < N; ++i) out[i] = gather_lanes(base + i, stride, lanes);
}

template <int N>
SCARP_INLINE void store_field(double* base, int stride, const Lanes& lanes, const Pack* a) {
  int i = 0;
  if constexpr (N >= kLanes && kLanes > 1) {
    for (; i + kLanes <= N; i += kLanes) {
      Pack rows[kLanes];
#pragma GCC unroll 8
      for (int l = 0; l < kLanes; ++l) rows[l] = a[i + l];
      transpose(rows);
#pragma GCC unroll 8
      for (int l = 0; l < kLanes; ++l)
        if (lanes.full() || l < lanes.count)
          store(base + static_cast<std::size_t>(lanes.particle[l]) * stride + i, rows[l]);
    }
  }
#pragma GCC unroll 9
  for (; i < N; ++i) scatter_lanes(base + i, stride, lanes, a[i]);
}

/// Sums over the lanes of each pack: that of a[i] in lane i.
SCARP_INLINE Pack sums_of(const Pack (&a)[kLanes]) {
#if SCARP_LANES == 8
  Pack b[4], c[2];
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i)
    b[i] = __builtin_shuffle(a[2 * i], a[2 * i + 1], Mask{0, 8, 2, 10, 4, 12, 6, 14}) +
           __builtin_shuffle(a[2 * i], a[2 * i + 1], Mask{1, 9, 3, 11, 5, 13, 7, 15});
#pragma GCC unroll 2
  for (int i = 0; i < 2; ++i)
    c[i] = __builtin_shuffle(b[2 * i], b[2 * i + 1], Mask{0, 1, 8, 9, 4, 5, 12, 13}) +
           __builtin_shuffle(b[2 * i], b[2 * i + 1], Mask{2, 3, 10, 11, 6, 7, 14, 15});
  return __builtin_shuffle(c[0], c[1], Mask{0, 1, 2, 3, 8, 9, 10, 11}) +
         __builtin_shuffle(c[0], c[1], Mask{4, 5, 6, 7, 12, 13, 14, 15});
#elif SCARP_LANES == 4
  Pack b[2];
#pragma GCC unroll 2
  for (int i = 0; i < 2; ++i)
    b[i] = __builtin_shuffle(a[2 * i], a[2 * i + 1], Mask{0, 4, 2, 6}) +
           __builtin_shuffle(a[2 * i], a[2 * i + 1], Mask{1, 5, 3, 7});
  return __builtin_shuffle(b[0], b[1], Mask{0, 1, 4, 5}) + __builtin_shuffle(b[0], b[1], Mask{2, 3, 6, 7});
#else
  return __builtin_shuffle(a[0], a[1], Mask{0, 2}) + __builtin_shuffle(a[0], a[1], Mask{1, 3});
#endif
}

/// Adds the sums over the lanes of N packs to N doubles from `at` on, a multiple of the lanes.
template <int N>
SCARP_INLINE void add_sums(double* at, const Pack (&a)[N]) {
  static_assert(N % kLanes == 0);
#pragma GCC unroll 8
  for (int i = 0; i < N; i += kLanes) {
    Pack group[kLanes];
#pragma GCC unroll 8
    for (int l = 0; l < kLanes; ++l) group[l] = a[i + l];
    add(at + i, sums_of(group));
  }
}

}  // namespace
}  // namespace SCARP_KERNELS

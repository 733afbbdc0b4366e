// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lanes that are particles side by side in memory, as those of a cell are until they mix: their fields into packs and
// back by whole loads and stores; and those of other lanes.
#pragma once

#include "solver/kernels/lanes.hpp"
#include "solver/kernels/particles.hpp"

namespace SCARP_KERNELS {
namespace {

/// x, y, z of kLanes particles from a, b, c as they stand in memory: x0 y0 z0 x1 ...
SCARP_INLINE void part_triples(Pack a, Pack b, Pack c, Pack (&xyz)[3]) {
#if SCARP_LANES == 8
  xyz[0] =
      __builtin_shuffle(__builtin_shuffle(a, b, Mask{0, 3, 6, 9, 12, 15, 0, 0}), c, Mask{0, 1, 2, 3, 4, 5, 10, 13});
  xyz[1] =
      __builtin_shuffle(__builtin_shuffle(a, b, Mask{1, 4, 7, 10, 13, 0, 0, 0}), c, Mask{0, 1, 2, 3, 4, 8, 11, 14});
  xyz[2] =
      __builtin_shuffle(__builtin_shuffle(a, b, Mask{2, 5, 8, 11, 14, 0, 0, 0}), c, Mask{0, 1, 2, 3, 4, 9, 12, 15});
#elif SCARP_LANES == 4
  xyz[0] = __builtin_shuffle(__builtin_shuffle(a, b, Mask{0, 3, 6, 0}), c, Mask{0, 1, 2, 5});
  xyz[1] = __builtin_shuffle(__builtin_shuffle(a, b, Mask{1, 4, 7, 0}), c, Mask{0, 1, 2, 6});
  xyz[2] = __builtin_shuffle(__builtin_shuffle(a, b, Mask{2, 5, 0, 0}), c, Mask{0, 1, 4, 7});
#else
  xyz[0] = __builtin_shuffle(a, b, Mask{0, 3});
  xyz[1] = __builtin_shuffle(a, c, Mask{1, 2});
  xyz[2] = __builtin_shuffle(b, c, Mask{0, 3});
#endif
}

/// The way back.
SCARP_INLINE void join_triples(const Pack (&xyz)[3], Pack (&abc)[3]) {
  const Pack x = xyz[0], y = xyz[1], z = xyz[2];
#if SCARP_LANES == 8
  abc[0] = __builtin_shuffle(__builtin_shuffle(x, y, Mask{0, 8, 0, 1, 9, 0, 2, 10}), z, Mask{0, 1, 8, 3, 4, 9, 6, 7});
  abc[1] =
      __builtin_shuffle(__builtin_shuffle(x, y, Mask{0, 3, 11, 0, 4, 12, 0, 5}), z, Mask{10, 1, 2, 11, 4, 5, 12, 7});
  abc[2] =
      __builtin_shuffle(__builtin_shuffle(x, y, Mask{13, 0, 6, 14, 0, 7, 15, 0}), z, Mask{0, 13, 2, 3, 14, 5, 6, 15});
#elif SCARP_LANES == 4
  abc[0] = __builtin_shuffle(__builtin_shuffle(x, y, Mask{0, 4, 0, 1}), z, Mask{0, 1, 4, 3});
  abc[1] = __builtin_shuffle(__builtin_shuffle(x, y, Mask{5, 0, 2, 6}), z, Mask{0, 5, 2, 3});
  abc[2] = __builtin_shuffle(__builtin_shuffle(x, y, Mask{0, 3, 7, 0}), z, Mask{6, 1, 2, 7});
#else
  abc[0] = __builtin_shuffle(x, y, Mask{0, 2});
  abc[1] = __builtin_shuffle(z, x, Mask{0, 3});
  abc[2] = __builtin_shuffle(y, z, Mask{1, 3});
#endif
}

/// `row` moved down by `by` lanes; what comes in from above is of no interest.
template <int by>
SCARP_INLINE Pack moved_down(Pack row) {
#if SCARP_LANES == 8
  return __builtin_shuffle(row, Mask{by, by + 1, by + 2, by + 3, by + 4, by + 5, by + 6, by + 7} & 7LL);
#elif SCARP_LANES == 4
  return __builtin_shuffle(row, Mask{by, by + 1, by + 2, by + 3} & 3LL);
#else
  return __builtin_shuffle(row, Mask{by, by + 1} & 1LL);
#endif
}

/// Components [i, i + kLanes) of a field of `stride` doubles, or those of them that there are.
template <int i, int stride>
SCARP_INLINE void load_rows(const double* first, Pack (&rows)[kLanes]) {
  constexpr int beyond = i + kLanes > stride ? i + kLanes - stride : 0;  // of the field's end
#pragma GCC unroll 8
  for (int l = 0; l < kLanes - 1; ++l) rows[l] = load(first + l * stride + i);
  rows[kLanes - 1] = load(first + (kLanes - 1) * stride + i - beyond);
  if constexpr (beyond > 0) rows[kLanes - 1] = moved_down<beyond>(rows[kLanes - 1]);
  transpose(rows);
}

/// Components [0, N) of a field of `stride` doubles per particle.
template <int N, int stride>
SCARP_INLINE void load_neighbours(const double* base, const Lanes& lanes, Pack* out) {
  if (!lanes.side_by_side()) return load_field<N>(base, stride, lanes, out);
  const double* const first = base + static_cast<std::size_t>(lanes.particle[0]) * stride;
  if constexpr (stride == 1) {
    out[0] = load(first);
  } else if constexpr (stride == 3) {
    Pack xyz[3];
    part_triples(load(first), load(first + kLanes), load(first + 2 * kLanes), xyz);
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) out[i] = xyz[i];
  } else {
    // Blocks of components while they fill more than half of one; the last few lane by lane.
    constexpr int rest = N % kLanes, blocks = N / kLanes + (2 * rest > kLanes);
    const auto take = [&]<int block>() __attribute__((always_inline)) {
      if constexpr (block < blocks) {
        Pack rows[kLanes];
        load_rows<block * kLanes, stride>(first, rows);
#pragma GCC unroll 8
        for (int l = 0; l < kLanes && block * kLanes + l < N; ++l) out[block * kLanes + l] = rows[l];
      }
    };
    take.template operator()<0>();
    take.template operator()<1>();
    take.template operator()<2>();
    take.template operator()<3>();
    static_assert(blocks <= 4);
#pragma GCC unroll 9
    for (int i = blocks * kLanes; i < N; ++i) out[i] = gather_lanes(base + i, stride, lanes);
  }
}

SCARP_INLINE Pack load_neighbours(const double* base, const Lanes& lanes) {
  Pack a;
  load_neighbours<1, 1>(base, lanes, &a);
  return a;
}

template <int N, int stride>
SCARP_INLINE void store_neighbours(double* base, const Lanes& lanes, const Pack* a) {
  if (!lanes.side_by_side() || (N != stride && N % kLanes != 0)) return store_field<N>(base, stride, lanes, a);
  double* const first = base + static_cast<std::size_t>(lanes.particle[0]) * stride;
  if constexpr (stride == 1) {
    store(first, a[0]);
  } else if constexpr (stride == 3 && N == 3) {
    Pack abc[3];
    join_triples({a[0], a[1], a[2]}, abc);
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) store(first + i * kLanes, abc[i]);
  } else {
    constexpr int rest = N % kLanes, blocks = N / kLanes + (2 * rest > kLanes);
#pragma GCC unroll 4
    for (int block = 0; block < blocks; ++block) {
      Pack rows[kLanes];
      const int i = block * kLanes, width = N - i < kLanes ? N - i : kLanes;
#pragma GCC unroll 8
      for (int l = 0; l < kLanes; ++l) rows[l] = l < width ? a[i + l] : Pack{};
      transpose(rows);
      // Each row but the last may spill into the next, which comes after it.
#pragma GCC unroll 8
      for (int l = 0; l + 1 < kLanes; ++l) store(first + l * stride + i, rows[l]);
      double* const last = first + (kLanes - 1) * stride + i;
      if (width == kLanes) {
        store(last, rows[kLanes - 1]);
      } else {
        for (int l = 0; l < width; ++l) last[l] = rows[kLanes - 1][l];
      }
    }
#pragma GCC unroll 9
    for (int i = blocks * kLanes; i < N; ++i) scatter_lanes(base + i, stride, lanes, a[i]);
  }
}

SCARP_INLINE void store_neighbours(double* base, const Lanes& lanes, Pack a) {
  store_neighbours<1, 1>(base, lanes, &a);
}

/// Asks for the lines of a field of some particles that stand side by side, from `first` on.
template <int stride>
SCARP_INLINE void ask_for_field(const double* base, std::size_t first) {
  const double* const at = base + first * stride;
#pragma GCC unroll 9
  for (int line = 0; line < (stride * kLanes + 7) / 8; ++line) __builtin_prefetch(at + 8 * line, 0, 3);
}

/// How many particles ahead sweeps ask.
constexpr std::uint32_t kAhead = 32;

/// The same of all that moving particles reads, and deforming them.
/// @param xi  their places in their cells
SCARP_INLINE void ask_for_moved(const scarp::kernels::ParticleArrays& particles, const double* xi, std::size_t first) {
  ask_for_field<3>(xi, first);
  ask_for_field<3>(particles.velocity, first);
  ask_for_field<3>(particles.position, first);
  ask_for_field<1>(particles.mass, first);
}
template <bool history>
SCARP_INLINE void ask_for_deformed(const scarp::kernels::ParticleArrays& particles, const double* xi,
                                   std::size_t first) {
  ask_for_field<3>(xi, first);
  ask_for_field<9>(particles.deformation_gradient, first);
  ask_for_field<6>(particles.stress, first);
  ask_for_field<1>(particles.reference_volume, first);
  if constexpr (history) {
    ask_for_field<6>(particles.elastic_left_cauchy_green, first);
    ask_for_field<1>(particles.plastic_strain, first);
    ask_for_field<1>(particles.plastic_work, first);
  }
}

}  // namespace
}  // namespace SCARP_KERNELS

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A register full of doubles, over the compiler's vector extensions, so that one source serves SSE, AVX2, AVX-512 and
// NEON. Included only by the translation units kernels_*.cpp, each of which is compiled for one instruction set and
// defines SCARP_KERNELS, its namespace, and SCARP_LANES: everything here has internal linkage or lives in that
// namespace, so that no code for a newer processor can be taken by the linker for an older one.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace SCARP_KERNELS {
namespace {

constexpr int kLanes = SCARP_LANES;

using Pack = double __attribute__((vector_size(8 * SCARP_LANES)));
using Mask = long long __attribute__((vector_size(8 * SCARP_LANES)));
/// The same in memory: any address, any type.
using LoosePack = double __attribute__((vector_size(8 * SCARP_LANES), aligned(8), may_alias));

#define SCARP_INLINE __attribute__((always_inline)) inline

SCARP_INLINE Pack load(const double* p) { return *reinterpret_cast<const LoosePack*>(p); }
SCARP_INLINE void store(double* p, Pack a) { *reinterpret_cast<LoosePack*>(p) = a; }
SCARP_INLINE void add(double* p, Pack a) { store(p, load(p) + a); }
SCARP_INLINE Pack all(double a) { return Pack{} + a; }

SCARP_INLINE Pack choose(Mask m, Pack yes, Pack no) { return m ? yes : no; }
SCARP_INLINE Pack larger(Pack a, Pack b) { return a > b ? a : b; }
SCARP_INLINE Pack smaller(Pack a, Pack b) { return a < b ? a : b; }
SCARP_INLINE Mask bits(Pack a) { return reinterpret_cast<Mask>(a); }
SCARP_INLINE Pack from_bits(Mask a) { return reinterpret_cast<Pack>(a); }
SCARP_INLINE Pack magnitude(Pack a) { return from_bits(bits(a) & 0x7fffffffffffffffLL); }
/// |a| with the sign of b.
SCARP_INLINE Pack with_sign(Pack a, Pack b) {
  return from_bits((bits(a) & 0x7fffffffffffffffLL) | (bits(b) & ~0x7fffffffffffffffLL));
}

SCARP_INLINE bool any(Mask m) {
#if defined(__AVX512F__) && SCARP_LANES == 8
  return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(m), reinterpret_cast<__m512i>(m)) != 0;
#elif defined(__AVX__) && SCARP_LANES == 4
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(m)) != 0;
#elif defined(__SSE2__) && SCARP_LANES == 2
  return _mm_movemask_pd(reinterpret_cast<__m128d>(m)) != 0;
#else
  long long found = 0;
  for (int i = 0; i < kLanes; ++i) found |= m[i];
  return found != 0;
#endif
}

SCARP_INLINE Pack square_root(Pack a) {
#if defined(__AVX512F__) && SCARP_LANES == 8
  return reinterpret_cast<Pack>(_mm512_sqrt_pd(reinterpret_cast<__m512d>(a)));
#elif defined(__AVX__) && SCARP_LANES == 4
  return reinterpret_cast<Pack>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(a)));
#elif defined(__SSE2__) && SCARP_LANES == 2
  return reinterpret_cast<Pack>(_mm_sqrt_pd(reinterpret_cast<__m128d>(a)));
#else
  Pack r = a;
  for (int i = 0; i < kLanes; ++i) r[i] = __builtin_sqrt(a[i]);
  return r;
#endif
}

/// 1 / sqrt(a) for normal a, to two units of the last place; 0 where a < 1e-280.
SCARP_INLINE Pack inverse_root(Pack a) {
  const Mask there = a >= 1e-280;
  return choose(there, 1.0 / square_root(choose(there, a, all(1.0))), Pack{});
}

/// The lanes of (before, a) moved up by one: {before[last], a[0], a[1], ...}.
SCARP_INLINE Pack shift_in(Pack before, Pack a) {
#if SCARP_LANES == 8
  return __builtin_shuffle(before, a, Mask{7, 8, 9, 10, 11, 12, 13, 14});
#elif SCARP_LANES == 4
  return __builtin_shuffle(before, a, Mask{3, 4, 5, 6});
#else
  return __builtin_shuffle(before, a, Mask{1, 2});
#endif
}

/// Sum over the lanes, first to last.
SCARP_INLINE double sum(Pack a) {
  double s = a[0];
  for (int i = 1; i < kLanes; ++i) s += a[i];
  return s;
}

SCARP_INLINE double largest(Pack a) {
  double s = a[0];
  for (int i = 1; i < kLanes; ++i) s = a[i] > s ? a[i] : s;
  return s;
}

}  // namespace
}  // namespace SCARP_KERNELS

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Logarithm and exponential of packs, without branches or calls: a call of the mathematical library in a hot loop
// costs more than the rest of the law. Errors, as tests/unit/kernels/vector_math_test.cpp holds them against long
// double: log below 2 units in the last place for normal arguments, near 1 too; exp below 2 for |x| <= 700.
#pragma once

#include "solver/kernels/pack.hpp"

namespace SCARP_KERNELS {
namespace {

constexpr double kLn2High = 6.93147180369123816490e-01;  // the last 21 bits are zero: times an exponent it is exact
constexpr double kLn2Low = 1.90821492927058770002e-10;

/// Integers below 2^51 in magnitude, as doubles: added to the bits of 1.5 * 2^52 they stand in the mantissa.
SCARP_INLINE Pack to_double(Mask n) { return from_bits(n + 0x4338000000000000LL) - 6755399441055744.0; }

/// ln(x) for normal x > 0; of others not a number or infinity, or at zero and below some number.
/// x = 2^n m with m in [sqrt(1/2), sqrt(2)), ln(m) = 2 atanh(s) with s = (m - 1) / (m + 1).
SCARP_INLINE Pack natural_log(Pack x) {
  constexpr long long half_root = 0x3fe6a09e667f3bcdLL;  // bits of sqrt(1/2)
  using Unsigned = unsigned long long __attribute__((vector_size(8 * SCARP_LANES)));
  const Mask above = bits(x) - half_root;
  // The exponent of x / sqrt(1/2), by a shift that needs no sign: the offset keeps it positive.
  const Mask n = reinterpret_cast<Mask>(reinterpret_cast<Unsigned>(above + (1024LL << 52)) >> 52) - 1024;
  const Pack m = from_bits(bits(x) - (n << 52));
  const Pack s = (m - 1.0) / (m + 1.0);
  const Pack z = s * s;
  Pack series = all(2.0 / 21);
#pragma GCC unroll 9
  for (int k = 19; k >= 3; k -= 2) series = series * z + 2.0 / k;
  const Pack e = to_double(n);
  // 2 s is m - 1 less s (m - 1): exact to the last digit near one, where it is all there is.
  const Pack f = m - 1.0;
  return e * kLn2High + (f - (s * (f - z * series) - e * kLn2Low));
}

/// ln(x), shorter where all lanes are within 6 % of one.
SCARP_INLINE Pack log_near_one(Pack x) {
  const Pack f = x - 1.0;
  if (any(~(magnitude(f) < 0.06))) return natural_log(x);
  const Pack s = f / (x + 1.0), z = s * s;
  Pack series = all(2.0 / 11);
#pragma GCC unroll 4
  for (int k = 9; k >= 3; k -= 2) series = series * z + 2.0 / k;
  return f - s * (f - z * series);
}

/// e^x for |x| <= 700, not a number for one.
SCARP_INLINE Pack exponential(Pack x) {
  constexpr double magic = 6755399441055744.0;  // 1.5 * 2^52
  const Pack shifted = x * 1.4426950408889634 + magic;
  const Mask n = bits(shifted) - 0x4338000000000000LL;
  const Pack whole = shifted - magic;
  const Pack r = (x - whole * kLn2High) - whole * kLn2Low;
  constexpr double factorial[] = {1,     1,      2,       6,        24,        120,        720,
                                  5040., 40320., 362880., 3628800., 39916800., 479001600., 6227020800.};
  Pack series = all(1 / factorial[13]);
#pragma GCC unroll 12
  for (int k = 12; k >= 2; --k) series = series * r + 1 / factorial[k];
  series = 1.0 + (r + r * r * series);
  return from_bits(bits(series) + (n << 52));
}

/// x^(1/3) for x > 0, near one by its series and two of Newton's steps.
SCARP_INLINE Pack cube_root(Pack x) {
  const Pack f = x - 1.0;
  if (any(~(magnitude(f) < 0.1))) return exponential(natural_log(x) * (1.0 / 3));
  Pack y = 1.0 + f * (1.0 / 3 + f * (-1.0 / 9 + f * (5.0 / 81 - f * (10.0 / 243))));
  for (int i = 0; i < 2; ++i) y -= (y * y * y - x) / (3.0 * y * y);
  return y;
}

}  // namespace
}  // namespace SCARP_KERNELS

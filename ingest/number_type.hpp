// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

namespace scarp {

/// Types of numbers in binary records (PLY and PCD).
enum class NumberType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

/// Bytes of a number.
constexpr std::size_t size_of(NumberType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<int>(type)];
}

namespace detail {

/// The bytes at `bytes`, which need no alignment, as a T; in reverse if `swap`.
template <class T>
T load_raw(const char* bytes, bool swap) {
  unsigned char copy[sizeof(T)];
  std::memcpy(copy, bytes, sizeof(T));
  if (swap)
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(copy[i], copy[sizeof(T) - 1 - i]);
  T value;
  std::memcpy(&value, copy, sizeof(T));
  return value;
}

}  // namespace detail

/// One number of a record as a double (64-bit integers above 2^53 are rounded).
inline double load_number(const char* bytes, NumberType type, bool big_endian) {
  const bool swap = big_endian != (std::endian::native == std::endian::big);
  switch (type) {
    case NumberType::i8:
      return static_cast<signed char>(*bytes);
    case NumberType::u8:
      return static_cast<unsigned char>(*bytes);
    case NumberType::i16:
      return detail::load_raw<std::int16_t>(bytes, swap);
    case NumberType::u16:
      return detail::load_raw<std::uint16_t>(bytes, swap);
    case NumberType::i32:
      return detail::load_raw<std::int32_t>(bytes, swap);
    case NumberType::u32:
      return detail::load_raw<std::uint32_t>(bytes, swap);
    case NumberType::i64:
      return static_cast<double>(detail::load_raw<std::int64_t>(bytes, swap));
    case NumberType::u64:
      return static_cast<double>(detail::load_raw<std::uint64_t>(bytes, swap));
    case NumberType::f32:
      return detail::load_raw<float>(bytes, swap);
    case NumberType::f64:
      return detail::load_raw<double>(bytes, swap);
  }
  return 0;
}

struct NumberRange {
  double least, most;
};

/// Integers of the type lie in this range; real types have no bounds.
inline NumberRange range_of(NumberType type) {
  if (type == NumberType::f32 || type == NumberType::f64) return {-INFINITY, INFINITY};
  const int bits = 8 * static_cast<int>(size_of(type));
  const bool is_signed = static_cast<int>(type) % 2 == 0;
  return is_signed ? NumberRange{-std::ldexp(1.0, bits - 1), std::ldexp(1.0, bits - 1) - 1}
                   : NumberRange{0, std::ldexp(1.0, bits) - 1};
}

/// Whether a number written as text can be one of the type; a real type takes all, NaN too.
inline bool fits(double value, const NumberRange& range) {
  return std::isinf(range.least) || (value >= range.least && value <= range.most && value == std::floor(value));
}

}  // namespace scarp

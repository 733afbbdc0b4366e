// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chance without a state that travels: every draw is a function of a key and a counter, so that any thread can
// make any point and the result does not depend on the C++ library.
#pragma once

#include <cmath>
#include <cstdint>

namespace scarp {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection that scatters neighbouring integers.
inline std::uint64_t scatter(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// A key that depends on both and on their order.
inline std::uint64_t join_keys(std::uint64_t a, std::uint64_t b) { return scatter(scatter(a) ^ b); }

/// In [0, 1).
inline double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// The draws of one key, in order.
class Draws {
 public:
  explicit Draws(std::uint64_t key) : key_(key) {}

  /// Uniform in [0, 1).
  double uniform() { return unit_interval(join_keys(key_, counter_++)); }

  /// Mean 0, standard deviation 1 (Box and Muller 1958, the cosine branch).
  double gaussian() {
    constexpr double two_pi = 6.283185307179586;
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(two_pi * uniform());
  }

 private:
  std::uint64_t key_, counter_ = 0;
};

}  // namespace scarp

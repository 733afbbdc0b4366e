// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "solver/model/synth_options.hpp"

namespace scarp {

/// Noise in [-1, 1] with mean 0: random values on the integer lattice, joined by the quintic 6t^5 - 15t^4 + 10t^3
/// (twice continuously differentiable). Its standard deviation over the plane is kValueNoiseDeviation.
double value_noise(std::uint64_t key, double u, double v);
inline constexpr double kValueNoiseDeviation = 0.452384;

/// The ground as a function, local coordinates, m. Defined everywhere; the scan covers [0, size].
///
/// z = height * s(y) + roughness + slide, where s rises from 0 at the end of the toe to 1 at the begin of the
/// crest: a plane whose gradient is faded in and out by half cosines over a fifth of the slope's length each.
/// Roughness is a sum of octaves of value noise, wavelengths roughness_length / 2^k down to 0.8 m (six at most),
/// amplitudes falling by 2^-0.8 (a Hurst exponent of 0.8, as natural slopes have).
class Terrain {
 public:
  explicit Terrain(const SyntheticScan& scan);

  double height(double x, double y) const { return slope(y) + roughness(x, y) + slide_change(x, y); }

  /// What the slide took (negative) or left (positive). Both bodies are caps of ellipsoids,
  /// depth * (sqrt(4 - 3 r^2) - 1) at the relative radius r, of volume 5/9 pi a b depth.
  double slide_change(double x, double y) const;

  /// Edge of the cells in which the ground is straight enough to look for a crossing, m.
  double detail() const;

 private:
  double slope(double y) const;
  double roughness(double x, double y) const;

  std::uint64_t key_;
  double height_, toe_, slope_length_;
  double roughness_length_, amplitude_;  ///< of the coarsest octave
  int octaves_ = 1;
  std::optional<SyntheticSlide> slide_;
};

}  // namespace scarp

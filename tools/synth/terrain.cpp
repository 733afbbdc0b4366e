// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/synth/terrain.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace scarp {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kBlend = 0.2;                         ///< share of the slope's length over which its gradient fades in
constexpr double kFalloff = 0.5743491774985175;        ///< 2^-0.8, amplitude of an octave relative to the one before
constexpr double kFinestWavelength = 0.8;              ///< m
constexpr double kLobeWidth = 1.3, kLobeLength = 1.5;  ///< half axes in x and y, relative to the scar's radius

double quintic(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

double lattice_value(std::uint64_t key, double i, double j) {
  const auto a = static_cast<std::uint64_t>(static_cast<std::int64_t>(i));
  const auto b = static_cast<std::uint64_t>(static_cast<std::int64_t>(j));
  return 2 * unit_interval(scatter(join_keys(key, a) ^ b)) - 1;
}

/// Height of the cap of an ellipsoid at the squared relative radius: 1 in the middle, 0 on the rim and outside.
double cap(double r2) { return r2 < 1 ? std::sqrt(4 - 3 * r2) - 1 : 0; }

/// Integral from 0 to u of a gradient that fades in over [0, kBlend] by half a cosine and then is 1.
double faded_in(double u) {
  if (u >= kBlend) return u - kBlend / 2;
  return u / 2 - kBlend / (2 * kPi) * std::sin(kPi * u / kBlend);
}

}  // namespace

double value_noise(std::uint64_t key, double u, double v) {
  const double i = std::floor(u), j = std::floor(v);
  const double a = quintic(u - i), b = quintic(v - j);
  const double south = (1 - a) * lattice_value(key, i, j) + a * lattice_value(key, i + 1, j);
  const double north = (1 - a) * lattice_value(key, i, j + 1) + a * lattice_value(key, i + 1, j + 1);
  return (1 - b) * south + b * north;
}

Terrain::Terrain(const SyntheticScan& scan)
    : key_(join_keys(static_cast<std::uint64_t>(scan.seed), 1)),
      height_(scan.height),
      toe_(scan.toe_length),
      slope_length_(scan.size[1] - scan.toe_length - scan.crest_length),
      roughness_length_(scan.roughness_length),
      slide_(scan.slide) {
  constexpr int most_octaves = 6;
  double variance = 1, share = 1;
  while (octaves_ < most_octaves && std::ldexp(roughness_length_, -octaves_) >= kFinestWavelength) {
    ++octaves_;
    share *= kFalloff * kFalloff;
    variance += share;
  }
  amplitude_ = scan.roughness / (std::sqrt(variance) * kValueNoiseDeviation);
}

double Terrain::slope(double y) const {
  if (!(slope_length_ > 0)) return 0;
  const double u = std::clamp((y - toe_) / slope_length_, 0.0, 1.0);
  // The rise is symmetric about its middle, which makes the upper half from the lower.
  const double half = faded_in(std::min(u, 1 - u)) / (1 - kBlend);
  return height_ * (u <= 0.5 ? half : 1 - half);
}

double Terrain::roughness(double x, double y) const {
  if (amplitude_ == 0) return 0;
  double sum = 0, amplitude = amplitude_;
  double u = x / roughness_length_, v = y / roughness_length_;
  for (int k = 0; k < octaves_; ++k) {
    sum += amplitude * value_noise(join_keys(key_, static_cast<std::uint64_t>(k)), u, v);
    amplitude *= kFalloff;
    // Twice the frequency, turned by the 3-4-5 angle so that the lattices of the octaves do not line up.
    const double turned = 1.6 * u - 1.2 * v;
    v = 1.2 * u + 1.6 * v;
    u = turned;
  }
  return sum;
}

double Terrain::slide_change(double x, double y) const {
  if (!slide_) return 0;
  const double dx = (x - slide_->scar_centre[0]) / slide_->scar_radius;
  const double dy = (y - slide_->scar_centre[1]) / slide_->scar_radius;
  const double lobe_x = dx / kLobeWidth;
  const double lobe_y = (dy + slide_->travel / slide_->scar_radius) / kLobeLength;
  const double lobe_depth = slide_->depth / (kLobeWidth * kLobeLength);
  return lobe_depth * cap(lobe_x * lobe_x + lobe_y * lobe_y) - slide_->depth * cap(dx * dx + dy * dy);
}

double Terrain::detail() const {
  double detail = std::min(0.25, slope_length_ > 0 ? slope_length_ * kBlend / 4 : 0.25);
  if (amplitude_ > 0) detail = std::min(detail, std::ldexp(roughness_length_, -octaves_ - 1));
  if (slide_) detail = std::min(detail, slide_->scar_radius / 16);
  return detail;
}

}  // namespace scarp

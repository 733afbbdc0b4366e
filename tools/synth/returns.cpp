// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/synth/returns.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/parallel.hpp"
#include "tools/synth/random.hpp"

namespace scarp {
namespace {

constexpr std::uint8_t kGround = 2, kVegetation = 5, kStrayBelow = 7, kStrayAbove = 18;  // ASPRS, LAS 1.4 table 17

/// How much grows at a place, from -1 (bare) to 1 (thicket); patches are some 6 m across.
double growth(const SyntheticScan& scan, const Ground& ground, const Vec3& p) {
  constexpr double patch = 6, contrast = 2;
  if (ground.terrain().slide_change(p[0], p[1]) != 0) return -1;
  const std::uint64_t key = join_keys(static_cast<std::uint64_t>(scan.seed), 3);
  return std::clamp(contrast * value_noise(key, p[0] / patch, p[1] / patch), -1.0, 1.0);
}

/// Summed in fixed blocks, so that it has the same bits for any number of threads.
double mean(const std::vector<double>& values, int threads) {
  const std::size_t blocks = (values.size() + kReductionBlock - 1) / kReductionBlock;
  std::vector<double> sums(blocks, 0.0);
  parallel_for(blocks, threads, [&](std::size_t block) {
    const std::size_t end = std::min(values.size(), (block + 1) * kReductionBlock);
    for (std::size_t i = block * kReductionBlock; i < end; ++i) sums[block] += values[i];
  });
  double sum = 0;
  for (const double part : sums) sum += part;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// A point `height` off the ground (negative: below it) that the same ray could have returned; straight above or
/// below the hit where the ray does not get there.
Vec3 off_ground(const SyntheticScan& scan, const Ground& ground, const Ray& ray, double range, double height) {
  if (scan.occlusion && height > 0)
    if (const auto higher = ground.first_hit(ray, height)) return ray.at(*higher);
  if (scan.occlusion && height < 0)
    if (const auto deeper = ground.next_crossing(ray, range, height)) return ray.at(deeper->range);
  Vec3 p = ray.at(range);
  p[2] = ground.terrain().height(p[0], p[1]) + height;
  return p;
}

struct Appearance {
  Vec3 colour;  ///< 0 to 1
  double reflectance;
};

Appearance appearance(std::uint8_t asprs_class, double growing, const Vec3& normal, Draws& draws) {
  constexpr Vec3 soil{0.55, 0.43, 0.32}, grass{0.40, 0.50, 0.24}, leaves{0.22, 0.38, 0.16}, grey{0.6, 0.6, 0.62};
  constexpr Vec3 sun{0.48, -0.36, 0.8};
  const double light = 0.45 + 0.55 * std::max(0.0, dot(normal, sun)) + 0.04 * draws.gaussian();
  if (asprs_class == kVegetation) return {(0.6 + 0.6 * draws.uniform()) * leaves, 0.45};
  if (asprs_class != kGround) return {grey, 0.1};
  // Grass thins out on steep ground: none from about 50 degrees.
  const double share = std::clamp(0.6 + 0.8 * growing, 0.0, 1.0) * std::clamp((normal[2] - 0.64) / 0.2, 0.0, 1.0);
  return {light * ((1 - share) * soil + share * grass), 0.3 + 0.2 * share};
}

std::uint16_t sixteen_bits(double value, double step) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * (65535 / step)) * std::lround(step));
}

void resize(PointCloud& cloud, std::size_t count) {
  cloud.positions.resize(count);
  cloud.colour.resize(count);
  cloud.intensity.resize(count);
  cloud.classification.resize(count);
  cloud.return_number.assign(count, 1);
  cloud.number_of_returns.assign(count, 1);
}

}  // namespace

PointCloud make_returns(const SyntheticScan& scan, const Ground& ground, const std::vector<Hit>& hits, int threads) {
  std::vector<double> growing(hits.size());
  parallel_for(hits.size(), threads, [&](std::size_t i) {
    growing[i] = growth(scan, ground, scan.scanner + hits[i].range * hits[i].direction);
  });
  const double mean_growth = mean(growing, threads);

  PointCloud cloud;
  resize(cloud, hits.size());
  parallel_for(hits.size(), threads, [&](std::size_t i) {
    const Ray ray{scan.scanner, hits[i].direction};
    Draws draws(hits[i].key);
    const double v = scan.vegetation;
    // Within [0, 1] for any v, and v in the mean.
    const double plants = v + v * (1 - v) * (growing[i] - mean_growth) / (1 + std::abs(mean_growth));
    const double choice = draws.uniform(), height = draws.uniform();
    Vec3 p = ray.at(hits[i].range);
    const Vec3 normal = ground.normal(p[0], p[1]);
    std::uint8_t asprs_class = kGround;
    if (choice < scan.outliers) {
      asprs_class = draws.uniform() < 0.5 ? kStrayBelow : kStrayAbove;
      const double off = asprs_class == kStrayAbove ? scan.vegetation_height + 2 + 10 * height : -2 - 8 * height;
      p = off_ground(scan, ground, ray, hits[i].range, off);
    } else if (choice < scan.outliers + plants) {
      asprs_class = kVegetation;
      p = off_ground(scan, ground, ray, hits[i].range, scan.vegetation_height * (0.05 + 0.95 * height));
    }
    cloud.positions[i] = p + scan.range_noise * draws.gaussian() * ray.direction + scan.site_offset;
    const Appearance look = appearance(asprs_class, growing[i], normal, draws);
    for (int c = 0; c < 3; ++c) cloud.colour[i][c] = sixteen_bits(look.colour[c], 257);
    const double facing = asprs_class == kGround ? std::abs(dot(normal, ray.direction)) : 0.6;
    cloud.intensity[i] = sixteen_bits(look.reflectance * facing * (1 + 0.05 * draws.gaussian()), 1);
    cloud.classification[i] = asprs_class;
  });
  return cloud;
}

}  // namespace scarp

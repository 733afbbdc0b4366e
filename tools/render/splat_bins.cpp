// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/splat_bins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr std::size_t kDepthSteps = 4096;
/// 400 MB of list entries; ten million particles of a real cloud need a tenth of it.
constexpr std::size_t kMostEntries = 100'000'000;

/// The tiles under a splat; none if it lies outside.
struct TileRange {
  int left, right, top, bottom;  ///< inclusive
};

TileRange tiles_under(const Splat& s, float radius, const Bins& bins) {
  const auto tile = [](float v, int count) {
    return static_cast<int>(std::floor(std::clamp(v / kTile, -1.0f, static_cast<float>(count))));
  };
  return {std::max(0, tile(s.x - radius, bins.columns)), std::min(bins.columns - 1, tile(s.x + radius, bins.columns)),
          std::max(0, tile(s.y - radius, bins.rows)), std::min(bins.rows - 1, tile(s.y + radius, bins.rows))};
}

/// Indices of the splats by falling z, in steps; within a step in their own order.
std::vector<std::uint32_t> nearest_first(const std::vector<Splat>& splats, float& step) {
  float low = INFINITY, high = -INFINITY;
  for (const Splat& s : splats) low = std::min(low, s.z), high = std::max(high, s.z);
  // A hair wider, so that rounding cannot put a splat into a step that is too far.
  step = std::max((high - low) * 1.001f / kDepthSteps, 1e-6f);
  const auto bucket = [&](const Splat& s) {
    return std::min(kDepthSteps - 1, static_cast<std::size_t>((high - s.z) / step));
  };
  std::vector<std::size_t> place(kDepthSteps + 1, 0);
  for (const Splat& s : splats) ++place[bucket(s) + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<std::uint32_t> order(splats.size());
  for (std::size_t i = 0; i < splats.size(); ++i) order[place[bucket(splats[i])]++] = static_cast<std::uint32_t>(i);
  step *= 1.01f;
  return order;
}

template <class F>
void for_each_tile(const Splat& s, float radius, const Bins& bins, F&& f) {
  const TileRange range = tiles_under(s, radius, bins);
  for (int row = range.top; row <= range.bottom; ++row)
    for (int column = range.left; column <= range.right; ++column)
      f(static_cast<std::size_t>(row) * bins.columns + column);
}

}  // namespace

Bins bin_splats(const std::vector<Splat>& splats, float radius, int width, int height) {
  Bins bins;
  bins.columns = (width + kTile - 1) / kTile;
  bins.rows = (height + kTile - 1) / kTile;
  bins.begin.assign(static_cast<std::size_t>(bins.columns) * bins.rows + 1, 0);
  for (const Splat& s : splats) for_each_tile(s, radius, bins, [&](std::size_t tile) { ++bins.begin[tile + 1]; });
  std::partial_sum(bins.begin.begin(), bins.begin.end(), bins.begin.begin());
  if (bins.begin.back() > kMostEntries)
    throw Error("render", "the particles lie on top of each other", std::to_string(splats.size()) + " particles",
                "particles about one spacing apart");
  bins.particles.resize(bins.begin.back());
  std::vector<std::size_t> place(bins.begin.begin(), bins.begin.end() - 1);
  for (std::uint32_t i : nearest_first(splats, bins.depth_step))
    for_each_tile(splats[i], radius, bins, [&](std::size_t tile) { bins.particles[place[tile]++] = i; });
  return bins;
}

std::size_t coprime_stride(std::size_t count) {
  std::size_t stride = count * 618 / 1000 + 1;
  while (std::gcd(stride, count) != 1) ++stride;
  return stride;
}

}  // namespace scarp

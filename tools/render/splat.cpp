// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render/splat.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solver/model/error.hpp"
#include "solver/model/parallel.hpp"
#include "tools/render/splat_bins.hpp"

namespace scarp {
namespace {

constexpr int kSide = kTile * kSamples;  ///< samples along a side of a tile
constexpr int kCells = kSide * kSide;
constexpr int kBlock = 8;  ///< samples along a side of a block, the unit of the second pass's culling
constexpr int kBlocks = kSide / kBlock;
constexpr float kFar = -INFINITY;
constexpr float kReach = 0.9f;     ///< radii behind the nearest surface from which splats still form it
constexpr float kBeyond = 1.125f;  ///< radius of the paraboloids over that of the discs which cover
constexpr float kDisc = 1 / (kBeyond * kBeyond);

/// The buffers of one tile; small enough to stay in the cache.
struct Tile {
  std::array<float, kCells> depth;
  std::array<std::int32_t, kCells> winner;
  std::array<std::uint8_t, kCells> covered;  ///< 1: by a disc, 2: by its core
  std::array<float, kCells> weight, height, value_weight;
  std::array<float, kCells> value;                ///< weighted sum of a scalar
  std::array<Rgb, kCells> colour;                 ///< weighted sum of the scan's colours
  std::array<float, kBlocks * kBlocks> farthest;  ///< least depth of each block
};

/// What does not change from tile to tile. Lengths in samples.
struct Job {
  const std::vector<Splat>& splats;
  float radius;
  const ColourField& field;
  const ColourScale& scale;
  bool blend;
};

/// Calls f(cell, squared distance to the centre / radius²) for every sample of the tile under the splat.
template <class F>
void for_each_sample(const Splat& splat, float radius, int left, int top, F&& f) {
  const float cx = splat.x * kSamples - static_cast<float>(left) - 0.5f;
  const float cy = splat.y * kSamples - static_cast<float>(top) - 0.5f;
  const float inverse = 1 / (radius * radius);
  const int y_begin = std::max(0, static_cast<int>(std::ceil(cy - radius)));
  const int y_end = std::min(kSide - 1, static_cast<int>(std::floor(cy + radius)));
  for (int y = y_begin; y <= y_end; ++y) {
    const float dy = static_cast<float>(y) - cy, half = std::sqrt(std::max(0.0f, radius * radius - dy * dy));
    const int x_begin = std::max(0, static_cast<int>(std::ceil(cx - half)));
    const int x_end = std::min(kSide - 1, static_cast<int>(std::floor(cx + half)));
    for (int x = x_begin; x <= x_end; ++x) {
      const float dx = static_cast<float>(x) - cx;
      f(y * kSide + x, (dx * dx + dy * dy) * inverse);
    }
  }
}

/// First pass: nearest surface per sample. Particles come nearest first, roughly; once the whole tile is covered by
/// what is nearer than all that follow, the rest cannot be seen. Returns how many were looked at.
std::size_t find_front(const Job& job, const Bins& bins, std::size_t begin, std::size_t end, int left, int top,
                       Tile& tile) {
  tile.depth.fill(kFar);
  tile.winner.fill(-1);
  tile.covered.fill(0);
  for (std::size_t k = begin; k < end; ++k) {
    if ((k - begin) % 64 == 63) {
      const float farthest = *std::min_element(tile.depth.begin(), tile.depth.end());
      const float highest = (job.splats[bins.particles[k]].z + bins.depth_step) * kSamples + job.radius;
      if (highest < farthest - kReach * job.radius) return k;
    }
    const std::uint32_t i = bins.particles[k];
    const float z = job.splats[i].z * kSamples;
    for_each_sample(job.splats[i], job.radius, left, top, [&](int cell, float rho2) {
      const float depth = z + job.radius * (1 - rho2);
      const bool nearer =
          depth > tile.depth[cell] || (depth == tile.depth[cell] && static_cast<std::int32_t>(i) < tile.winner[cell]);
      if (nearer) tile.depth[cell] = depth, tile.winner[cell] = static_cast<std::int32_t>(i);
      if (rho2 <= kDisc) tile.covered[cell] |= rho2 <= 0.36f * kDisc ? 3 : 1;
    });
  }
  return end;
}

void find_farthest(Tile& tile) {
  tile.farthest.fill(INFINITY);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      float& block = tile.farthest[static_cast<std::size_t>(y / kBlock * kBlocks + x / kBlock)];
      block = std::min(block, tile.depth[y * kSide + x]);
    }
}

/// Whether a splat is too far behind everything that its samples show.
bool hidden(const Splat& splat, float radius, int left, int top, const Tile& tile) {
  const auto block = [&](float v, int from) {
    return std::clamp(static_cast<int>((v * kSamples - static_cast<float>(from)) / kBlock), 0, kBlocks - 1);
  };
  const float reach = radius / kSamples;
  const float highest = splat.z * kSamples + (1 + kReach) * radius;
  for (int y = block(splat.y - reach, top); y <= block(splat.y + reach, top); ++y)
    for (int x = block(splat.x - reach, left); x <= block(splat.x + reach, left); ++x)
      if (highest >= tile.farthest[static_cast<std::size_t>(y * kBlocks + x)]) return false;
  return true;
}

/// Adds one splat to the means; add(cell, weight) takes its value.
template <class F>
void blend_splat(const Splat& splat, float radius, int left, int top, Tile& tile, F&& add) {
  const float z = splat.z * kSamples, inverse = 1 / (kReach * radius);
  for_each_sample(splat, radius, left, top, [&](int cell, float rho2) {
    const float depth = z + radius * (1 - rho2), behind = 1 - (tile.depth[cell] - depth) * inverse;
    if (!(behind > 0)) return;
    const float weight = ((1 - rho2) * (1 - rho2) + 1e-3f) * behind;
    tile.weight[cell] += weight;
    tile.height[cell] += weight * depth;
    add(cell, weight);
  });
}

std::int32_t body_of(const Job& job, std::int32_t splat) {
  return job.field.bodies.empty() ? 0 : job.field.bodies[static_cast<std::size_t>(splat)];
}

/// Second pass: weighted means over the splats whose surface lies close behind the nearest one.
void blend_front(const Job& job, const Bins& bins, std::size_t begin, std::size_t end, int left, int top, Tile& tile) {
  tile.weight.fill(0);
  tile.height.fill(0);
  tile.value_weight.fill(0);
  tile.value.fill(0);
  const ColourKind kind = job.field.kind;
  if (kind == ColourKind::scan) tile.colour.fill({0, 0, 0});
  find_farthest(tile);
  for (std::size_t k = begin; k < end; ++k) {
    const std::uint32_t i = bins.particles[k];
    const Splat& splat = job.splats[i];
    if (hidden(splat, job.radius, left, top, tile)) continue;
    if (kind == ColourKind::scalar && std::isfinite(job.field.values[i]))
      blend_splat(splat, job.radius, left, top, tile, [&, value = job.field.values[i]](int cell, float weight) {
        if (body_of(job, tile.winner[cell]) != body_of(job, static_cast<std::int32_t>(i))) return;
        tile.value_weight[cell] += weight;
        tile.value[cell] += weight * value;
      });
    else if (kind == ColourKind::scan && job.field.colours[i] != Rgb8{0, 0, 0})
      blend_splat(splat, job.radius, left, top, tile, [&, value = job.field.colours[i]](int cell, float weight) {
        tile.value_weight[cell] += weight;
        for (int c = 0; c < 3; ++c) tile.colour[cell][c] += weight * value[c];
      });
    else
      blend_splat(splat, job.radius, left, top, tile, [](int, float) {});
  }
}

/// Colour of a sample, for all but blended scalars.
Rgb colour_of(const Job& job, const Tile& tile, int cell) {
  const std::size_t i = static_cast<std::size_t>(tile.winner[cell]);
  if (job.field.kind == ColourKind::classes) return class_colour(job.field.classes[i]);
  if (job.field.kind == ColourKind::scalar) return job.scale(job.field.values[i]);
  const Rgb8& own = job.field.colours[i];
  if (own == Rgb8{0, 0, 0}) return kNoValue;
  if (!job.blend) return {float(own[0]), float(own[1]), float(own[2])};
  const Rgb& sum = tile.colour[cell];
  const float weight = tile.value_weight[cell];
  return {sum[0] / weight, sum[1] / weight, sum[2] / weight};
}

/// Means over the samples of one pixel. Depth and value are those of the nearest surface in it, not of a point in the
/// gap between two.
void resolve_pixel(const Job& job, const Tile& tile, int x, int y, std::size_t to, Layer& layer) {
  std::array<int, kSamples * kSamples> cells;
  float nearest = kFar;
  std::int32_t front = -1;
  int covered = 0, core = 0;
  for (int s = 0; s < kSamples * kSamples; ++s) {
    cells[s] = (y * kSamples + s / kSamples) * kSide + x * kSamples + s % kSamples;
    if (tile.depth[cells[s]] > nearest) nearest = tile.depth[cells[s]], front = tile.winner[cells[s]];
    covered += tile.covered[cells[s]] & 1;
    core += tile.covered[cells[s]] >> 1;
  }
  layer.cover[to] = static_cast<float>(covered) / (kSamples * kSamples);
  layer.core[to] = static_cast<float>(core) / (kSamples * kSamples);
  if (nearest == kFar) return;
  Rgb colour{0, 0, 0};
  float height = 0, near = 0, own = 0, seen = 0, value = 0;
  for (int cell : cells) {
    if (tile.winner[cell] < 0) continue;
    seen += 1;
    if (!layer.colour.empty()) {
      const Rgb of_sample = colour_of(job, tile, cell);
      for (int c = 0; c < 3; ++c) colour[c] += of_sample[c];
    }
    if (tile.depth[cell] < nearest - 2 * job.radius) continue;
    near += 1;
    height += job.blend ? tile.height[cell] / tile.weight[cell] : tile.depth[cell];
    if (layer.value.empty() || body_of(job, tile.winner[cell]) != body_of(job, front)) continue;
    own += 1;
    const bool known = std::isfinite(job.field.values[static_cast<std::size_t>(tile.winner[cell])]);
    value += known ? tile.value[cell] / tile.value_weight[cell] : NAN;
  }
  if (!layer.colour.empty()) layer.colour[to] = {colour[0] / seen, colour[1] / seen, colour[2] / seen};
  if (!layer.value.empty()) layer.value[to] = value / own;
  if (!layer.body.empty()) layer.body[to] = body_of(job, front);
  layer.depth[to] = height / near / kSamples;
}

void draw_tile(const Job& job, const Bins& bins, std::size_t index, Layer& layer) {
  const std::size_t begin = bins.begin[index], end = bins.begin[index + 1];
  if (begin == end) return;
  const int column = static_cast<int>(index) % bins.columns, row = static_cast<int>(index) / bins.columns;
  const int left = column * kSide, top = row * kSide;
  static thread_local Tile tile;
  const std::size_t used = find_front(job, bins, begin, end, left, top, tile);
  if (job.blend) blend_front(job, bins, begin, used, left, top, tile);
  for (int y = 0; y < kTile && row * kTile + y < layer.height; ++y)
    for (int x = 0; x < kTile && column * kTile + x < layer.width; ++x)
      resolve_pixel(job, tile, x, y, layer.index(column * kTile + x, row * kTile + y), layer);
}

}  // namespace

Layer draw_splats(const std::vector<Splat>& splats, float radius, int width, int height, const ColourField& field,
                  const ColourScale& scale, bool blend, int threads) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Layer layer{.width = width,
              .height = height,
              .cover = std::vector<float>(pixels, 0),
              .core = std::vector<float>(pixels, 0),
              .depth = std::vector<float>(pixels, kFar),
              .value = {},
              .body = {},
              .colour = {},
              .slope_x = {},
              .slope_y = {}};
  if (blend && field.kind == ColourKind::scalar)
    layer.value.assign(pixels, NAN), layer.body.assign(field.bodies.empty() ? 0 : pixels, -1);
  else
    layer.colour.resize(pixels);
  // A splat of this radius is sure to hit a sample.
  const float in_samples = std::max(radius * kSamples, 1.0f) * kBeyond;
  const Bins bins = bin_splats(splats, in_samples / kSamples, width, height);
  const Job job{splats, in_samples, field, scale, blend};
  const std::size_t tiles = bins.begin.size() - 1;
  // Neighbouring tiles have alike work: deal them out so that each thread gets some of every region.
  const std::size_t stride = coprime_stride(tiles);
  parallel_for(tiles, threads, [&](std::size_t k) { draw_tile(job, bins, k * stride % tiles, layer); });
  return layer;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/voxel_thin.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "solver/model/error.hpp"

namespace scarp {
namespace {

using Key = std::array<std::int64_t, 3>;

struct Voxel {
  Key key{};
  std::uint32_t first = 0;  ///< lowest index of its points
  std::uint32_t count = 0;
  Vec3 sum{0, 0, 0};                  ///< of offsets from the first point: exact where it matters, for two points
  double nearest_squared = INFINITY;  ///< m2, distance of the nearest point from the centroid
};

std::uint64_t hash_of(const Key& key) {
  std::uint64_t h = 0;
  for (std::int64_t k : key) {
    h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15u;
    h ^= h >> 32;
  }
  return h;
}

/// Voxels numbered in the order in which they were first met.
class VoxelTable {
 public:
  explicit VoxelTable(std::size_t points) : slots_(std::bit_ceil(std::max<std::size_t>(2 * points, 16)), kFree) {}

  std::uint32_t number_of(const Key& key, std::uint32_t point) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash_of(key) & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] == kFree) {
        slots_[slot] = static_cast<std::uint32_t>(voxels.size());
        voxels.push_back({.key = key, .first = point});
      }
      if (voxels[slots_[slot]].key == key) return slots_[slot];
    }
  }

  std::vector<Voxel> voxels;

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> slots_;
};

Key key_of(const Vec3& p, double size) {
  constexpr double kFarthest = 0x1p53;  // beyond it neighbouring voxels are not told apart
  Key key;
  for (int a = 0; a < 3; ++a) {
    const double cell = std::floor(p[a] / size);
    if (!(std::abs(cell) <= kFarthest))
      throw Error("ingest", "voxel-thin cannot number the voxel of a point",
                  "coordinate " + shortest(p[a]) + " m with voxels of " + shortest(size) + " m", "at most 2^53 voxels");
    key[a] = static_cast<std::int64_t>(cell);
  }
  return key;
}

/// Squared distance of a point from the centroid of its voxel.
double from_centroid(const Vec3& p, const Vec3& first, const Voxel& voxel) {
  const Vec3 d = (p - first) - (1.0 / voxel.count) * voxel.sum;
  return dot(d, d);
}

}  // namespace

std::vector<std::size_t> voxel_thin(const std::vector<Vec3>& positions, const VoxelThin& options) {
  if (positions.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error("ingest", "voxel-thin takes fewer points", std::to_string(positions.size()), "below 2^32");
  if (!(options.size > 0)) throw Error("ingest", "voxel-thin: size", shortest(options.size), "above 0 m");
  VoxelTable table(positions.size());
  std::vector<Voxel>& voxels = table.voxels;
  std::vector<std::uint32_t> voxel_of(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    voxel_of[i] = table.number_of(key_of(positions[i], options.size), static_cast<std::uint32_t>(i));
    Voxel& voxel = voxels[voxel_of[i]];
    voxel.sum = voxel.sum + (positions[i] - positions[voxel.first]);
    ++voxel.count;
  }
  const auto squared = [&](std::size_t i) {
    const Voxel& voxel = voxels[voxel_of[i]];
    return from_centroid(positions[i], positions[voxel.first], voxel);
  };
  for (std::size_t i = 0; i < positions.size(); ++i) {
    double& nearest = voxels[voxel_of[i]].nearest_squared;
    nearest = std::min(nearest, squared(i));
  }
  // Points of a regular grid are equally far from the centroid but for rounding, which must not choose among them.
  const double tie = 1e-6 * options.size;
  std::vector<std::size_t> kept;
  kept.reserve(voxels.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Voxel& voxel = voxels[voxel_of[i]];
    if (!(std::sqrt(squared(i)) <= std::sqrt(voxel.nearest_squared) + tie)) continue;
    kept.push_back(i);
    voxel.nearest_squared = -INFINITY;  // taken: the square root is NaN, no further point passes
  }
  return kept;
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "solver/model/frame.hpp"
#include "solver/model/math.hpp"

namespace scarp {

/// How far from a point, in spacings, its surface is made of neighbours.
inline constexpr double kSurfaceReach = 3;

/// The material points of a frame as what they stand for: pieces of a body that fill space.
///
/// Plane strain (volumes in m3/m) becomes a slab: beside each particle stand copies along z, as far as a
/// surface reaches, so that what follows knows three dimensions only.
struct MaterialPoints {
  std::vector<Vec3> positions;        ///< m, local
  std::vector<double> volume;         ///< current, m3
  std::vector<Mat3> gradient;         ///< F; empty where the frame does not hold it
  std::vector<std::uint8_t> marked;   ///< 1: on the free surface when the body was made
  std::vector<std::size_t> particle;  ///< index in the frame
  std::vector<std::uint8_t> own;      ///< 1: the particle itself, 0: a copy beside the plane
  Vec3 up{0, 0, 1};                   ///< y in plane strain
  bool plane_strain = false;

  std::size_t size() const { return positions.size(); }
  /// Edge of the cube of the same volume, m.
  double spacing(std::size_t i) const { return std::cbrt(volume[i]); }
};

/// @throws Error where the frame has no float field "volume" above 0 (m3, or m3/m in plane strain), no uint8 field
/// "surface", or a field that does not fit the particles.
MaterialPoints material_points(const Frame& frame);

/// Distance between neighbouring material points of the coarsest body, m: the largest of the bodies' medians of the
/// edge of a cube (a square in plane strain) as large as a particle is in this frame. 0 where the frame has no field
/// "volume".
double spacing_of(const Frame& frame);

}  // namespace scarp

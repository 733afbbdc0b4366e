// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solver/model/synth_options.hpp"
#include "tools/synth/ground.hpp"

namespace scarp {

/// One return of the scanner, from bare ground and without noise.
struct Hit {
  Vec3 direction;     ///< unit vector from the scanner
  double range;       ///< m
  std::uint64_t key;  ///< of the ray's own draws
};

/// Turns the scanner's head: rows of constant elevation from below upwards, in each the azimuth from right to left
/// (counter-clockwise). Rays stand `1 / (sqrt(density) * reference_range)` rad apart both ways, which gives each
/// solid angle the same number and with it the density law
///   points per area = density * (reference_range / range)^2 * |cos(incidence)|.
/// With occlusion a ray ends at the first ground; without, it returns from every ground that it goes through.
/// @throws Error ("synth") if more rays are asked for than a run can hold.
std::vector<Hit> sweep(const SyntheticScan& scan, const Ground& ground, int threads);

}  // namespace scarp

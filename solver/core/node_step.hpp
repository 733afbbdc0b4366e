// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/model/math.hpp"
#include "solver/model/parallel.hpp"

namespace scarp {

/// The nodes of any grid between the forces of a step and its result: arrays of `count` entries that the caller owns.
/// Nodes without mass are left alone.
struct NodeStep {
  std::size_t count = 0;
  const double* mass = nullptr;  ///< m_I, kg
  const Vec3* before = nullptr;  ///< v_I, m/s
  Vec3* after = nullptr;         ///< v~_I, m/s; in: v_I + dt f_I / m_I of all forces so far
  double dt = 0;                 ///< s
  double time = 0;               ///< at the start of the step, s; only loads ask for it
};

/// What nodes have exchanged with the world since the start, J (2D: per metre).
struct NodeWork {
  double friction = 0;  ///< lost on faces with friction, impact included
  double damping = 0;   ///< lost to damping and to absorbing faces
  /// Done on the model by loads, water and waves, and by gravity as far as it is not the steady one: its ramp, a base
  /// that is shaken.
  double external = 0;
};

inline NodeWork operator+(const NodeWork& a, const NodeWork& b) {
  return {a.friction + b.friction, a.damping + b.damping, a.external + b.external};
}

/// Work of the impulse that turns `trial` into the node's `after`: on the lumped mass its mean velocity makes the
/// balance with m v^2 / 2 exact.
inline double work_on_node(double mass, const Vec3& before, const Vec3& trial, const Vec3& after) {
  return 0.5 * mass * dot(after - trial, before + after);
}

/// A force or a velocity without its part along held axes, bit 0 for x.
inline Vec3 free_part(Vec3 force, std::uint8_t held) {
  for (int a = 0; a < 3; ++a)
    if (held >> a & 1) force[a] = 0;
  return force;
}

/// Sum of f(i) over [0, count) in fixed blocks: the same bits for any number of threads.
template <class F>
double sum_over_nodes(std::size_t count, int threads, F&& f) {
  std::vector<double> blocks((count + kReductionBlock - 1) / kReductionBlock);
  parallel_for(blocks.size(), threads, [&](std::size_t b) {
    double sum = 0;
    for (std::size_t i = b * kReductionBlock; i < std::min(count, (b + 1) * kReductionBlock); ++i) sum += f(i);
    blocks[b] = sum;
  });
  double sum = 0;
  for (double block : blocks) sum += block;
  return sum;
}

/// sum of m_I v_I^2 / 2, J.
inline double kinetic_energy_of_nodes(const std::vector<double>& mass, const std::vector<Vec3>& velocity, int threads) {
  return 0.5 *
         sum_over_nodes(mass.size(), threads, [&](std::size_t i) { return mass[i] * dot(velocity[i], velocity[i]); });
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>

#include "solver/model/particles.hpp"

namespace scarp {

/// The particles of a model as they stand, for whoever takes them range by range: their state need not be in memory as
/// a whole.
struct ParticleStates {
  /// Rows that whoever wants them all had best ask for at a time: a chunk of our files.
  static constexpr std::size_t kBlock = 16384;

  std::size_t count = 0;
  /// Makes `block`, the caller's, particles [begin, end) of the model, every field.
  std::function<void(std::size_t begin, std::size_t end, Particles& block)> read;

  /// f(block) over all particles, in their order.
  template <class F>
  void each_block(F&& f) const {
    Particles block;
    for (std::size_t begin = 0; begin < count; begin += kBlock) {
      read(begin, std::min(count, begin + kBlock), block);
      f(static_cast<const Particles&>(block));
    }
  }
};

/// Of particles that carry their state.
inline ParticleStates states_of(const Particles& particles) {
  return {particles.size(), [&particles](std::size_t begin, std::size_t end, Particles& block) {
            copy_particles(particles, begin, end, block);
            complete_state(block);
          }};
}

}  // namespace scarp

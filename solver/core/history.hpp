// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/materials/motion.hpp"
#include "solver/model/particles.hpp"

namespace scarp {

/// Whether a law reads and writes PointHistory::hardening.
template <class Law>
inline constexpr bool kHasHardening = requires {
  requires Law::has_hardening;
};

/// What `Law` remembers of particle p; what it does not use is never loaded.
template <class Law>
PointHistory load_history(const Particles& particles, std::size_t p) {
  PointHistory history;
  if constexpr (Law::has_history) {
    history.elastic_left_cauchy_green = particles.elastic_left_cauchy_green[p];
    history.equivalent_plastic_strain = particles.equivalent_plastic_strain[p];
    history.plastic_work = particles.plastic_work[p];
  }
  if constexpr (kHasHardening<Law>) history.hardening = particles.hardening[p];
  return history;
}

template <class Law>
void store_history(Particles& particles, std::size_t p, const PointHistory& history) {
  if constexpr (Law::has_history) {
    particles.elastic_left_cauchy_green[p] = history.elastic_left_cauchy_green;
    particles.equivalent_plastic_strain[p] = history.equivalent_plastic_strain;
    particles.plastic_work[p] = history.plastic_work;
  }
  if constexpr (kHasHardening<Law>) particles.hardening[p] = history.hardening;
}

}  // namespace scarp

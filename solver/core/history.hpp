// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/materials/motion.hpp"
#include "solver/model/particles.hpp"

namespace scarp {

/// A particle's history for a law, and back; nothing is touched for laws without one.
template <class Law>
PointHistory load_history(const Particles& particles, std::size_t p) {
  if constexpr (Law::has_history)
    return {particles.elastic_left_cauchy_green[p], particles.equivalent_plastic_strain[p], particles.plastic_work[p]};
  return {};
}

template <class Law>
void store_history(Particles& particles, std::size_t p, const PointHistory& history) {
  if constexpr (Law::has_history) {
    particles.elastic_left_cauchy_green[p] = history.elastic_left_cauchy_green;
    particles.equivalent_plastic_strain[p] = history.equivalent_plastic_strain;
    particles.plastic_work[p] = history.plastic_work;
  }
}

}  // namespace scarp

// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Admissible parameters for each law: the one line that a new law adds to be held against the contract.
#pragma once

#include <vector>

#include "solver/materials/material.hpp"

namespace scarp::test {

template <class M>
std::vector<M> law_samples();

template <>
inline std::vector<LinearElastic> law_samples() {
  return {{{1000, 1e6, 0.3}}, {{1000, 1e6, -0.2}}};
}
template <>
inline std::vector<NeoHookean> law_samples() {
  return {{{1000, 1e6, 0.3}}, {{2000, 70e6, 0.0}}, {{1000, 1e6, 0.45}}};
}
template <>
inline std::vector<MohrCoulomb> law_samples() {
  return {{{1900, 20e6, 0.3}, 10e3, 28, 0},
          {{1900, 20e6, 0.3}, 0, 33, 10},
          {{1900, 20e6, 0.2}, 5e3, 20, 20},
          {{1900, 20e6, 0.4}, 50e3, 0, 0}};
}

}  // namespace scarp::test
